#include "images/png.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <stb_image.h>

#include <cmath>
#include <limits>
#include <memory>

namespace {

using images::Image;
using images::Rgb;
using images::Srgb8;
using images::to_srgb8;
using namespace images_test;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

int grey(double linear, double exposure = 0.0)
{
    const Srgb8 color = to_srgb8(Rgb(linear), exposure);
    EXPECT_EQ(color[0], color[1]);
    EXPECT_EQ(color[1], color[2]);
    return color[0];
}

/// The standard's other direction, from the stored value to linear light. [IEC 61966-2-1]
double decode_srgb(int code)
{
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(Srgb, KnownValues)
{
    EXPECT_EQ(grey(0.0), 0);
    EXPECT_EQ(grey(1.0), 255);
    EXPECT_EQ(grey(0.5), 188);  // 187.516
    EXPECT_EQ(grey(0.18), 118); // 117.646
    EXPECT_EQ(grey(0.002), 7);  // 6.589 on the linear toe; the power law alone would give 6.17
    EXPECT_EQ(grey(0.001), 3);  // 3.295
}

TEST(Srgb, EveryCodeIsTheEncodingOfItsOwnDecoding)
{
    for (int code = 0; code < 256; ++code) EXPECT_EQ(grey(decode_srgb(code)), code);
}

TEST(Srgb, RoundsToTheNearestCode)
{
    // Halfway between two codes, in stored values, by a margin that hides the rounding of pow.
    for (int code = 0; code < 255; ++code) {
        const double middle = (code + 0.5) / 255.0;
        const double linear =
            middle <= 0.04045 ? middle / 12.92 : std::pow((middle + 0.055) / 1.055, 2.4);
        EXPECT_EQ(grey(linear * (1.0 - 1e-6)), code);
        EXPECT_EQ(grey(linear * (1.0 + 1e-6)), code + 1);
    }
}

TEST(Srgb, WhatCannotBeShownIsClippedOrMarked)
{
    EXPECT_EQ(grey(1e30), 255);
    EXPECT_EQ(grey(infinity), 255);
    EXPECT_EQ(grey(-1.0), 0);
    EXPECT_EQ(grey(-infinity), 0);
    EXPECT_EQ(grey(-0.0), 0);
    EXPECT_EQ(grey(0.0, 2000.0), 0);
    EXPECT_EQ(grey(1.0, 2000.0), 255);
    EXPECT_EQ(to_srgb8(Rgb(nan, 0.0, 0.0), 0.0), images::nan_color);
    EXPECT_EQ(to_srgb8(Rgb(0.0, nan, infinity), 0.0), images::nan_color);
    EXPECT_EQ(to_srgb8(Rgb(1.0, 0.0, nan), 0.0), images::nan_color);
}

RC_GTEST_PROP(Srgb, AStopOfExposureIsAFactorOfTwo, ())
{
    const double linear = *rc::gen::inRange(0, 1 << 20) / 1048576.0;
    const int stops = *rc::gen::inRange(-8, 9);
    RC_ASSERT(grey(linear, stops) == grey(std::ldexp(linear, stops)));
}

RC_GTEST_PROP(Png, DecodesToTheColoursOfItsPixels, ())
{
    const TemporaryFolder folder;
    const Image image =
        any_image(rc::gen::map(rc::gen::inRange(-50, 1100), [](int i) { return i / 1000.0; }));
    images::write_png(folder / "a.png", image, 0.5);

    int columns = 0;
    int rows = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load((folder / "a.png").c_str(), &columns, &rows, &channels, 0), stbi_image_free);
    RC_ASSERT(pixels != nullptr);
    RC_ASSERT(columns == image.width);
    RC_ASSERT(rows == image.height);
    RC_ASSERT(channels == 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Srgb8 color = to_srgb8(image.pixels[i], 0.5);
        for (std::size_t channel = 0; channel < 3; ++channel)
            RC_ASSERT(pixels.get()[3 * i + channel] == color[channel]);
    }
}

} // namespace
