#include "ref/trees/aabb.h"

#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>

namespace {

using ref::Aabb;
using ref::Vec3;
using trees_test::Random;

TEST(Aabb, TheEmptyBoxIsNeutralAndHasNoArea)
{
    const Aabb box{Vec3(-1, 2, 3), Vec3(4, 5, 6)};
    EXPECT_EQ(unite(Aabb{}, box), box);
    EXPECT_EQ(unite(box, Aabb{}), box);
    EXPECT_TRUE(is_empty(Aabb{}));
    EXPECT_EQ(half_area(Aabb{}), 0);
    EXPECT_EQ(half_area(box), 5 * 3 + 3 * 3 + 3 * 5);
    EXPECT_FALSE(ref::is_empty({Vec3(1), Vec3(1)})); // a point is a valid box
    for (int axis = 0; axis < 3; ++axis) {
        Aabb turned = box;
        std::swap(turned.lower[axis], turned.upper[axis]);
        EXPECT_TRUE(is_empty(turned)) << axis;
    }
}

TEST(Aabb, TheMiddleOfAFiniteBoxIsFiniteAndInIt) // half of the sum of 1e308 and 1.5e308 is infinite
{
    EXPECT_EQ(ref::centroid({Vec3(1e308), Vec3(1.5e308)}), Vec3(1.25e308));
    Random random(1);
    for (int kind = 0; kind < trees_test::kinds; ++kind)
        for (const Aabb& box : trees_test::boxes(static_cast<trees_test::Kind>(kind), 100, random)) {
            const Vec3 middle = centroid(box);
            for (int axis = 0; axis < 3; ++axis) {
                // Halving is exact except for denormal numbers, which are rounded to even: up by half
                // a step.
                const double step = std::numeric_limits<double>::denorm_min();
                EXPECT_GE(middle[axis], box.lower[axis] - step)
                    << trees_test::name(static_cast<trees_test::Kind>(kind));
                EXPECT_LE(middle[axis], box.upper[axis] + step)
                    << trees_test::name(static_cast<trees_test::Kind>(kind));
            }
        }
}

TEST(Aabb, BoxesApartHaveAnEmptyIntersection)
{
    const Aabb left{Vec3(0), Vec3(1)};
    EXPECT_TRUE(is_empty(intersection(left, {Vec3(2, 0, 0), Vec3(3, 1, 1)})));
    EXPECT_EQ(intersection(left, {Vec3(0.5, -1, 0.25), Vec3(3, 2, 0.75)}),
              (Aabb{Vec3(0.5, 0, 0.25), Vec3(1, 1, 0.75)}));
}

} // namespace
