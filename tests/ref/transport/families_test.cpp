// Families of strategies that are left out: the contributions of the others stay as they are, to the
// bit.

#include "images/families.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/renderer.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace {

using images::Families;
using images::Integrator;
using ref::Contribution;
using ref::Rgb;

constexpr int width = 24;
constexpr int height = 16;

bool belongs_to(bool Families::*family, int s, int t)
{
    if (s == 0) return family == &Families::emission_hit;
    if (t == 1) return family == &Families::light_image;
    return family == (s == 1 ? &Families::next_event : &Families::inner_connection);
}

using Case = std::tuple<Integrator, images::NamedFamily>;

/// The families that an integrator has.
std::vector<Case> all_cases()
{
    std::vector<Case> cases;
    for (const Integrator integrator : {Integrator::path, Integrator::bdpt})
        for (const images::NamedFamily& named : images::named_families)
            if (families_of(integrator).*named.family) cases.emplace_back(integrator, named);
    return cases;
}

std::string name_of_case(const testing::TestParamInfo<Case>& of)
{
    const auto& [integrator, named] = of.param;
    return std::string(integrator == Integrator::path ? "path_" : "bdpt_") + named.name;
}

class WithoutAFamily : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Families, WithoutAFamily, testing::ValuesIn(all_cases()), name_of_case);

// max_edges 1 and 2 included: there the walks are as short as they can be.
TEST_P(WithoutAFamily, TheOtherContributionsAreTheSameToTheBit)
{
    const ref::Integrator integrator = ref::integrator_of(std::get<Integrator>(GetParam()));
    const images::NamedFamily named = std::get<images::NamedFamily>(GetParam());
    int left_out = 0;
    for (const char* scene_name : {"cornell_glass", "all_emitters"}) { // the latter has a sky
        const scenes::Scene scene = transport_test::our_scene(scene_name);
        const ref::World world(scene, width, height);
        for (const int max_edges : {1, 2, 3, 7}) {
            const ref::PathOptions all{.seed = 9, .max_edges = max_edges};
            ref::PathOptions fewer = all;
            fewer.families.*named.family = false;
            for (std::uint32_t i = 0; i < width * height; ++i) {
                std::vector<Contribution> expected;
                std::vector<Contribution> found;
                integrator(world, all, {9, i, i}, expected);
                integrator(world, fewer, {9, i, i}, found);
                left_out += static_cast<int>(std::erase_if(expected, [&](const Contribution& c) {
                    return belongs_to(named.family, c.s, c.t);
                }));
                ASSERT_EQ(found.size(), expected.size()) << scene_name << ", sample " << i;
                for (std::size_t j = 0; j < found.size(); ++j)
                    ASSERT_TRUE(found[j].pixel == expected[j].pixel && found[j].s == expected[j].s &&
                                found[j].t == expected[j].t && found[j].value == expected[j].value &&
                                found[j].weight == expected[j].weight)
                        << scene_name << ", sample " << i;
            }
        }
    }
    EXPECT_GT(left_out, 100);
}

// The picture and the layers are sums of the same terms in different orders: about 15 strategies, 12
// samples, and at most some tens of splats per pixel, all positive. 1e3 roundings are more than occur.
TEST_P(WithoutAFamily, ThePictureLacksItsWeightedLayers)
{
    const images::NamedFamily named = std::get<images::NamedFamily>(GetParam());
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    images::RenderOptions options{
        .integrator = std::get<Integrator>(GetParam()), .seed = 4, .max_edges = 4};
    options.strategies = images::StrategyPictures::weighted;
    const auto rendered = [&](images::StrategySums& layers) {
        images::Film film(width, height);
        const auto renderer = ref::renderer(scene, width, height, options, 2);
        images::fill(film, 3, *renderer, {},
                     [&](const images::Batch& batch) { layers.add(batch.strategies); });
        return film.mean();
    };
    images::StrategySums layers;
    images::StrategySums layers_left;
    const images::Image whole = rendered(layers);
    options.families.*named.family = false;
    images::Image sum = rendered(layers_left);
    for (const auto& [strategy, layer] : layers.means(options.batch_size)) {
        const auto [s, t] = strategy;
        if (!belongs_to(named.family, s, t)) continue;
        EXPECT_FALSE(layers_left.means(options.batch_size).contains(strategy));
        for (std::size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += layer.pixels[i];
    }
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            ASSERT_NEAR(sum.pixels[i][channel], whole.pixels[i][channel],
                        1e3 * 0x1p-53 * whole.pixels[i][channel]);
}

TEST(Families, WithoutEmissionHitsAPathEndsOneEdgeEarlier)
{
    // Its last vertex can only be an emission hit; the ray to it would be traced in vain.
    ref::PathOptions options;
    options.max_edges = 5;
    EXPECT_EQ(last_edge(options), 5);
    options.families.emission_hit = false;
    EXPECT_EQ(last_edge(options), 4);
}

TEST(Families, ARendererRefusesThoseThatItsIntegratorHasNot)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_diffuse");
    const auto make = [&](Integrator integrator, const Families& families) {
        return ref::renderer(scene, 4, 4, {.integrator = integrator, .families = families});
    };
    EXPECT_NO_THROW(make(Integrator::path, {false, true, true, true}));
    EXPECT_THROW(make(Integrator::path, {true, true, false, true}), std::invalid_argument);
    EXPECT_THROW(make(Integrator::path, {true, true, true, false}), std::invalid_argument);
    EXPECT_THROW(make(Integrator::path, {false, false, true, true}), std::invalid_argument);
    EXPECT_THROW(make(Integrator::light, {true, false, true, true}), std::invalid_argument);
    EXPECT_THROW(make(Integrator::light, {true, true, false, true}), std::invalid_argument);
    EXPECT_THROW(make(Integrator::bdpt, {false, false, false, false}), std::invalid_argument);
    EXPECT_NO_THROW(make(Integrator::bdpt, {false, false, false, true}));
}

} // namespace
