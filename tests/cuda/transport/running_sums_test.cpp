// Weights by running sums against the sum over all strategies, term by term, of the same densities: no
// geometry, so that rounding is all that may differ.

#include "cuda/transport/mis_weight.h"

#include "cuda/transport/connect.h"
#include "tests/ref/transport/generators.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace {

using gpu::Heuristic;

/// One walk from its end of a path: v_0 ... v_n, where v_n is joined to the last of the other walk.
struct HalfPath {
    /// What the walk meets at v_i. Of v_0 only `joinable` and `back` count, of v_n all but `back`.
    struct Step {
        bool joinable;  // i = 0: the other walk can make all of the path; else: v_{i-1} and v_i can be
                        // joined
        float other;    // with which the other walk would go on from v_i to v_{i-1}, but for survival
        float survival; // at v_i, once roulette plays
        float back;     // turns `other` at v_{i+1} into the quotient of the densities of v_i
    };
    std::vector<Step> steps;
    float last; // the quotient of the densities of v_n, other walk over own
    [[nodiscard]] int vertices() const { return static_cast<int>(steps.size()); }
};

/// Of squared quotients twelve are multiplied: 10^24 at most, which floats hold and no cap cuts.
float any_density()
{
    return static_cast<float>(std::pow(10.0, *transport_test::any_unit() - 0.5));
}

/// With 2 ... 12 vertices.
HalfPath any_half()
{
    HalfPath half{{}, any_density()};
    const auto n = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::size_t>(2, 13));
    for (std::size_t i = 0; i < n; ++i)
        half.steps.push_back({*rc::gen::arbitrary<bool>(), any_density(),
                              static_cast<float>(*transport_test::any_unit()), any_density()});
    return half;
}

/// The sum over the strategies in which the other walk, with `others` vertices now, has taken vertices
/// of this one: prod_i (other density of v_i / own density of v_i) over the vertices taken, each to the
/// power that the heuristic says.
long double literal_sum(const HalfPath& half, int others, Heuristic heuristic)
{
    const int n = half.vertices() - 1;
    const long double exponent = heuristic == Heuristic::power ? 2 : 1;
    long double sum = 0;
    long double product = 1;
    for (int i = n; i >= 0; --i) { // v_i is taken as well; v_{i-1} becomes the last of this walk
        long double quotient = half.last;
        if (i < n) {
            const HalfPath::Step& next = half.steps[static_cast<std::size_t>(i) + 1];
            quotient =
                static_cast<long double>(next.other) * half.steps[static_cast<std::size_t>(i)].back;
            // The other walk has `others` + n - i vertices when it comes to v_i: it bounced at each but
            // its first, the last time at v_{i+1}, and that was its bounce number others + n - i - 1.
            if (others + n - i - 1 > 4) quotient *= next.survival;
        }
        product *= std::pow(quotient, exponent);
        if (half.steps[static_cast<std::size_t>(i)].joinable) sum += product;
    }
    return sum;
}

/// As a walk carries it (subpath.h) and as a connection completes it (connect.h).
float running_sum(const HalfPath& half, int others, Heuristic heuristic)
{
    const auto& v = half.steps;
    gpu::RunningSums sums(v[0].joinable, v[0].back, 1.0f);
    for (std::size_t i = 1; i + 1 < v.size(); ++i)
        sums.advance(v[i].joinable, v[i].other, v[i].survival, v[i].back, 1.0f, heuristic);
    return gpu::shared(heuristic, half.last) *
           sums.without_last_factor(v.back().joinable, v.back().other, v.back().survival, others,
                                    heuristic);
}

/// Roundings per level of the nested sum: 1 in other * back, doubled and 1 more when squared; survival's
/// square 1, its product 1; the product with the inner sum 1, the sum 1: 7. The last quotient has 2, and
/// the weight 3. All terms are positive, so relative errors add up and do not grow.
double bound(int vertices)
{
    return (7.0 * vertices + 5.0) * 0x1p-24;
}

Heuristic any_heuristic()
{
    return *rc::gen::element(Heuristic::balance, Heuristic::power);
}

RC_GTEST_PROP(RunningSums, AreTheLiteralSums, ())
{
    const HalfPath half = any_half();
    const Heuristic heuristic = any_heuristic();
    for (int others = 0; others <= 12; ++others) {
        const long double expected = literal_sum(half, others, heuristic);
        const long double error = running_sum(half, others, heuristic) - expected;
        RC_ASSERT(std::abs(error) <= bound(half.vertices()) * expected);
    }
}

TEST(RunningSums, StayFinite)
{
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
        gpu::RunningSums sums(true, 1e25f, 1.0f);
        for (int i = 0; i < 12; ++i) sums.advance(true, 1e25f, 1.0f, 1e25f, 1.0f, heuristic);
        EXPECT_EQ(sums.without_last_factor(true, 1e25f, 1.0f, 2, heuristic), gpu::largest_sum);
        // So a quotient of 0, of what cannot be hit, leaves 0 and not NaN.
        sums.advance(true, 0.0f, 1.0f, 1.0f, 1.0f, heuristic);
        EXPECT_EQ(sums.without_last_factor(false, 0.0f, 1.0f, 2, heuristic), 0.0f);
    }
}

/// Both halves of a path, each with the number of vertices of the other.
RC_GTEST_PROP(RunningSums, GiveEveryStrategyItsShare, ())
{
    const HalfPath y = any_half();
    const HalfPath z = any_half();
    const Heuristic heuristic = any_heuristic();
    const long double S = literal_sum(y, z.vertices(), heuristic);
    const long double T = literal_sum(z, y.vertices(), heuristic);
    const float weight =
        gpu::weight(running_sum(y, z.vertices(), heuristic), running_sum(z, y.vertices(), heuristic));
    const long double expected = 1 / (1 + S + T);
    // d(1 / (1 + x)) = x / (1 + x)^2 dx / x <= dx / x / (1 + x)
    RC_ASSERT(std::abs(weight - expected) <= bound(std::max(y.vertices(), z.vertices())) * expected);
}

} // namespace
