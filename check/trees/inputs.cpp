#include "check/trees/inputs.h"

#include <limits>
#include <random>

namespace check {

namespace {

using ref::Aabb;
using ref::Vec3;

/// Uniform numbers, the same on every machine.
class Draw {
public:
    explicit Draw(std::uint64_t seed) : bits_(seed) {}
    double uniform(double from, double to)
    {
        return from + (to - from) * static_cast<double>(bits_() >> 11) * 0x1p-53;
    }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_() % n); }
    Vec3 in_cube() // in this order, as the compiler may evaluate arguments in any
    {
        const double x = uniform(-1, 1);
        const double y = uniform(-1, 1);
        return {x, y, uniform(-1, 1)};
    }
    double magnitude(double from, double to) { return std::pow(10.0, uniform(from, to)); }

private:
    std::mt19937_64 bits_;
};

/// Half the extents of a box. One in four has no volume, and one in eight is a point.
Vec3 half_extents(Draw& draw)
{
    const double size = draw.magnitude(-6, -0.5);
    Vec3 half = size * (draw.in_cube() + 1.0);
    const std::size_t choice = draw.below(8);
    if (choice < 2) half[static_cast<int>(draw.below(3))] = 0;
    if (choice == 2) half = Vec3(0);
    return half;
}

Vec3 place_in_grid(std::size_t i, std::size_t n)
{
    std::size_t side = 1;
    while (side * side * side < n) ++side;
    const std::size_t layer = i / (side * side);
    return Vec3(static_cast<double>(i % side), static_cast<double>(i / side % side),
                static_cast<double>(layer));
}

/// What all boxes of a set have in common.
struct Set {
    InputKind kind;
    std::size_t n;
    double smallest; // positive number
    Vec3 center;
    Vec3 half;
};

Aabb one_box(const Set& set, std::size_t i, Draw& draw)
{
    Vec3 center = draw.in_cube();
    Vec3 half = half_extents(draw);
    double scale = 1;
    switch (set.kind) {
    case InputKind::grid:
        center = place_in_grid(i, set.n) + 0.5;
        half = Vec3(0.5);
        break;
    case InputKind::clustered:
        center = Vec3(static_cast<double>(draw.below(3))) + 1e-6 * center;
        half *= 1e-6;
        break;
    case InputKind::coincident:
        center = set.center;
        half = set.half;
        break;
    case InputKind::concentric:
        center = Vec3(0);
        break;
    case InputKind::flat:
        center.y = set.center.y;
        break;
    case InputKind::collinear:
        center = Vec3(set.center.x, set.center.y, center.z);
        break;
    case InputKind::geometric:
        center = Vec3(std::ldexp(1.0, -static_cast<int>(i % 120)));
        half = Vec3(0);
        break;
    case InputKind::giant:
        if (i == set.n / 2) return {Vec3(-1e3), Vec3(1e3)};
        half = 1e-3 * (half + 1e-3);
        break;
    case InputKind::huge:
        scale = 1e30;
        break;
    case InputKind::tiny:
        scale = 1e-30;
        break;
    case InputKind::denormal:
        scale = 100 * set.smallest;
        break;
    case InputKind::mixed:
        scale = draw.magnitude(-30, 30);
        break;
    case InputKind::empty:
    case InputKind::uniform:
    case InputKind::duplicated:
    case InputKind::infinite:
    case InputKind::nan:
        break;
    }
    return {scale * (center - half), scale * (center + half)};
}

double rounded_to_float(double x)
{
    return static_cast<float>(x);
}

/// Every coordinate rounded to the nearest float. Rounding is monotonic: no box becomes empty.
Aabb rounded_to_floats(Aabb box)
{
    for (int axis = 0; axis < 3; ++axis) {
        box.lower[axis] = rounded_to_float(box.lower[axis]);
        box.upper[axis] = rounded_to_float(box.upper[axis]);
    }
    return box;
}

/// Makes one coordinate NaN or infinite.
void spoil(Aabb& box, InputKind kind, Draw& draw)
{
    const int axis = static_cast<int>(draw.below(3));
    const bool upper = draw.below(2) == 0;
    const double infinity = std::numeric_limits<double>::infinity();
    double& coordinate = upper ? box.upper[axis] : box.lower[axis];
    coordinate = kind == InputKind::nan ? std::numeric_limits<double>::quiet_NaN()
                 : upper                ? infinity
                                        : -infinity;
}

} // namespace

std::string name(InputKind kind)
{
    constexpr std::array names = {"empty",      "uniform",    "grid", "clustered", "duplicated",
                                  "coincident", "concentric", "flat", "collinear", "geometric",
                                  "giant",      "huge",       "tiny", "denormal",  "mixed",
                                  "infinite",   "nan"};
    static_assert(names.size() == input_kinds.size());
    return names[static_cast<std::size_t>(kind)];
}

std::vector<Aabb> input_boxes(InputKind kind, std::size_t n, std::uint64_t seed, bool single_precision)
{
    if (kind == InputKind::empty) return {};
    Draw draw(seed);
    const double smallest = single_precision ? std::numeric_limits<float>::denorm_min()
                                             : std::numeric_limits<double>::denorm_min();
    const Vec3 center = draw.in_cube();
    const Set set{kind, n, smallest, center, half_extents(draw)};
    std::vector<Aabb> boxes;
    boxes.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (kind == InputKind::duplicated && i > 0 && draw.below(2) == 0) {
            boxes.push_back(boxes[draw.below(i)]);
            continue;
        }
        const Aabb box = one_box(set, i, draw);
        boxes.push_back(single_precision ? rounded_to_floats(box) : box);
    }
    if (n > 0 && (kind == InputKind::nan || kind == InputKind::infinite))
        spoil(boxes[draw.below(n)], kind, draw);
    return boxes;
}

} // namespace check
