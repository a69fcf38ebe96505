#include "golden/functionals.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace {

using golden::Functionals;
using golden::Pilot;
using golden::Region;
using golden::RegionKind;
using golden::Row;
using golden::Weight;
using images::Image;
using images::Rgb;

/// Half precision has 11 significant bits. Rounding to it changes a value by at most this, relatively.
constexpr double half_ulp = 0x1p-11;

/// A pilot of non-negative means, with noise of 0 to 4. Some pixels are black.
Pilot any_pilot(int width = 0, int height = 0)
{
    const auto mean = rc::gen::map(rc::gen::inRange(0, 100), [](int i) { return i / 8.0; });
    const auto noise = rc::gen::map(rc::gen::inRange(0, 64), [](int i) { return i / 16.0; });
    Pilot pilot{images_test::any_image(mean, width, height), {}, 50};
    pilot.noise = images_test::any_image(noise, pilot.mean.width, pilot.mean.height);
    for (std::size_t i = 0; i < pilot.mean.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (pilot.mean.pixels[i][c] == 0.0) pilot.noise.pixels[i][c] = 0.0;
    return pilot;
}

Pilot flat_pilot(int width, int height, double mean, double noise, std::uint64_t batches = 50)
{
    Pilot pilot{Image(width, height), Image(width, height), batches};
    std::fill(pilot.mean.pixels.begin(), pilot.mean.pixels.end(), Rgb(mean));
    std::fill(pilot.noise.pixels.begin(), pilot.noise.pixels.end(), Rgb(noise));
    return pilot;
}

/// The value of functional f before it was standardised.
double value_in(const Functionals& functionals, const Row& row, std::size_t f, std::size_t channel)
{
    return functionals.expected(f, channel) +
           functionals.spread(f, channel) * static_cast<double>(row[channel * functionals.size() + f]);
}

/// The rounding error of value_in: half a unit in the last place of the standardised value. That value
/// must not be clipped.
double rounding_of(const Functionals& functionals, const Row& row, std::size_t f, std::size_t channel)
{
    const double z = std::abs(static_cast<double>(row[channel * functionals.size() + f]));
    return functionals.spread(f, channel) * std::max(z * half_ulp, 0x1p-24); // 2^-24: a denormal half
}

RC_GTEST_PROP(Functionals, EveryPixelLiesInOneRegionOfEachKind, ())
{
    const Functionals functionals(any_pilot());
    const std::size_t pixels = functionals.pilot().mean.pixels.size();
    for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        std::map<RegionKind, int> found;
        for (std::size_t f = 0; f < functionals.size(); ++f) {
            const auto [region, weight] = functionals.at(f);
            if (weight == Weight::plain && functionals.pixel_weight(f, 0, pixel) != 0.0)
                ++found[functionals.regions()[region].kind];
        }
        RC_ASSERT(found.size() == 5u);
        for (const auto& [kind, count] : found) RC_ASSERT(count == 1);
    }
    std::map<RegionKind, std::size_t> sizes;
    for (const Region& region : functionals.regions()) {
        RC_ASSERT(region.pixels > 0u);
        sizes[region.kind] += region.pixels;
    }
    for (const auto& [kind, counted] : sizes) RC_ASSERT(counted == pixels);
}

TEST(Functionals, OfASquareOf128PixelsHaveTilesOf16And32AndSixteenStrata)
{
    const Functionals functionals(flat_pilot(128, 128, 1.0, 0.5));
    std::map<RegionKind, int> count;
    for (const Region& region : functionals.regions()) ++count[region.kind];
    EXPECT_EQ(count[RegionKind::whole], 1);
    EXPECT_EQ(count[RegionKind::coarse_tile], 16);
    EXPECT_EQ(count[RegionKind::fine_tile], 64);
    EXPECT_EQ(count[RegionKind::luminance], 16);
    EXPECT_EQ(count[RegionKind::noise], 16);
    EXPECT_EQ(functionals.size(), 3u * 113u);
}

