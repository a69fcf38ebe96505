// The arithmetic that truths are computed with.

#include "extremes/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace extremes {

TEST(Exact, HasSixtyDigits)
{
    const auto less_than = [](const Exact& error, double bound) {
        return abs(error).to_double() < bound;
    };
    EXPECT_TRUE(less_than(Exact(1) / 3 * 3 - 1, 1e-59));
    EXPECT_EQ((1 + Exact(0x1p-190) - 1).to_double(), 0x1p-190);
    EXPECT_TRUE(less_than(sqrt(Exact(2)) * sqrt(Exact(2)) - 2, 1e-58));
    EXPECT_TRUE(less_than(tan(Exact::pi() / 4) - 1, 1e-58));
    EXPECT_EQ(Exact::pi().to_double(), std::numbers::pi);
    // pi - (the nearest double) = 1.2246467991473531772...e-16
    EXPECT_EQ((Exact::pi() - std::numbers::pi).to_double(), 1.2246467991473532e-16);
}

TEST(Exact, ConvertsAllNumbersExactly)
{
    const std::uint64_t odd = (std::uint64_t{1} << 63) + 1;
    EXPECT_EQ((Exact(odd) - std::ldexp(1.0, 63)).to_double(), 1.0);
    for (const double x : {1e308, -1e-300, std::numeric_limits<double>::denorm_min(), 0.1, 0.0})
        EXPECT_EQ(Exact(x).to_double(), x);
    // No double leaves the range, nor does the product of several.
    const Exact huge = Exact(1e308) * 1e308 * 1e308;
    EXPECT_EQ((huge / 1e308 / 1e308).to_double(), 1e308);
}

TEST(Exact, Compares)
{
    const Exact third = Exact(1) / 3;
    EXPECT_LT(third, Exact(0.34));
    EXPECT_GT(third, 0.33);
    EXPECT_LE(third, third);
    EXPECT_GE(-third, -1);
    EXPECT_FALSE(third == 1.0 / 3.0);
    EXPECT_TRUE(abs(-third) == third);
    Exact copy = third;
    copy -= 1;
    copy += 1;
    EXPECT_LT(abs(copy - third), 1e-59);
    const ExactVec3 v(scenes::Vec3(1, 2, 2));
    EXPECT_EQ(length(v).to_double(), 3.0);
    EXPECT_EQ(in_doubles(cross(v, ExactVec3(scenes::Vec3(0, 0, 1)))), scenes::Vec3(2, -1, 0));
    EXPECT_EQ(relative_error(1.5, Exact(1)), 0.5);
}

} // namespace extremes
