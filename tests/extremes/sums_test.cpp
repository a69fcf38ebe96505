// Sums of very many samples.

#include "extremes/sums/equal_terms.h"
#include "extremes/sums/means.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace extremes {

namespace {

template <class F>
F added_one_by_one(F x, std::uint64_t n)
{
    F sum = 0;
    for (std::uint64_t i = 0; i < n; ++i) sum += x;
    return sum;
}

/// The mean of n equal samples of `first` and then of m of `second`: by the film, which starts near its
/// end.
double mean_near_the_end(std::uint64_t n, double first, std::uint64_t m, double second)
{
    const images::BatchRange range{0, n};
    const images::BatchMoments equal{batch_of(first), batch_of(0.0)};
    images::Film film(1, 1, range, std::vector(largest_blocks(range).size(), equal));
    for (std::uint64_t i = 0; i < m; ++i) film.add_batch(batch_of(second));
    return film.mean().pixels[0].r;
}

} // namespace

TEST(SumOfEqual, HasTheBitsOfOneAdditionAfterTheOther)
{
    std::mt19937_64 engine(1);
    for (int i = 0; i < 300; ++i) {
        // Few digits in every second term, so that ties occur.
        const double mantissa = i % 2 == 0 ? std::uniform_real_distribution(1.0, 2.0)(engine)
                                           : 1.0 + static_cast<double>(engine() % 32) / 32;
        const auto x = static_cast<float>(std::ldexp(mantissa, static_cast<int>(engine() % 20)));
        const std::uint64_t n = engine() >> (44 + engine() % 20);
        ASSERT_EQ(sum_of_equal(x, n), added_one_by_one(x, n)) << x << " " << n;
        ASSERT_EQ(sum_of_equal(static_cast<double>(x), n), added_one_by_one(static_cast<double>(x), n))
            << x << " " << n;
    }
    // Up to where the sum of floats stops growing, and beyond.
    for (const float x : {1.1f, 1.9999999f})
        EXPECT_EQ(sum_of_equal(x, 1u << 26), added_one_by_one(x, 1u << 26)) << x;
}

TEST(SumOfEqual, StopsGrowingWhereATermIsHalfAUnit)
{
    EXPECT_EQ(sum_of_equal(1.0f, 1u << 24), 0x1p24f);
    EXPECT_EQ(sum_of_equal(1.0f, 1u << 30), 0x1p24f);
    EXPECT_EQ(sum_of_equal(1.0, std::uint64_t{1} << 53), 0x1p53);
    EXPECT_EQ(sum_of_equal(1.0, std::uint64_t{1} << 60), 0x1p53);
    // The same, one by one, for doubles from close to that state on.
    double sum = 0x1p53 - 100;
    for (int i = 0; i < 200; ++i) sum += 1.0;
    EXPECT_EQ(sum, 0x1p53);
}

TEST(SumOfEqual, TheExactSumOverflowsOnlyBeyondTwoToThe32)
{
    const float largest = std::ldexp(16777215.0f, 8 - 117); // all digits, at the top of a word
    const auto mean = [&](std::uint64_t n) {
        return exact_sum_of_equal(largest, n).value() / static_cast<double>(n) / largest;
    };
    fast::ExactSum few{};
    for (int i = 0; i < 1000; ++i) few.add(largest);
    EXPECT_EQ(few.value(), exact_sum_of_equal(largest, 1000).value());
    fast::ExactSum nearly = exact_sum_of_equal(largest, (std::uint64_t{1} << 32) - 1000);
    for (int i = 0; i < 1000; ++i) nearly.add(largest);
    EXPECT_NEAR(nearly.value() / 0x1p32 / largest, 1.0, 1e-15);
    EXPECT_NEAR(mean(std::uint64_t{1} << 32), 1.0, 1e-15);
    EXPECT_LT(mean((std::uint64_t{1} << 32) + 512), 0.01);
}

// The film takes samples into account after 2^32 of them as it did at first. A film of floats does not.
TEST(FilmNearTheEnd, CountsTheLastOfTwoToThe32Samples)
{
    const std::uint64_t n = std::uint64_t{1} << 30; // batches of four samples
    const std::uint64_t m = 1 << 16;
    const double truth =
        (0.25 * static_cast<double>(n) + 0.75 * static_cast<double>(m)) / static_cast<double>(n + m);
    // Each of m steps rounds the difference, the quotient and the sum: by less than u (mean + 3 / n),
    // u = 2^-53.
    EXPECT_NEAR(mean_near_the_end(n, 0.25, m, 0.75), truth, m * 0x1p-53 * 0.26);
    RunningMean floats{0.25f, 0x1p24f}; // a count of floats stops there
    for (std::uint64_t i = 0; i < 4 * m; ++i) floats.add(0.75f);
    const double with_right_count = (0.25 * 0x1p32 + 0.75 * 4 * m) / (0x1p32 + 4 * m);
    EXPECT_GT(std::abs(floats.value / with_right_count - 1), 0.01);
}

} // namespace extremes
