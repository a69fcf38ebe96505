// The fast path chooses the same emitter as the reference for every number, and no emitter is starved.

#include "cuda/launch/renderer.h"
#include "cuda/transport/emitter.h"
#include "cuda/transport/emitter_choice.h"
#include "ref/transport/emitter_choice.h"
#include "tests/ref/transport/emitter_powers.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/starved_lamp.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <vector>

namespace {

RC_GTEST_PROP(EmitterChoiceInFloat, HasTheBordersOfTheReference, ()) // map: emitter-choice
{
    const std::vector<double> powers = transport_test::any_powers();
    const std::vector<float> sums = fast::summed_probabilities(powers);
    RC_ASSERT(sums.empty() == !(transport_test::total_of(powers) > 0.0));
    if (sums.empty()) return;
    const std::vector<double> borders = ref::choice_borders(powers);
    RC_ASSERT(std::vector<double>(sums.begin(), sums.end()) == borders);
}

// The borders are where the choice changes; 0 is one where the first emitter has no power.
TEST(EmitterChoiceInFloat, IsTheFirstWhoseSumExceedsTheNumber)
{
    for (const std::vector<double>& powers :
         std::vector<std::vector<double>>{{1}, {0, 1}, {1, 0}, {0, 0, 2, 0, 1}, {3, 0, 0, 0, 1, 2, 0}}) {
        const std::vector<float> sums = fast::summed_probabilities(powers);
        fast::SceneView<fast::Needs{}> scene{};
        scene.cumulative = sums;
        std::vector<float> numbers{0.0f};
        for (const float border : sums) {
            if (border > 0.0f) numbers.push_back(border - 0x1p-24f);
            if (border < 1.0f) numbers.push_back(border);
        }
        for (const float u : numbers) {
            const auto first = std::ranges::upper_bound(sums, u) - sums.begin();
            EXPECT_EQ(fast::choose_emitter(scene, u), static_cast<std::uint32_t>(first)) << u;
            EXPECT_GT(powers[static_cast<std::size_t>(first)], 0.0) << u;
        }
    }
}

TEST(EmitterChoiceInFloat, RefusesWhatItCannotShareOut)
{
    EXPECT_THROW((void)fast::summed_probabilities({1.0, std::numeric_limits<double>::infinity()}),
                 std::invalid_argument);
    EXPECT_THROW((void)fast::summed_probabilities({std::numeric_limits<double>::quiet_NaN()}),
                 std::invalid_argument);
    EXPECT_THROW((void)fast::summed_probabilities(std::vector<double>((1 << 24) + 1, 1.0)),
                 std::invalid_argument);
    EXPECT_EQ(fast::summed_probabilities(std::vector<double>(1 << 24, 1.0))[5], 6 * 0x1p-24f);
}

transport_test::Measured mean_by_host(const scenes::Scene& scene, fast::Integrator integrator)
{
    images::RenderOptions options;
    options.integrator = integrator;
    options.max_edges = 2;
    options.batch_size = 512;
    const auto renderer = fast::host_renderer(scene, 4, 4, options, 1);
    std::vector<double> means;
    for (std::uint64_t i = 0; i < 32; ++i)
        means.push_back(transport_test::mean_over(renderer->render_batch(i, {})->mean, {0, 0, 4, 4}, 0));
    return transport_test::measure(means);
}

class StarvedLampInFloat : public testing::TestWithParam<fast::Integrator> {};

TEST_P(StarvedLampInFloat, LightsThePlaneBesideEmittersOfAnyPower)
{
    for (const double ratio : {1.0, 1e6, 1e12}) {
        SCOPED_TRACE(ratio);
        const scenes::Scene scene = transport_test::lamp_beside_a_brighter_one(ratio);
        transport_test::expect_mean(mean_by_host(scene, GetParam()),
                                    transport_test::radiance_of_lit_plane(scene, 4, 4),
                                    GetParam() == fast::Integrator::light ? 0.25 : 0.1);
    }
}

TEST_P(StarvedLampInFloat, LightsThePlaneUnderAWideSky)
{
    if (GetParam() == fast::Integrator::light) return; // light tracing does not find what is seen
    for (const double half_width : {1e1, 1e2, 1e4}) {
        SCOPED_TRACE(half_width);
        const scenes::Scene scene = transport_test::lamp_under_sky(half_width);
        transport_test::expect_mean(mean_by_host(scene, GetParam()),
                                    transport_test::radiance_of_lit_plane(scene, 4, 4), 0.2);
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, StarvedLampInFloat,
                         testing::Values(fast::Integrator::path, fast::Integrator::bdpt,
                                         fast::Integrator::light),
                         [](const testing::TestParamInfo<fast::Integrator>& of) {
                             return std::string(of.param == fast::Integrator::path   ? "path"
                                                : of.param == fast::Integrator::bdpt ? "bdpt"
                                                                                     : "light");
                         });

} // namespace
