#include "check/trees/shrink_boxes.h"

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace check {

namespace {

using Boxes = std::vector<ref::Aabb>;

/// The set without one of its parts: without all, then without each half, each quarter, and so on down
/// to single boxes. (RapidCheck's removeChunks tries every length: n^2 sets.)
class WithoutParts {
public:
    explicit WithoutParts(const Boxes& boxes) : boxes_(boxes), length_(boxes.size()) {}

    rc::Maybe<Boxes> operator()()
    {
        if (length_ == 0) return rc::Nothing;
        const std::size_t end = std::min(begin_ + length_, boxes_.size());
        Boxes rest;
        rest.reserve(boxes_.size() - (end - begin_));
        rest.insert(rest.end(), boxes_.begin(), boxes_.begin() + static_cast<std::ptrdiff_t>(begin_));
        rest.insert(rest.end(), boxes_.begin() + static_cast<std::ptrdiff_t>(end), boxes_.end());
        begin_ = end;
        if (begin_ >= boxes_.size()) {
            begin_ = 0;
            length_ = length_ == 1 ? 0 : (length_ + 1) / 2;
        }
        return rest;
    }

private:
    Boxes boxes_;
    std::size_t begin_ = 0;
    std::size_t length_;
};

void for_each_coordinate(Boxes& boxes, const auto& change)
{
    for (ref::Aabb& box : boxes)
        for (int axis = 0; axis < 3; ++axis) {
            change(box.lower[axis], axis);
            change(box.upper[axis], axis);
        }
}

/// The set with every coordinate replaced by its rank among those of its axis: 0, 1, 2, ... Order and
/// ties stay. NaN and infinite ones stay as they are.
Boxes ranks(Boxes boxes)
{
    std::array<std::vector<double>, 3> values;
    for_each_coordinate(boxes, [&](double x, int axis) {
        if (std::isfinite(x)) values[static_cast<std::size_t>(axis)].push_back(x);
    });
    for (std::vector<double>& of_axis : values) {
        std::ranges::sort(of_axis);
        of_axis.erase(std::unique(of_axis.begin(), of_axis.end()), of_axis.end());
    }
    for_each_coordinate(boxes, [&](double& x, int axis) {
        const std::vector<double>& of_axis = values[static_cast<std::size_t>(axis)];
        if (std::isfinite(x))
            x = static_cast<double>(std::ranges::lower_bound(of_axis, x) - of_axis.begin());
    });
    return boxes;
}

/// The set with one axis, or all, flattened to 0.
Boxes flattened(Boxes boxes, int from, int to)
{
    for_each_coordinate(boxes, [&](double& x, int axis) {
        if (axis >= from && axis <= to && std::isfinite(x)) x = 0;
    });
    return boxes;
}

/// The set with all boxes replaced by their lower corners.
Boxes points(Boxes boxes)
{
    for (ref::Aabb& box : boxes)
        for (int axis = 0; axis < 3; ++axis)
            if (box.lower[axis] <= box.upper[axis]) box.upper[axis] = box.lower[axis];
    return boxes;
}

Boxes rounded(Boxes boxes)
{
    for_each_coordinate(boxes, [](double& x, int) { x = std::round(x); });
    return boxes;
}

/// Whether all bits agree: NaN equals itself.
bool same(std::span<const ref::Aabb> a, std::span<const ref::Aabb> b)
{
    return std::ranges::equal(std::as_bytes(a), std::as_bytes(b));
}

/// Simpler values for one box: at the origin, and a point. Each is simpler than those after it and than
/// the box, so that shrinking comes to an end.
Boxes simpler(const ref::Aabb& box)
{
    Boxes result = {{ref::Vec3(0), ref::Vec3(0)}};
    bool zeros_and_ones = true;
    Boxes one = {box};
    for_each_coordinate(one,
                        [&](double x, int) { zeros_and_ones = zeros_and_ones && (x == 0 || x == 1); });
    if (!zeros_and_ones) result.push_back({ref::Vec3(0), ref::Vec3(1)});
    result.push_back(points(one).front());
    for (int axis = 0; axis < 3; ++axis) result.push_back(flattened(one, axis, axis).front());
    return result;
}

/// The set with all boxes simpler, then, if there are few, with one box simpler.
std::vector<Boxes> with_simpler_boxes(const Boxes& boxes)
{
    constexpr std::size_t many = 4096;
    constexpr std::size_t few = 64;
    std::vector<Boxes> result;
    if (boxes.size() > many) return result;
    const auto add = [&](Boxes other) {
        if (!same(other, boxes)) result.push_back(std::move(other));
    };
    add(flattened(boxes, 0, 2));
    for (int axis = 0; axis < 3; ++axis) add(flattened(boxes, axis, axis));
    add(points(boxes));
    const Boxes by_rank = ranks(boxes);
    add(by_rank);
    if (!same(by_rank, boxes)) add(rounded(boxes)); // ranks are whole numbers already
    if (boxes.size() > few) return result;
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (const ref::Aabb& box : simpler(boxes[i])) {
            Boxes other = boxes;
            other[i] = box;
            add(std::move(other));
        }
    return result;
}

} // namespace

ShrunkBoxes shrink_boxes(std::vector<ref::Aabb> boxes,
                         const std::function<bool(const std::vector<ref::Aabb>&)>& fails,
                         const std::function<bool()>& give_up)
{
    const auto shrinkable = rc::shrinkable::shrinkRecur(std::move(boxes), [](const Boxes& larger) {
        return rc::seq::concat(rc::makeSeq<WithoutParts>(larger),
                               rc::seq::fromContainer(with_simpler_boxes(larger)));
    });
    ShrunkBoxes result{shrinkable.value()};
    struct GaveUp {};
    try {
        rc::shrinkable::findLocalMin(shrinkable, [&](const Boxes& smaller) {
            if (give_up()) throw GaveUp{}; // to go on without a try would still make every smaller set
            ++result.tries;
            const bool fails_still = fails(smaller);
            if (fails_still) result.boxes = smaller;
            return fails_still;
        });
    } catch (const GaveUp&) { // the smallest so far
    }
    return result;
}

} // namespace check