RC_GTEST_PROP(Functionals, StrataAreOrderedAndOfEqualSize, ())
{
    const Functionals functionals(any_pilot());
    const auto key = [&](RegionKind kind, std::size_t pixel) {
        const Rgb m = functionals.pilot().mean.pixels[pixel];
        const Rgb d = functionals.pilot().noise.pixels[pixel] * m;
        const double sum = m.r + m.g + m.b;
        if (kind == RegionKind::luminance) return 0.2126 * m.r + 0.7152 * m.g + 0.0722 * m.b;
        return sum > 0.0 ? (d.r * d.r + d.g * d.g + d.b * d.b) / (sum * sum) : 0.0;
    };
    for (const RegionKind kind : {RegionKind::luminance, RegionKind::noise}) {
        double highest_so_far = -1.0;
        const std::size_t pixels = functionals.pilot().mean.pixels.size();
        const std::size_t share = pixels / std::min<std::size_t>(16, pixels);
        for (std::size_t r = 0; r < functionals.regions().size(); ++r) {
            const Region& region = functionals.regions()[r];
            if (region.kind != kind) continue;
            RC_ASSERT(region.pixels == share || region.pixels == share + 1);
            double low = std::numeric_limits<double>::infinity();
            double high = 0.0;
            for (std::size_t pixel = 0; pixel < pixels; ++pixel)
                if (functionals.pixel_weight(3 * r + 1, 0, pixel) != 0.0) {
                    low = std::min(low, key(kind, pixel));
                    high = std::max(high, key(kind, pixel));
                }
            RC_ASSERT(low >= highest_so_far * (1.0 - 1e-12)); // the same sums, in another order
            highest_so_far = high;
        }
    }
}

RC_GTEST_PROP(Functionals, ARelativeErrorOfThePictureIsOneOfEveryLinearFunctional, ())
{
    const Functionals functionals(any_pilot());
    const double factor = 1.0 + *rc::gen::inRange(-50, 51) / 100.0;
    Image batch = functionals.pilot().mean;
    for (Rgb& pixel : batch.pixels) pixel *= factor;
    const Row row = functionals.evaluate(batch);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t f = 0; f < functionals.size(); ++f) {
            if (!golden::is_linear(functionals.at(f).weight)) continue;
            const bool black = functionals.expected(f, c) == 0.0;
            // The tolerance: rounding to half precision, and rounding of at most 19 * 19 additions.
            RC_ASSERT(std::abs(value_in(functionals, row, f, c) - (black ? 0.0 : factor)) <=
                      rounding_of(functionals, row, f, c) + 1e-12);
        }
}

RC_GTEST_PROP(Functionals, LinearOnesAreTheWeightedSumsOverTheirPixels, ())
{
    const Functionals functionals(any_pilot());
    const Image batch = any_pilot(functionals.width(), functionals.height()).mean;
    const Row row = functionals.evaluate(batch);
    const auto c = static_cast<std::size_t>(*rc::gen::inRange(0, 3));
    for (std::size_t f = 0; f < functionals.size(); ++f) {
        if (!golden::is_linear(functionals.at(f).weight)) continue;
        double sum = 0.0;
        for (std::size_t i = 0; i < batch.pixels.size(); ++i)
            sum += functionals.pixel_weight(f, c, i) * batch.pixels[i][static_cast<int>(c)];
        const double z = (sum - functionals.expected(f, c)) / functionals.spread(f, c);
        if (std::abs(z) > 60'000.0) continue; // beyond the range of half precision
        RC_ASSERT(std::abs(value_in(functionals, row, f, c) - sum) <=
                  rounding_of(functionals, row, f, c) + 1e-12 * std::abs(sum));
    }
}

TEST(Functionals, NoSampleMovesTheBoundedOnesFarHoweverBright)
{
    const Functionals functionals(flat_pilot(16, 16, 1.0, 0.5));
    Image batch = functionals.pilot().mean;
    const Row before = functionals.evaluate(batch);
    batch.at(3, 3) = Rgb(1e30);
    const Row after = functionals.evaluate(batch);
    for (std::size_t f = 0; f < functionals.size(); ++f) {
        const auto [region, weight] = functionals.at(f);
        if (weight != Weight::bounded) continue;
        // One pixel of the region rises from m / (m + m) = 1/2 to at most 1.
        const double most = 0.5 / static_cast<double>(functionals.regions()[region].pixels);
        EXPECT_LE(value_in(functionals, after, f, 0) - value_in(functionals, before, f, 0),
                  most + rounding_of(functionals, after, f, 0));
    }
    EXPECT_GT(after[0], 1000.0F); // the matched functional of the whole picture is not bounded
}

TEST(Functionals, SlopesAreTheDerivativesOfTheBoundedOnesByBrightness)
{
    const Functionals functionals(flat_pilot(16, 16, 1.0, 0.5));
    Image batch(16, 16);
    for (std::size_t i = 0; i < batch.pixels.size(); ++i)
        batch.pixels[i] = Rgb(0.0, 0.01, 0.02) * static_cast<double>(i);
    const auto scaled = [&](double factor) {
        Image image = batch;
        for (Rgb& pixel : image.pixels) pixel *= factor;
        return functionals.evaluate(image);
    };
    const Row slopes = functionals.slopes(batch);
    constexpr double h = 0.125;
    const Row brighter = scaled(1.0 + h);
    const Row darker = scaled(1.0 - h);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t f = 0; f < functionals.size(); ++f) {
            const std::size_t at = c * functionals.size() + f;
            const auto slope = static_cast<double>(slopes[at]);
            if (golden::is_linear(functionals.at(f).weight)) {
                EXPECT_EQ(slope, 0.0);
                continue;
            }
            const double quotient =
                (static_cast<double>(brighter[at]) - static_cast<double>(darker[at])) / (2.0 * h);
            // b = 1 / (1 + m / c). With respect to log c, its derivative is at most 1/4 and its third
            // derivative at most 1/8. So the error of the quotient is at most h^2 / 48, and the relative
            // error of the logarithm is h^2 / 3. Besides, both values are rounded.
            const double rounding = (std::abs(static_cast<double>(brighter[at])) +
                                     std::abs(static_cast<double>(darker[at])) + 1.0) *
                                    half_ulp / (2.0 * h);
            EXPECT_NEAR(quotient, slope, 0.01 * slope + 0.01 + rounding);
            EXPECT_EQ(slope > 0.0, c > 0) << "a black picture stays black";
        }
}

