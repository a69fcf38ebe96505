#include "images/film.h"
#include "tests/images/picture_generators.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
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

TEST(Film, MeanAndStandardErrorOfFourBatchesAreThoseOfTheTextbook) // map: moments, standard-error
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
// |x| <= M, all x within a range R, and at most L joins between a batch and the total, to first order in
// u:
// - A join of m and n batches rounds the mean by at most u (M + 3 R), and averages the errors of its
// halves:
//   the mean's error is at most e = L u (M + 3 R).
// - It adds w d^2 to the squares, with w = m n / (m + n) and a distance d that is off by 2 e + u R. On
// one
//   level of blocks the weights w add up to n / 4; those of the last joins, of blocks of different
//   sizes, to at most n. So these errors are at most n (L / 4 + 1) 2 R (2 e + u R).
// - The terms w d^2 add up to at most n R^2 / 4. Each has four roundings, and takes part in 2 L sums.
// All are doubled for the higher orders.
RC_GTEST_PROP(Film, AgreesWithTwoPassesInHigherPrecision, ()) // map: moments
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
    const double joins = 2.0 * std::log2(n) + 1.0;
    const double mean_bound = joins * u * (m + 3.0 * r);
    const double squares_bound = n * (joins / 4.0 + 1.0) * 2.0 * r * (2.0 * mean_bound + u * r) +
                                 u * n * r * r / 4.0 * (4.0 + 2.0 * joins);
    const images::BatchMoments moments = film.moments();
    RC_ASSERT(std::abs(moments.mean.pixels[0].r - static_cast<double>(mean)) <= 2.0 * mean_bound);
    RC_ASSERT(std::abs(moments.squares.pixels[0].r - static_cast<double>(squares)) <=
              2.0 * squares_bound);
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
    Film second(3, 2, first.range(), first.blocks());
    for (int i = interruption; i < count; ++i) second.add_batch(batches[static_cast<std::size_t>(i)]);
    RC_ASSERT(second == whole);
}

/// Batches of a picture of one pixel that depend on their number alone, with all digits.
Film film_of_range(const images::BatchRange& range)
{
    Film film(1, 1, range.first);
    for (std::uint64_t i = range.first; i < range.end; ++i)
        film.add_batch(one_pixel(std::sin(static_cast<double>(i * i))));
    return film;
}

/// The film of a range, from parts that are cut anywhere and joined in any nesting.
Film joined_at_random(const images::BatchRange& range)
{
    if (range.size() < 2 || *rc::gen::weightedElement<bool>({{1, true}, {3, false}}))
        return film_of_range(range);
    const auto cut = *rc::gen::inRange(range.first, range.end + 1); // a part may be empty
    Film film = cut == range.end ? film_of_range(range) : joined_at_random({range.first, cut});
    film.append(cut == range.first ? film_of_range(range) : joined_at_random({cut, range.end}));
    return film;
}

RC_GTEST_PROP(Film, HasTheSameBitsFromPartsOfAnyRanges, ())
{
    const auto first = *rc::gen::inRange<std::uint64_t>(0, 70);
    const images::BatchRange range{first, first + *rc::gen::inRange<std::uint64_t>(0, 140)};
    RC_ASSERT(joined_at_random(range) == film_of_range(range));
}

TEST(Film, OfALaterRangeHasTheMomentsOfItsBatches)
{
    const Film film = film_of_range({3, 5});
    const double a = std::sin(9.0);
    const double b = std::sin(16.0);
    EXPECT_DOUBLE_EQ(film.mean().pixels[0].r, (a + b) / 2);
    EXPECT_DOUBLE_EQ(film.moments().squares.pixels[0].r, (a - b) * (a - b) / 2);
    EXPECT_EQ(film.range(), (images::BatchRange{3, 5}));
}

TEST(Film, HoldsNoMoreBlocksThanTheNumberOfBatchesHasOnes)
{
    Film film(1, 1);
    for (unsigned n = 1; n <= 300; ++n) {
        film.add_batch(one_pixel(n));
        ASSERT_EQ(film.blocks().size(), static_cast<std::size_t>(std::popcount(n)));
    }
}

TEST(Film, PartsThatDoNotFollowEachOtherAreRefused)
{
    for (const images::BatchRange& next : {images::BatchRange{5, 7}, {3, 7}, {0, 4}}) {
        Film film = film_of_range({0, 4});
        EXPECT_THROW(film.append(film_of_range(next)), std::invalid_argument) << describe(next);
        EXPECT_EQ(film, film_of_range({0, 4}));
    }
    Film film = film_of_range({0, 4});
    EXPECT_THROW(film.append(Film(2, 1, 4)), std::invalid_argument);
}

TEST(Film, AnotherSizeIsRefused)
{
    Film film(2, 3);
    EXPECT_THROW(film.add_batch(Image(3, 2)), std::invalid_argument);
    EXPECT_EQ(film.batches(), 0u);
    EXPECT_THROW(Film(2, 3, {0, 1}, {{Image(2, 3), Image(3, 2)}}), std::invalid_argument);
    EXPECT_THROW(Film(2, 3, {0, 3}, {{Image(2, 3), Image(2, 3)}}), std::invalid_argument);
}

// The largest blocks: they cover the range, a block of 2^k batches begins at a multiple of 2^k, and no
// two are the halves of a block.
RC_GTEST_PROP(BatchRange, IsARowOfLargestBlocks, ())
{
    const auto end = *rc::gen::resize(100, rc::gen::arbitrary<std::uint64_t>());
    const auto first = *rc::gen::inRange<std::uint64_t>(0, end / 2 + 1);
    const std::vector<images::BatchRange> blocks = images::largest_blocks({first, end});
    std::uint64_t at = first;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        RC_ASSERT(blocks[i].first == at);
        RC_ASSERT(std::has_single_bit(blocks[i].size()));
        RC_ASSERT(at % blocks[i].size() == 0u);
        if (i > 0 && blocks[i - 1].size() == blocks[i].size())
            RC_ASSERT(blocks[i - 1].first % (2 * blocks[i].size()) != 0u);
        at = blocks[i].end;
    }
    RC_ASSERT(at == end);
}

TEST(BatchRange, IsWrittenWithTwoDots)
{
    EXPECT_EQ(images::parse_range("4..8"), (images::BatchRange{4, 8}));
    EXPECT_EQ(describe(images::BatchRange{4, 8}), "4..8");
    EXPECT_EQ(images::parse_range("4..4"), (images::BatchRange{4, 4}));
    for (const char* text :
         {"", "4", "4..", "..8", "8..4", "4.8", "4...8", "-1..8", "4..99999999999999999999"})
        EXPECT_EQ(images::parse_range(text), std::nullopt) << text;
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
