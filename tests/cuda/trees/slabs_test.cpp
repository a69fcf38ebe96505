// The test of a ray against boxes: it misses none that the ray passes through, and enters none that is
// not there, for floats of every size.

#include "cuda/trees/slabs.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace {

using fast::Vec3;
using trees_test::Random;

constexpr float infinity = std::numeric_limits<float>::infinity();

/// A float around 1, of any size, or 0.
float any_float(Random& random, bool extreme)
{
    const double magnitude = extreme ? random.magnitude(-45, 38) : random.magnitude(-3, 0);
    const double sign = random.below(2) == 0 ? 1 : -1;
    return random.below(8) == 0 ? 0.0f : static_cast<float>(sign * magnitude);
}

Vec3 any_vector(Random& random, bool extreme)
{
    return {any_float(random, extreme), any_float(random, extreme), any_float(random, extreme)};
}

/// Up to eight boxes in a node; `count` of them are there.
struct Boxes {
    Boxes(Random& random, bool extreme) : count(1 + static_cast<int>(random.below(fast::most_children)))
    {
        for (int c = 0; c < fast::most_children; ++c) {
            const Vec3 a = any_vector(random, extreme);
            const Vec3 b = any_vector(random, extreme);
            boxes[c] = c < count ? fast::Aabb{glm::min(a, b), glm::max(a, b)} : fast::empty_aabb();
            root = unite(root, boxes[c]);
            for (int axis = 0; axis < 3; ++axis) {
                node.planes[axis][c] = boxes[c].lower[axis];
                node.planes[3 + axis][c] = boxes[c].upper[axis];
            }
        }
    }
    int count;
    fast::Aabb boxes[fast::most_children];
    fast::Aabb root = fast::empty_aabb();
    fast::WideNode node{};
};

/// The smallest t >= 0 at which the ray is in the box, in double.
std::optional<double> entry(const fast::Ray& ray, const fast::Aabb& box)
{
    double near = 0;
    double far = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        const double origin = ray.origin[axis];
        const double direction = ray.direction[axis];
        if (direction == 0) {
            if (origin < box.lower[axis] || origin > box.upper[axis]) return std::nullopt;
            continue;
        }
        const double first = (box.lower[axis] - origin) / direction;
        const double last = (box.upper[axis] - origin) / direction;
        near = std::max(near, std::min(first, last));
        far = std::min(far, std::max(first, last));
    }
    if (near > far) return std::nullopt;
    return near;
}

// The padding of 64 roundings of a float is far larger than the rounding of a double.
RC_GTEST_PROP(WideSlabs, EnterEveryBoxThatTheRayPassesThroughAndNoneThatIsAbsent, ()) // map: slabs
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    for (int i = 0; i < 200; ++i) {
        const bool extreme = random.below(2) == 0;
        const Boxes in(random, extreme);
        const fast::Ray ray{any_vector(random, extreme), infinity,
                            any_vector(random, random.below(2) == 0)};
        if (ray.direction == Vec3(0.0f)) continue; // no ray
        fast::Lanes near;
        const fast::SlabRay slab_ray(ray, in.root);
        const fast::LaneBits entered = fast::WideSlabs(slab_ray).entered(in.node, infinity, near);
        RC_ASSERT(entered >> in.count == 0u);
        for (int c = 0; c < in.count; ++c) {
            const std::optional<double> expected = entry(ray, in.boxes[c]);
            if (!expected || *expected > std::numeric_limits<float>::max()) continue;
            RC_ASSERT((entered >> c & 1) == 1u);
            // A hit at the entry is not excluded by its own t.
            RC_ASSERT(near[c] <= std::nextafter(static_cast<float>(*expected), infinity));
            float alone = 0;
            RC_ASSERT(fast::SlabsOf<float>(slab_ray).entered(in.boxes[c], infinity, alone));
            RC_ASSERT(alone == near[c]);
        }
    }
}

// The reciprocal of the smallest coordinate that is not replaced overflows, though no product with it
// does. A child that is absent must not be entered because of the NaN that comes of it.
TEST(WideSlabs, TinyDirectionsEnterNoAbsentChild)
{
    fast::WideNode node{};
    const fast::Aabb box{Vec3(-0x1p-4f), Vec3(0x1p-4f)};
    for (int c = 0; c < fast::most_children; ++c) {
        const fast::Aabb of_child = c == 0 ? box : fast::empty_aabb();
        for (int axis = 0; axis < 3; ++axis) {
            node.planes[axis][c] = of_child.lower[axis];
            node.planes[3 + axis][c] = of_child.upper[axis];
        }
    }
    for (int exponent = -149; exponent <= 0; ++exponent) {
        const float longest = std::ldexp(1.0f, exponent);
        for (const float origin : {0.0f, 0x1p-30f, 0.0465f, -0.06f})
            for (const float other : {0.0f, -0x1p-143f, 0x1p-126f}) {
                const fast::Ray ray{Vec3(origin, 0.0f, 0.0f), infinity, Vec3(longest, other, 0.0f)};
                fast::Lanes near;
                const fast::LaneBits entered =
                    fast::WideSlabs(fast::SlabRay(ray, box)).entered(node, infinity, near);
                EXPECT_EQ(entered, 1u) << longest << " from " << origin << ", beside " << other;
            }
    }
}

} // namespace
