// Weights by running sums compared with the sum over all strategies, term by term, from the same
// densities. There is no geometry, so that only rounding may differ.

#include "cuda/transport/mis_weight.h"

#include "tests/ref/transport/generators.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <vector>

namespace {

using fast::Heuristic;

/// One walk of a path: v_0 ... v_n, where v_n is joined to the last vertex of the other walk. All
/// densities of the walk itself are 1, so that those of the other walk are the quotients.
struct HalfPath {
    /// The data at v_i. Of v_0 only `joinable` and `geometry_over_pdf` are used, of v_n all but the
    /// latter.
    struct Step {
        bool joinable;             // c_i: whether v_{i-1} and v_i can be joined; c_0: whether the other
                                   // walk can make the whole path
        float pdf_rev_solid_angle; // with which the other walk would go on from v_i to v_{i-1}, without
                                   // survival
        float survival;            // at v_i, where roulette applies
        float geometry_over_pdf;   // converts pdf_rev_solid_angle at v_{i+1} to the quotient of the
                                   // densities of v_i
    };
    std::vector<Step> steps;
    float last; // the density of v_n in the other walk
    [[nodiscard]] int vertices() const { return static_cast<int>(steps.size()); }
};

/// Twelve squared quotients are multiplied: at most 10^24, which floats hold and no limit changes.
float any_density()
{
    return static_cast<float>(std::pow(10.0, *transport_test::any_unit() - 0.5));
}

/// A walk with 2 ... 12 vertices.
HalfPath any_half()
{
    HalfPath half{{}, any_density()};
    const auto n = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::size_t>(2, 13));
    for (std::size_t i = 0; i < n; ++i)
        half.steps.push_back({*rc::gen::arbitrary<bool>(), any_density(),
                              static_cast<float>(*transport_test::any_unit()), any_density()});
    return half;
}

/// The sum over the strategies in which the other walk, which now has `other_vertices`, samples
/// vertices of this one too: prod_i (pdf_rev of v_i / pdf_fwd of v_i) over those vertices, each
/// quotient to the exponent of the heuristic.
long double literal_sum(const HalfPath& half, int other_vertices, Heuristic heuristic)
{
    const int n = half.vertices() - 1;
    const long double exponent = heuristic == Heuristic::power ? 2 : 1;
    long double sum = 0;
    long double product = 1;
    for (int i = n; i >= 0; --i) { // the other walk samples v_i too; v_{i-1} is the last of this walk
        long double quotient = half.last;
        if (i < n) {
            const HalfPath::Step& next = half.steps[static_cast<std::size_t>(i) + 1];
            quotient = static_cast<long double>(next.pdf_rev_solid_angle) *
                       half.steps[static_cast<std::size_t>(i)].geometry_over_pdf;
            // The other walk has other_vertices + n - i vertices when it reaches v_i. It bounced at
            // each but its first; the last bounce, at v_{i+1}, was number other_vertices + n - i - 1.
            if (other_vertices + n - i - 1 > 4) quotient *= next.survival;
        }
        product *= std::pow(quotient, exponent);
        if (half.steps[static_cast<std::size_t>(i)].joinable) sum += product;
    }
    return sum;
}

/// v_n, to be joined to a walk of `other_vertices`, with the running sums of the walk.
fast::SubpathEnd end_of(const HalfPath& half, int other_vertices, Heuristic heuristic)
{
    const auto& v = half.steps;
    fast::RunningSums sums(v[0].joinable, v[0].geometry_over_pdf);
    for (std::size_t i = 1; i + 1 < v.size(); ++i)
        sums.advance(v[i].joinable, v[i].pdf_rev_solid_angle, v[i].survival, v[i].geometry_over_pdf,
                     heuristic);
    return {1.0f, half.last,
            sums.bracket(v.back().joinable, v.back().pdf_rev_solid_angle, v.back().survival,
                         other_vertices, heuristic)};
}

/// Roundings per level of the nested sum: 1 in the quotient, doubled and 1 more when squared; 1 for
/// the square of the survival and 1 for its product; 1 for the product with the inner sum, and 1 for
/// the sum: 7. The last quotient has 2, and the weight 3. All terms are positive, so relative errors
/// add up and do not grow.
double bound(int vertices)
{
    return (7.0 * vertices + 5.0) * 0x1p-24;
}

Heuristic any_heuristic()
{
    return *rc::gen::element(Heuristic::balance, Heuristic::power);
}

