// The choice of an emitter: exactly as often as its probability, and none is starved.

#include "ref/transport/emitter_choice.h"

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/ref/transport/emitter_powers.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/starved_lamp.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <stdexcept>

namespace {

using ref::choice_borders;

RC_GTEST_PROP(EmitterChoice, EveryEmitterWithPowerHasWholeCellsAndNoOtherHasAny, ())
{
    const std::vector<double> powers = transport_test::any_powers();
    const std::vector<double> borders = choice_borders(powers);
    RC_ASSERT(borders.size() == powers.size());
    double before = 0.0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const double cells = (borders[i] - before) * 0x1p24;
        RC_ASSERT(cells == std::floor(cells));
        RC_ASSERT((cells >= 1.0) == (powers[i] > 0.0));
        RC_ASSERT(cells >= 0.0);
        before = borders[i];
    }
    if (transport_test::total_of(powers) > 0.0) RC_ASSERT(borders.back() == 1.0);
}

// Each of the k emitters gets one cell first, which takes k cells from the shared part. Both borders
// of an emitter are rounded by half a cell.
RC_GTEST_PROP(EmitterChoice, HalfIsByPowerAndHalfIsAlike, ()) // map: emitter-choice
{
    const std::vector<double> powers = transport_test::any_powers();
    const double total = transport_test::total_of(powers);
    RC_PRE(total > 0.0);
    const std::vector<double> borders = choice_borders(powers);
    const auto k = static_cast<double>(transport_test::number_with_power(powers));
    double before = 0.0;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        const double expected = powers[i] > 0.0 ? 0.5 * powers[i] / total + 0.5 / k : 0.0;
        RC_ASSERT(std::abs(borders[i] - before - expected) <= (2.0 + k) * 0x1p-24);
        before = borders[i];
    }
}

TEST(EmitterChoice, IsOfAMillionEmittersAsExactAsOfTwo)
{
    std::vector<double> powers(1'000'000, 1.0);
    powers[123'456] = 1e-12;
    powers[654'321] = 1e12;
    const std::vector<double> borders = choice_borders(powers);
    EXPECT_EQ(borders.back(), 1.0);
    EXPECT_NEAR(borders[654'321] - borders[654'320], 0.5 * (1.0 - 0x1p-24 * 1e6), 1e-5);
    for (std::size_t i = 1; i < borders.size(); ++i) ASSERT_GE(borders[i] - borders[i - 1], 0x1p-24);
}

TEST(EmitterChoice, RefusesWhatItCannotShareOut)
{
    EXPECT_THROW((void)choice_borders(std::vector{1.0, std::numeric_limits<double>::infinity()}),
                 std::invalid_argument);
    EXPECT_THROW((void)choice_borders(std::vector{std::numeric_limits<double>::quiet_NaN()}),
                 std::invalid_argument);
    EXPECT_THROW((void)choice_borders(std::vector<double>((1 << 24) + 1, 1.0)), std::invalid_argument);
    EXPECT_EQ(choice_borders(std::vector<double>(1 << 24, 1.0))[5], 6 * 0x1p-24);
    // The sum of these powers is not finite, but their shares are.
    EXPECT_EQ(choice_borders(std::vector{1e308, 1e308}), (std::vector{0.5, 1.0}));
    EXPECT_EQ(choice_borders(std::vector{0.0, 0.0}), (std::vector{0.0, 0.0}));
}

class StarvedLamp : public transport_test::OfEveryIntegrator {
protected:
    /// Checks that the plane is as bright as its lamp makes it.
    static void expect_lit(const scenes::Scene& scene, int samples)
    {
        const ref::World world(scene, 4, 4);
        transport_test::EstimateOptions options;
        options.batches = 32;
        options.batch_size = GetParam().samples(samples);
        options.path = {.seed = 5, .max_edges = 2};
        const auto measured = transport_test::measure(
            transport_test::estimate(world, GetParam().integrator, options), {0, 0, 4, 4}, 0);
        transport_test::expect_mean(measured, transport_test::radiance_of_lit_plane(scene, 4, 4),
                                    GetParam().bias(0.05));
    }
};
class StarvedLampUnderSky : public StarvedLamp {};

// The lamp over the plane gives the same picture with any other emitters that light nothing in view.
TEST_P(StarvedLamp, LightsThePlaneBesideEmittersOfAnyPower)
{
    for (const double ratio : {1.0, 1e3, 1e6, 1e9, 1e12}) {
        SCOPED_TRACE(ratio);
        expect_lit(transport_test::lamp_beside_a_brighter_one(ratio), 2048);
    }
}

// The power of the sky grows with the area that it lights: here up to 1e12 times the lamp's. Light
// tracing is left out: with so wide a sky it does not find the part in view.
TEST_P(StarvedLampUnderSky, LightsThePlaneUnderAWideSky)
{
    for (const double half_width : {1e1, 1e2, 1e4, 1e6}) {
        SCOPED_TRACE(half_width);
        expect_lit(transport_test::lamp_under_sky(half_width), 256);
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, StarvedLamp, transport_test::integrators(),
                         transport_test::name_of);
INSTANTIATE_TEST_SUITE_P(Integrators, StarvedLampUnderSky, transport_test::integrators(),
                         transport_test::name_of);
INSTANTIATE_TEST_SUITE_P(LightTracing, StarvedLamp, transport_test::light_tracer(),
                         transport_test::name_of);

} // namespace
