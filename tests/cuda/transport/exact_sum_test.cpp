// Sums that are equal in every order, compared with integers of any length.

#include "cuda/transport/exact_sum.h"

#include "cuda/parallel/threaded_executor.h"
#include "tests/ref/transport/generators.h"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

namespace {

using boost::multiprecision::cpp_int;
using fast::ExactSum;

constexpr float largest = std::numeric_limits<float>::max();
constexpr float smallest = std::numeric_limits<float>::denorm_min(); // 2^-149

/// Every finite float >= 0 with equal probability, subnormal ones included.
rc::Gen<float> any_term()
{
    return rc::gen::map(transport_test::any_word(), [](std::uint32_t word) {
        return std::bit_cast<float>(static_cast<std::uint32_t>(word % 0x7f80'0000ull));
    });
}

std::vector<float> any_terms()
{
    return *rc::gen::container<std::vector<float>>(any_term());
}

/// The float in units of 2^-149; every float is a multiple of that.
cpp_int in_units(float term)
{
    int exponent = 0;
    const float fraction = std::frexp(term, &exponent); // 0 or in [1/2, 1)
    cpp_int units = static_cast<std::uint32_t>(std::ldexp(fraction, 24));
    const int shift = exponent - 24 + 149;
    if (shift >= 0)
        units <<= shift;
    else
        units >>= -shift; // only zeros, since the float is subnormal
    return units;
}

cpp_int in_units(const ExactSum& sum)
{
    cpp_int units = 0;
    for (int w = 8; w >= 0; --w) {
        units <<= 32;
        units += sum.words[w];
    }
    return units;
}

ExactSum sum_of(std::span<const float> terms)
{
    ExactSum sum{};
    for (const float term : terms) sum.add(term);
    return sum;
}

cpp_int exactly(std::span<const float> terms)
{
    cpp_int sum = 0;
    for (const float term : terms) sum += in_units(term);
    return sum;
}

/// Each word is rounded when it is converted to double, and so is each of eight sums. All are
/// positive, so relative errors do not grow: 9 roundings, and those of the quotient here.
void expect_value(const ExactSum& sum, const cpp_int& units)
{
    using Wide = long double;
    const Wide expected = std::ldexp(units.convert_to<Wide>(), -149);
    RC_ASSERT(std::abs(static_cast<Wide>(sum.value()) - expected) <= 10 * 0x1p-53L * expected);
}

RC_GTEST_PROP(ExactSum, IsExact, ())
{
    const std::vector<float> terms = any_terms();
    const ExactSum sum = sum_of(terms);
    RC_ASSERT(sum.lost == 0);
    RC_ASSERT(in_units(sum) == exactly(terms));
    expect_value(sum, exactly(terms));
}

RC_GTEST_PROP(ExactSum, IsTheSameInEveryOrder, ())
{
    std::vector<float> terms = any_terms();
    const double sum = sum_of(terms).value();
    std::shuffle(terms.begin(), terms.end(), std::mt19937(*transport_test::any_word()));
    RC_ASSERT(std::bit_cast<std::uint64_t>(sum_of(terms).value()) == std::bit_cast<std::uint64_t>(sum));
}

TEST(ExactSum, ReachesFromTheSmallestFloatToManyOfTheLargest)
{
    EXPECT_EQ(ExactSum{}.value(), 0);
    EXPECT_EQ(sum_of(std::vector<float>{smallest}).value(), 0x1p-149);
    EXPECT_EQ(sum_of(std::vector<float>{0x1p-126f, 0x1p-127f}).value(), 0x1.8p-126);
    EXPECT_EQ(sum_of(std::vector<float>{largest}).value(), static_cast<double>(largest));
    const std::vector<float> many(100'000, largest);
    EXPECT_EQ(in_units(sum_of(many)), 100'000 * in_units(largest));
    const std::vector<float> far_apart = {largest, smallest, 1.0f};
    EXPECT_EQ(in_units(sum_of(far_apart)), in_units(largest) + (cpp_int(1) << 149) + 1);
}

TEST(ExactSum, HasRoomForCarriesOfEveryPlace)
{
    for (std::uint32_t exponent = 0; exponent < 255; ++exponent) {
        // All bits of the mantissa set, so that every addition carries.
        const auto term = std::bit_cast<float>(exponent << 23 | 0x7f'ffff);
        const std::vector<float> terms(1000, term);
        EXPECT_EQ(in_units(sum_of(terms)), 1000 * in_units(term)) << exponent;
    }
}

TEST(ExactSum, OfWhatIsNoSizeIsNoNumber)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {infinity, -infinity, nan, -nan, -1.0f, -smallest, -largest}) {
        ExactSum sum = sum_of(std::vector<float>{1.0f, bad, 2.0f});
        EXPECT_TRUE(std::isnan(sum.value())) << bad;
        sum.add(1.0f);
        EXPECT_TRUE(std::isnan(sum.value())) << bad;
    }
    EXPECT_EQ(sum_of(std::vector<float>{1.0f, -0.0f, 0.0f}).value(), 1.0); // a term of 0 is valid
}

struct AddTerms {
    std::span<const float> terms;
    std::span<ExactSum> sum;
    void operator()(std::uint32_t index) const { sum[0].add(terms[index]); }
};

TEST(ExactSum, LosesNothingWhereThreadsMeet)
{
    std::mt19937 random(1);
    std::vector<float> terms(20'000);
    for (float& term : terms)
        term = std::bit_cast<float>(static_cast<std::uint32_t>(random() % 0x7f80'0000ull));
    terms[17] = -1.0f;
    fast::ThreadedExecutor threads(4, 1);
    ExactSum sum{};
    threads(static_cast<std::uint32_t>(terms.size()), AddTerms{terms, {&sum, 1}});
    EXPECT_EQ(sum.lost, 1);
    terms[17] = 0.0f;
    EXPECT_EQ(in_units(sum), exactly(terms));
}

} // namespace