RC_GTEST_PROP(RunningSums, AreTheLiteralSums, ()) // map: impossible, density-ratio, power
{
    const HalfPath half = any_half();
    const Heuristic heuristic = any_heuristic();
    for (int other_vertices = 0; other_vertices <= 12; ++other_vertices) {
        const long double expected = literal_sum(half, other_vertices, heuristic);
        const long double error =
            sum_of_others(heuristic, end_of(half, other_vertices, heuristic)) - expected;
        RC_ASSERT(std::abs(error) <= bound(half.vertices()) * expected);
    }
}

TEST(RunningSums, StayFinite)
{
    for (const Heuristic heuristic : {Heuristic::balance, Heuristic::power}) {
        fast::RunningSums sums(true, 1e25f);
        for (int i = 0; i < 12; ++i) sums.advance(true, 1e25f, 1.0f, 1e25f, heuristic);
        EXPECT_EQ(sums.bracket(true, 1e25f, 1.0f, 2, heuristic), fast::largest_sum);
        // So a quotient of 0, for a vertex that cannot be hit, gives 0 and not NaN.
        sums.advance(true, 0.0f, 1.0f, 1.0f, heuristic);
        EXPECT_EQ(sums.bracket(false, 0.0f, 1.0f, 2, heuristic), 0.0f);
    }
}

/// Whether `weight` is the weight of a strategy with the sums S and T, for walks of at most
/// `vertices`.
bool is_share(float weight, long double S, long double T, int vertices)
{
    const long double expected = 1 / (1 + S + T);
    // d(1 / (1 + x)) = x / (1 + x)^2 dx / x <= dx / x / (1 + x)
    return std::abs(weight - expected) <= bound(vertices) * expected;
}

/// Both walks of a path, each with the number of vertices of the other.
RC_GTEST_PROP(RunningSums, GiveEveryStrategyItsShare, ()) // map: balance
{
    const HalfPath y = any_half();
    const HalfPath z = any_half();
    const Heuristic heuristic = any_heuristic();
    const long double S = literal_sum(y, z.vertices(), heuristic);
    const long double T = literal_sum(z, y.vertices(), heuristic);
    const float weight = inner_connection_weight(heuristic, end_of(y, z.vertices(), heuristic),
                                                 end_of(z, y.vertices(), heuristic));
    RC_ASSERT(is_share(weight, S, T, std::max(y.vertices(), z.vertices())));
}

/// The strategies in which one walk has one vertex or none.
RC_GTEST_PROP(RunningSums, GiveStrategiesAtTheEndsOfAPathTheirShare, ())
{
    const HalfPath v = any_half();
    const Heuristic heuristic = any_heuristic();
    const long double none = literal_sum(v, 0, heuristic);
    const long double one = literal_sum(v, 1, heuristic);
    const fast::SubpathEnd joined_to_none = end_of(v, 0, heuristic);
    const fast::SubpathEnd joined_to_one = end_of(v, 1, heuristic);
    RC_ASSERT(is_share(emission_hit_weight(heuristic, joined_to_none), 0, none, v.vertices()));
    RC_ASSERT(is_share(light_image_weight(heuristic, joined_to_one), one, 0, v.vertices()));
    const float pdf_rev = any_density();
    const long double S = literal_sum({{{true, 0, 0, 0}}, pdf_rev}, v.vertices(), heuristic);
    RC_ASSERT(
        is_share(next_event_weight(heuristic, 1.0f, pdf_rev, joined_to_one), S, one, v.vertices()));
}

/// The weights of path tracing's two strategies add up to 1 for every path that both can make.
// map: weight-of-hit, weight-of-event
RC_GTEST_PROP(RunningSums, BalanceTheTwoStrategiesOfPathTracing, ())
{
    const float hit = any_density();
    const float next_event = any_density();
    RC_ASSERT(is_share(fast::path_emission_hit_weight(true, hit, next_event), 0,
                       static_cast<long double>(next_event) / hit, 1));
    RC_ASSERT(is_share(fast::path_next_event_weight(hit, next_event), 0,
                       static_cast<long double>(hit) / next_event, 1));
    RC_ASSERT(fast::path_emission_hit_weight(false, hit, next_event) == 1.0f);
    RC_ASSERT(fast::path_next_event_weight(0.0f, next_event) == 1.0f);
}

} // namespace
