// The fast path's sine and cosine: one form for one number and for many. Which colours are black.

#include "cuda/transport/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

// 2^-24 is the unit roundoff of floats. The polynomials, their rounding and that of the angle add up to
// less than twice that; a cosine near 1 is itself rounded by half of it.
TEST(OnCircle, ErrsByLessThanTwoRoundingsForEveryNumber)
{
    double worst = 0;
    for (std::uint32_t i = 0; i < 1u << 24; i += 7) {
        const float u = static_cast<float>(i) * 0x1p-24f;
        float x = 0;
        float y = 0;
        fast::on_circle(1.0f, u, x, y);
        const double phi = 2.0 * std::numbers::pi * static_cast<double>(u);
        worst = std::max({worst, std::abs(x - std::cos(phi)), std::abs(y - std::sin(phi))});
    }
    EXPECT_LT(worst, 0x1p-23);
}

TEST(OnCircle, IsExactAtTheQuarters)
{
    for (int quarter = 0; quarter < 4; ++quarter) {
        float x = 0;
        float y = 0;
        fast::on_circle(3.0f, 0.25f * static_cast<float>(quarter), x, y);
        EXPECT_EQ(x, quarter == 0 ? 3.0f : quarter == 2 ? -3.0f : 0.0f);
        EXPECT_EQ(y, quarter == 1 ? 3.0f : quarter == 3 ? -3.0f : 0.0f);
    }
}

// A black throughput ends a walk, so each channel must count.
TEST(IsBlack, IsTheColourWithoutLightInAnyChannel)
{
    EXPECT_TRUE(fast::is_black(fast::Vec3(0.0f)));
    for (int channel = 0; channel < 3; ++channel) {
        fast::Vec3 color(0.0f);
        color[channel] = 0x1p-149f; // the smallest float
        EXPECT_FALSE(fast::is_black(color)) << "channel " << channel;
    }
}

} // namespace
