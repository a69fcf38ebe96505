#include "scenes/polygons/orientation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>

namespace {

using boost::multiprecision::cpp_int;
using scenes::polygons::is_between;
using scenes::polygons::is_in_wedge;
using scenes::polygons::orientation;
using scenes::polygons::Point;

/// A number with up to 53 digits before and after the binary point, stored as whole numbers.
struct Exact {
    std::int64_t digits;
    int exponent; // 0 or more
    [[nodiscard]] double as_double() const
    {
        return std::ldexp(static_cast<double>(digits), exponent - 200);
    }
    [[nodiscard]] cpp_int as_integer() const { return cpp_int(digits) << exponent; }
};

struct ExactPoint {
    Exact x, y;
    [[nodiscard]] Point as_point() const { return {x.as_double(), y.as_double()}; }
};

int exactly(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c)
{
    const cpp_int det = (b.x.as_integer() - a.x.as_integer()) * (c.y.as_integer() - a.y.as_integer()) -
                        (b.y.as_integer() - a.y.as_integer()) * (c.x.as_integer() - a.x.as_integer());
    return det.sign();
}

ExactPoint any_point()
{
    const auto number = [] {
        return Exact{*rc::gen::inRange<std::int64_t>(-(1LL << 53), 1LL << 53),
                     *rc::gen::element(0, 0, 1, 30, 200)};
    };
    return {number(), number()};
}

RC_GTEST_PROP(Orientation, IsThatOfWholeNumbersOfAnySize, ())
{
    const ExactPoint a = any_point();
    const ExactPoint b = any_point();
    const ExactPoint c = any_point();
    RC_ASSERT(orientation(a.as_point(), b.as_point(), c.as_point()) == exactly(a, b, c));
}

// Points in line; one of them is moved by its last digit or not at all. Doubles alone cannot tell these
// cases apart.
RC_GTEST_PROP(Orientation, SeesTheLastDigit, ())
{
    const std::int64_t most = 1LL << 45;
    const auto digits = [&] { return *rc::gen::inRange<std::int64_t>(-most, most); };
    const int exponent = *rc::gen::element(0, 100);
    const std::int64_t ax = digits();
    const std::int64_t ay = digits();
    const std::int64_t dx = digits() / 100;
    const std::int64_t dy = digits() / 100;
    const std::int64_t steps = *rc::gen::inRange(-100, 100);
    const auto point = [&](std::int64_t x, std::int64_t y) {
        return ExactPoint{{x, exponent}, {y, exponent}};
    };
    const ExactPoint a = point(ax, ay);
    const ExactPoint b = point(ax + dx, ay + dy);
    const ExactPoint c = point(ax + steps * dx + *rc::gen::inRange(-1, 2), ay + steps * dy);
    const int right = exactly(a, b, c);
    RC_ASSERT(orientation(a.as_point(), b.as_point(), c.as_point()) == right);
    RC_ASSERT(orientation(b.as_point(), c.as_point(), a.as_point()) == right);
    RC_ASSERT(orientation(c.as_point(), b.as_point(), a.as_point()) == -right);
}

// The example of L. Kettner et al., "Classroom Examples of Robustness Problems in Geometric
// Computations" (2008): differences of coordinates of different size are rounded, and in doubles the
// determinant gets the wrong sign.
TEST(Orientation, IsRightWhereDifferencesAreRounded)
{
    const ExactPoint q{{12, 53}, {12, 53}};
    const ExactPoint r{{24, 53}, {24, 53}};
    for (std::int64_t x = 0; x < 64; ++x)
        for (std::int64_t y = 0; y < 64; ++y) {
            const ExactPoint p{{(1LL << 52) + x, 0}, {(1LL << 52) + y, 0}};
            ASSERT_EQ(orientation(p.as_point(), q.as_point(), r.as_point()), exactly(p, q, r))
                << x << " " << y;
            ASSERT_EQ(orientation(q.as_point(), r.as_point(), p.as_point()), exactly(p, q, r))
                << x << " " << y;
        }
}

TEST(Orientation, OfTheSmallestAndLargestCoordinates)
{
    const double small = 0x1p-400;
    const double large = 0x1p400;
    EXPECT_EQ(orientation({0, 0}, {small, 0}, {0, small}), 1);
    EXPECT_EQ(orientation({0, 0}, {large, 0}, {large, large}), 1);
    EXPECT_EQ(orientation({small, small}, {large, large}, {0, 0}), 0);
    EXPECT_EQ(orientation({small, small * (1 + 0x1p-52)}, {large, large}, {0, 0}), -1);
}

TEST(IsBetween, OnlyWhatLiesStrictlyBetween)
{
    EXPECT_TRUE(is_between({0, 0}, {1, 2}, {2, 4}));
    EXPECT_TRUE(is_between({2, 4}, {1, 2}, {0, 0}));
    EXPECT_TRUE(is_between({0, 0}, {0, 1}, {0, 2}));
    EXPECT_FALSE(is_between({0, 0}, {0, 0}, {2, 4}));
    EXPECT_FALSE(is_between({0, 0}, {2, 4}, {2, 4}));
    EXPECT_FALSE(is_between({0, 0}, {3, 6}, {2, 4}));
    EXPECT_FALSE(is_between({1, 1}, {1, 1}, {1, 1}));
}

// Directions on a circle of 16: the wedge from `next` turning left to `previous`, by counting steps.
TEST(IsInWedge, IsWhatLiesOnTheLeftOfTheWay)
{
    const Point circle[16] = {{4, 0},  {4, 2},   {4, 4},   {2, 4},   {0, 4},  {-2, 4}, {-4, 4}, {-4, 2},
                              {-4, 0}, {-4, -2}, {-4, -4}, {-2, -4}, {0, -4}, {2, -4}, {4, -4}, {4, -2}};
    const Point at(1, 1);
    for (int next = 0; next < 16; ++next)
        for (int width = 1; width <= 16; ++width) // 16: straight back, a wedge of a whole turn
            for (int target = 0; target < 16; ++target) {
                const int turned = (target - next + 16) % 16;
                EXPECT_EQ(is_in_wedge(at + circle[(next + width) % 16], at, at + circle[next],
                                      at + 3.0 * circle[target]),
                          turned > 0 && turned < width)
                    << next << " " << width << " " << target;
            }
}

} // namespace
