// Expected values: the authors' own evaluator (flip-evaluator 1.7) on the same pictures, given as
// float32.

#include "images/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace {

using images::Image;
using images::Rgb;

constexpr int width = 30;
constexpr int height = 20;

template <class F>
Image paint(F&& colour)
{
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) image.at(x, y) = colour(x, y);
    return image;
}

Rgb waves(int x, int y)
{
    return {0.5 + 0.5 * std::sin(x / 5.0), 0.5 + 0.5 * std::cos(y / 7.0), (x / 6 + y / 6) % 2 * 0.8};
}

Rgb other_waves(int x, int y)
{
    const Rgb a = waves(x, y);
    return {0.8 * a.x, a.y, std::clamp(a.z + 0.1 * std::sin(x + 2.0 * y), 0.0, 1.0)};
}

double light(int x, int y)
{
    return std::exp(3.0 * std::sin(x / 11.0 + y / 9.0));
}

double mean_of(const images::ErrorMap& map)
{
    return std::accumulate(map.begin(), map.end(), 0.0) / static_cast<double>(map.size());
}

double at(const images::ErrorMap& map, int x, int y)
{
    return map[static_cast<std::size_t>(y * width + x)];
}

/// The authors' evaluator uses float: a feature difference that should be 0 is about 1e-7, its square
/// root 3e-4, and the error E^(1 - 3e-4) differs from E by at most max(-E ln E) 3e-4 = 1.1e-4.
constexpr double float_noise = 1.5e-4;

TEST(Flip, AgreesWithTheAuthorsOnDisplayedPictures)
{
    const images::ErrorMap map = images::flip_of_displayed(paint(waves), paint(other_waves));
    EXPECT_NEAR(mean_of(map), 0.216917, float_noise);
    EXPECT_NEAR(*std::max_element(map.begin(), map.end()), 0.341375, float_noise);
    EXPECT_NEAR(at(map, 7, 3), 0.233790, float_noise);
    EXPECT_NEAR(at(map, 29, 19), 0.157825, float_noise); // filters at the border
    EXPECT_NEAR(at(map, 0, 10), 0.229952, float_noise);
}

TEST(Flip, AgreesWithTheAuthorsOnRadiances)
{
    const auto lit = [](auto&& colour) {
        return paint([&](int x, int y) { return colour(x, y) * light(x, y) + 0.01; });
    };
    const Image reference = lit(waves);
    const auto [start, stop, count] = images::flip_exposures(reference);
    // Their luminance has 0.0721802 of blue, ours 0.0721923: log2(1 + 1.7e-4) = 2.5e-4 at most.
    EXPECT_NEAR(start, -3.0724800, 2.5e-4);
    EXPECT_NEAR(stop, -0.6713588, 2.5e-4);
    EXPECT_EQ(count, 3);
    const images::ErrorMap map = images::flip(reference, lit(other_waves));
    EXPECT_NEAR(mean_of(map), 0.206609, float_noise);
    EXPECT_NEAR(*std::max_element(map.begin(), map.end()), 0.514107, float_noise);
    EXPECT_NEAR(at(map, 7, 3), 0.200170, float_noise);
    EXPECT_NEAR(at(map, 29, 19), 0.012726, float_noise);
    EXPECT_NEAR(at(map, 0, 10), 0.228627, float_noise);
}

TEST(Flip, OfAPictureWithItselfIsZero)
{
    for (const double e : images::flip(paint(waves), paint(waves))) EXPECT_EQ(e, 0.0);
}

TEST(Flip, OfGreenAndBlueIsOne)
{
    // The largest possible difference, by construction. Flat pictures have no features that could
    // differ.
    const auto map = images::flip_of_displayed(paint([](int, int) { return Rgb(0.0, 1.0, 0.0); }),
                                               paint([](int, int) { return Rgb(0.0, 0.0, 1.0); }));
    for (const double e : map) EXPECT_NEAR(e, 1.0, 1e-6); // rounding of the filters, raised to powers
}

TEST(Flip, StaysBetweenZeroAndOneOnHardPictures)
{
    const auto black = [](int, int) { return Rgb(0.0); };
    const auto spark = [](int x, int y) { return Rgb(x == 3 && y == 4 ? 1e300 : 0.0); };
    const auto below = [](int x, int) { return Rgb(-1.0 * x); };
    for (const auto& [a, b] : {std::pair(paint(black), paint(spark)),
                               {paint(spark), paint(black)},
                               {paint(below), paint(waves)},
                               {paint(waves), paint(below)},
                               {paint(spark), paint(spark)}})
        for (const double e : images::flip(a, b)) {
            EXPECT_GE(e, 0.0);
            EXPECT_LE(e, 1.0);
        }
}

TEST(Flip, PicturesThatCannotBeComparedAreErrors)
{
    EXPECT_THROW(images::flip(Image(3, 2), Image(2, 3)), std::invalid_argument);
    Image broken(2, 2);
    broken.pixels[3].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(images::flip(broken, Image(2, 2)), std::invalid_argument);
    EXPECT_THROW(images::flip(Image(2, 2), broken), std::invalid_argument);
}

} // namespace