TEST(Functionals, LightWhereThePilotIsBlackIsSeen)
{
    const Functionals functionals(flat_pilot(8, 8, 0.0, 0.0));
    Image batch(8, 8);
    const Row black = functionals.evaluate(batch);
    batch.at(1, 1) = Rgb(1e-3);
    const Row lit = functionals.evaluate(batch);
    EXPECT_EQ(black[1], 0.0F);
    EXPECT_GT(lit[1], black[1]); // plain
    EXPECT_GT(lit[2], black[2]); // bounded
}

TEST(Functionals, NoiseThatThePilotDidNotSeeIsAssumedByTheRuleOfThree)
{
    const Functionals functionals(flat_pilot(8, 8, 2.0, 0.0, 300));
    // v >= 3 m^2 / 300: the standard deviation of a pixel is a tenth of its mean. The mean is over 64
    // pixels.
    EXPECT_DOUBLE_EQ(functionals.spread(0, 0), 0.1 / 8.0);
    EXPECT_DOUBLE_EQ(functionals.spread(1, 0), 0.1 / 8.0);
}

TEST(Functionals, MatchedWeightsAreLargeWhereTheNoiseIsLow)
{
    Pilot pilot = flat_pilot(2, 1, 1.0, 1.0, 1'000'000);
    pilot.noise.pixels[1] = Rgb(2.0);
    const Functionals functionals(pilot);
    // The weights are m / v = 1 and 1/4, divided by their sum.
    EXPECT_DOUBLE_EQ(functionals.pixel_weight(0, 1, 0), 0.8);
    EXPECT_DOUBLE_EQ(functionals.pixel_weight(0, 1, 1), 0.2);
    EXPECT_DOUBLE_EQ(functionals.pixel_weight(1, 1, 0), 0.5);
}

TEST(Functionals, RefusePicturesThatDoNotFit)
{
    const Functionals functionals(flat_pilot(4, 3, 1.0, 1.0));
    using images_test::error_of;
    EXPECT_EQ(error_of<std::invalid_argument>([&] { (void)functionals.evaluate(Image(3, 4)); }),
              "has 3x4 pixels, the golden 4x3");
    Image batch(4, 3);
    batch.at(2, 1).g = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(error_of<std::invalid_argument>([&] { (void)functionals.evaluate(batch); }),
              "pixel (2, 1) is NaN or infinite");
    EXPECT_THROW(Functionals(Pilot{}), std::invalid_argument);
    EXPECT_THROW(Functionals(Pilot{Image(2, 2), Image(2, 3), 9}), std::invalid_argument);
    EXPECT_THROW(Functionals(Pilot{Image(2, 2), Image(2, 2), 0}), std::invalid_argument);
    EXPECT_THROW(Functionals(Pilot{batch, Image(4, 3), 9}), std::invalid_argument);
}

TEST(Pilot, HoldsMeanAndRelativeDeviationOfTheBatches)
{
    images::Film film(1, 1);
    EXPECT_THROW(golden::make_pilot(film), std::invalid_argument);
    for (const double value : {1.0, 3.0, 5.0}) {
        Image batch(1, 1);
        batch.pixels[0] = Rgb(value, 2.0 * value, 0.0);
        film.add_batch(batch);
    }
    const Pilot pilot = golden::make_pilot(film);
    EXPECT_EQ(pilot.batches, 3u);
    EXPECT_EQ(pilot.mean.pixels[0], Rgb(3.0, 6.0, 0.0));
    EXPECT_NEAR(pilot.noise.pixels[0].r, 2.0 / 3.0, half_ulp);
    EXPECT_NEAR(pilot.noise.pixels[0].g, 2.0 / 3.0, half_ulp);
    EXPECT_EQ(pilot.noise.pixels[0].b, 0.0);
}

} // namespace
