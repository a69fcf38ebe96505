#include "images/film.h"
#include "tests/images/picture_generators.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

using images::Film;
using images::Image;
using images::Rgb;

Image one_pixel(double value)
{
    Image image(1, 1);
    image.pixels[0] = Rgb(value, 2.0 * value, -value);
    return image;
}

TEST(Film, MeanAndStandardErrorOfFourBatchesAreThoseOfTheTextbook) // map: welford, standard-error
{
    Film film(1, 1);
    for (const double batch : {1.0, 2.0, 3.0, 4.0}) film.add_batch(one_pixel(batch));
    EXPECT_EQ(film.batches(), 4u);
    EXPECT_EQ(film.mean().pixels[0], Rgb(2.5, 5.0, -2.5));
    // Variance of the batches 5/3, of their mean 5/12; powers of two scale it without rounding.
    EXPECT_DOUBLE_EQ(film.standard_error().pixels[0].r, std::sqrt(5.0 / 12.0));
    EXPECT_DOUBLE_EQ(film.standard_error().pixels[0].g, 2.0 * std::sqrt(5.0 / 12.0));
    EXPECT_DOUBLE_EQ(film.standard_error().pixels[0].b, std::sqrt(5.0 / 12.0));
}

TEST(Film, FewerThanTwoBatchesSayNothingAboutTheError)
{
    Film film(1, 1);
    EXPECT_EQ(film.standard_error().pixels[0].r, std::numeric_limits<double>::infinity());
    film.add_batch(one_pixel(3.0));
    EXPECT_EQ(film.standard_error().pixels[0].g, std::numeric_limits<double>::infinity());
    film.add_batch(one_pixel(3.0));
    EXPECT_EQ(film.standard_error().pixels[0].b, 0.0);
}

// The comparison is with the sums computed in two passes, in 64-bit significands. With u = 2^-53,
// |x| <= M and all x within a range R, to first order in u:
// - A step rounds the mean by at most u M + 2 u R / k, and later steps shrink that by k/n: the mean's
//   error is at most e_k = u (M (k + 1) / 2 + 2 R).
// - A step adds a product whose factors are off by e_k and e_(k-1), with three roundings of at most R^2
//   and one of the sum, at most k R^2 / 4: in total u (R M (n^2 / 2 + 3 n) + R^2 (7 n + n^2 / 8)).
// Both are doubled for the higher orders, which are smaller by a factor of n u.
RC_GTEST_PROP(Film, AgreesWithTwoPassesInHigherPrecision, ()) // map: welford
{
    const auto spread = *rc::gen::element(1e-6, 1.0, 1e6);
    const auto offset = *rc::gen::element(0.0, 1.0, -1e8);
    const auto draws =
        *rc::gen::resize(200, rc::gen::nonEmpty(rc::gen::container<std::vector<std::int32_t>>(
                                  rc::gen::resize(100, rc::gen::arbitrary<std::int32_t>()))));
    std::vector<double> batches;
    for (const std::int32_t draw : draws) batches.push_back(offset + spread * std::ldexp(draw, -31));

    Film film(1, 1);
    for (const double batch : batches) film.add_batch(one_pixel(batch));

    long double sum = 0.0L;
    for (const double batch : batches) sum += batch;
    const auto n = static_cast<double>(batches.size());
    const long double mean = sum / n;
    long double squares = 0.0L;
    for (const double batch : batches) squares += (batch - mean) * (batch - mean);

    const auto [low, high] = std::minmax_element(batches.begin(), batches.end());
    const double r = *high - *low;
    const double m = std::max(std::abs(*low), std::abs(*high));
    const double u = std::ldexp(1.0, -53);
    const double mean_bound = 2.0 * u * (m * (n + 1.0) / 2.0 + 2.0 * r);
    const double squares_bound =
        2.0 * u * (r * m * (n * n / 2.0 + 3.0 * n) + r * r * (7.0 * n + n * n / 8.0));
    RC_ASSERT(std::abs(film.mean().pixels[0].r - static_cast<double>(mean)) <= mean_bound);
    RC_ASSERT(std::abs(film.squares().pixels[0].r - static_cast<double>(squares)) <= squares_bound);
}

RC_GTEST_PROP(Film, GoingOnFromAStateGivesTheBitsOfAnUninterruptedRun, ())
{
    const int count = *rc::gen::inRange(1, 8);
    const int interruption = *rc::gen::inRange(0, count + 1);
    const auto value = rc::gen::map(rc::gen::arbitrary<std::int32_t>(), [](int i) { return i / 7.0; });
    std::vector<Image> batches;
    for (int i = 0; i < count; ++i) batches.push_back(images_test::any_image(value, 3, 2));

    Film whole(3, 2);
    for (const Image& batch : batches) whole.add_batch(batch);
    Film first(3, 2);
    for (int i = 0; i < interruption; ++i) first.add_batch(batches[static_cast<std::size_t>(i)]);
    Film second(first.mean(), first.squares(), first.batches());
    for (int i = interruption; i < count; ++i) second.add_batch(batches[static_cast<std::size_t>(i)]);
    RC_ASSERT(second == whole);
}

TEST(Film, AnotherSizeIsRefused)
{
    Film film(2, 3);
    EXPECT_THROW(film.add_batch(Image(3, 2)), std::invalid_argument);
    EXPECT_EQ(film.batches(), 0u);
    EXPECT_THROW(Film(Image(2, 3), Image(3, 2), 1), std::invalid_argument);
}

TEST(FirstNonFinite, IsFoundRowByRowInAnyChannel)
{
    Image image(3, 2);
    EXPECT_EQ(images::first_non_finite(image), std::nullopt);
    image.at(0, 1).b = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(images::first_non_finite(image), (images::PixelPosition{0, 1}));
    image.at(2, 0).g = -std::numeric_limits<double>::infinity();
    EXPECT_EQ(images::first_non_finite(image), (images::PixelPosition{2, 0}));
}

} // namespace
