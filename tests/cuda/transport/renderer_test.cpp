// From samples to batches: nothing is lost or counted twice, and the result does not depend on the
// division into launches.

#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/host_kernels.h"
#include "tests/cuda/parallel/on_device.h"
#include "tests/cuda/transport/contribution_recorder.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using fast::Integrator;
using fast_transport_test::ContributionRecorder;
using fast_transport_test::RecordedContribution;
using transport_test::our_scene;

constexpr int width = 12;
constexpr int height = 9;

images::RenderOptions short_paths(Integrator integrator)
{
    images::RenderOptions options;
    options.integrator = integrator;
    options.max_edges = 5;
    options.seed = 7;
    return options;
}

/// A batch rendered on the host, with launches of exactly `launch` samples.
images::Image batch_of(const scenes::Scene& scene, const images::RenderOptions& options,
                       unsigned threads, std::uint32_t launch, std::uint64_t number)
{
    fast::HostMemory memory;
    fast::HostThreads executor(threads, 1);
    fast::BatchRenderer renderer(memory, executor, {launch, launch, std::size_t{1} << 30}, scene, width,
                                 height, options, {});
    return renderer.render_batch(number, {})->mean;
}

TEST(LaunchSize, GrowsAndShrinksBetweenItsLimits)
{
    using std::chrono::milliseconds;
    fast::LaunchSize size({64, 256, 1 << 20}, 64);
    EXPECT_EQ(size.get(), 64u);
    for (int i = 0; i < 5; ++i) size.took(milliseconds(1));
    EXPECT_EQ(size.get(), 256u);
    size.took(milliseconds(60));
    EXPECT_EQ(size.get(), 256u);
    for (int i = 0; i < 5; ++i) size.took(milliseconds(500));
    EXPECT_EQ(size.get(), 64u);
    // If the memory is too small, samples are computed one after the other, at least one at a time.
    EXPECT_EQ(fast::LaunchSize({64, 256, 1000}, 100).most(), 8u);
    EXPECT_EQ(fast::LaunchSize({64, 256, 1000}, 100).get(), 8u);
    EXPECT_EQ(fast::LaunchSize({64, 256, 1000}, 5000).most(), 1u);
}

/// An executor that counts the indices launched.
struct CountingExecutor {
    std::vector<std::uint32_t> counts;
    template <fast::Kernel K>
    void operator()(std::uint32_t count, const K& kernel)
    {
        counts.push_back(count);
        for (std::uint32_t i = 0; i < count; ++i) kernel(i);
    }
};

// With a small limit in place of the range of an index.
TEST(Clear, ReachesEveryElementOnceHoweverManyLaunchesItTakes)
{
    using Counts = std::vector<std::uint32_t>;
    const auto launches = [](std::size_t size) {
        std::vector<std::uint64_t> elements(size + 1, 5);
        CountingExecutor executor;
        fast::clear(executor, std::span(elements).first(size), 7);
        EXPECT_EQ(std::accumulate(elements.begin(), elements.end(), std::uint64_t{0}), 5u);
        EXPECT_EQ(elements.back(), 5u);
        return executor.counts;
    };
    EXPECT_EQ(launches(0), Counts{});
    EXPECT_EQ(launches(6), Counts{6});
    EXPECT_EQ(launches(7), Counts{7});
    EXPECT_EQ(launches(8), (Counts{7, 1}));
    EXPECT_EQ(launches(21), (Counts{7, 7, 7}));
    static_assert(fast::most_per_launch == std::numeric_limits<std::uint32_t>::max());
}

template <class Function>
std::string refusal_of(const Function& function)
{
    try {
        function();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(BatchRenderer, RefusesWhatItsNumbersCannotCount)
{
    EXPECT_EQ(fast::pixel_count(65535, 65537), 0xffff'ffffu);
    const auto size = [](int w, int h) {
        return refusal_of([&] { (void)fast::host_renderer(our_scene("cornell_glass"), w, h, {}, 1); });
    };
    const std::string expected = " pixels: expected 1 to 4294967295 pixels";
    EXPECT_EQ(size(65536, 65536), "a picture of 65536x65536" + expected); // 2^32 would wrap around to 0
    EXPECT_EQ(size(65537, 65536), "a picture of 65537x65536" + expected); // and this to 65536
    EXPECT_EQ(size(0, 5), "a picture of 0x5" + expected);
    EXPECT_EQ(size(-2, -3), "a picture of -2x-3" + expected);

    const auto renderer =
        fast::host_renderer(our_scene("cornell_glass"), 2, 2, short_paths(Integrator::path), 1);
    const std::uint64_t last = (std::uint64_t{1} << 32) / 4 - 1; // of four samples per pixel
    EXPECT_TRUE(renderer->render_batch(last, {}));
    EXPECT_EQ(refusal_of([&] { (void)renderer->render_batch(last + 1, {}); }),
              "batch 1073741824 of 4 samples per pixel: a pixel has at most 2^32 samples");
    EXPECT_EQ(fast::first_sample_of(0xffff'ffff, 1), 0xffff'ffffu);
    EXPECT_THROW((void)fast::first_sample_of(std::uint64_t{1} << 62, 4), std::invalid_argument);
}

RC_GTEST_PROP(BatchRenderer, DeterministicBitsDependOnNothingButTheSamples, ())
{
    const auto scene =
        our_scene(*rc::gen::element<std::string>("cornell_glass", "all_emitters", "mesh_knot"));
    auto options = short_paths(*rc::gen::element(Integrator::path, Integrator::bdpt, Integrator::light));
    options.deterministic = true;
    options.batch_size = *rc::gen::inRange(1u, 6u);
    const auto number = *rc::gen::inRange<std::uint64_t>(0, 4);
    const images::Image one = batch_of(scene, options, 1, width * height * 8, number);
    const auto threads = *rc::gen::inRange(1u, 4u);
    const auto launch = *rc::gen::inRange(1u, 300u);
    RC_ASSERT(batch_of(scene, options, threads, launch, number) == one);
}

/// The batch computed from the contributions of its samples, summed in double.
images::Image sum_of_samples(const scenes::Scene& scene, const images::RenderOptions& options,
                             std::uint64_t number)
{
    const ContributionRecorder recorder(scene, width, height);
    images::Image sum(width, height);
    for (std::uint32_t pixel = 0; pixel < width * height; ++pixel)
        for (std::uint32_t i = 0; i < options.batch_size; ++i) {
            const auto sample = static_cast<std::uint32_t>(number * options.batch_size + i);
            for (const RecordedContribution& c :
                 recorder.sample(recorder.needs(), options.integrator,
                                 {options.seed, options.max_edges, options.heuristic},
                                 {options.seed, pixel, sample}))
                sum.pixels[c.pixel] += images::Rgb(c.value) * static_cast<double>(c.weight);
        }
    for (images::Rgb& pixel : sum.pixels) pixel /= options.batch_size;
    return sum;
}

/// Expects that the two pictures differ by at most `bound`, relative to the expected one.
void expect_within(double bound, const images::Image& batch, const images::Image& expected)
{
    for (std::size_t i = 0; i < expected.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(batch.pixels[i][channel], expected.pixels[i][channel],
                        bound * expected.pixels[i][channel])
                << "pixel " << i;
}

TEST(BatchRenderer, AddsUpAllContributionsOfAllSamples) // map: splat
{
    for (const Integrator integrator : {Integrator::path, Integrator::bdpt, Integrator::light}) {
        const auto scene = our_scene("cornell_glass");
        const auto options = short_paths(integrator);
        const images::Image expected = sum_of_samples(scene, options, 3);
        const images::Image batch = batch_of(scene, options, 2, 50, 3);
        // A pixel is a sum of terms >= 0: each rounding has an error of at most 2^-24 of the sum. A
        // sample adds fewer than 32 terms to its own pixel, four samples are added in turn, and fewer
        // than 1000 splats fall on a pixel of so small a picture.
        const double bound = 0x1p-24 * (32 + 4 + 1000);
        expect_within(bound, batch, expected);
    }
}

// A thread takes blocks of 512 samples; here there are 13 of them.
TEST(BatchRenderer, AddsUpTheSplatsOfAllThreads)
{
    const auto scene = our_scene("cornell_glass");
    auto options = short_paths(Integrator::light);
    options.batch_size = 60;
    const images::Image expected = sum_of_samples(scene, options, 0);
    const images::Image batch = batch_of(scene, options, 3, width * height * 60, 0);
    // As above; 60 samples have 15 times as many splats as 4.
    const double bound = 0x1p-24 * 15 * 1000;
    expect_within(bound, batch, expected);
}

TEST(BatchRenderer, ABatchDoesNotDependOnThoseBefore)
{
    for (const bool deterministic : {false, true}) {
        auto options = short_paths(Integrator::bdpt);
        options.strategies = images::StrategyPictures::weighted;
        options.deterministic = deterministic;
        const auto renderer = fast::host_renderer(our_scene("cornell_glass"), width, height, options, 1);
        const images::Batch first = *renderer->render_batch(0, {});
        const images::Batch second = *renderer->render_batch(1, {});
        EXPECT_FALSE(first.mean == second.mean);
        const images::Batch again = *renderer->render_batch(0, {});
        EXPECT_TRUE(again.mean == first.mean);
        EXPECT_TRUE(again.strategies == first.strategies);
    }
}

TEST(BatchRenderer, WeightedLayersAddUpToThePicture)
{
    for (const bool deterministic : {false, true}) {
        auto options = short_paths(Integrator::bdpt);
        options.strategies = images::StrategyPictures::weighted;
        options.deterministic = deterministic;
        fast::HostMemory memory;
        fast::HostThreads executor(2, 1);
        // Three launches, of which two do not begin at pixel 0.
        fast::BatchRenderer renderer(memory, executor, {50, 50, std::size_t{1} << 30},
                                     our_scene("cornell_glass"), width, height, options, {});
        const images::Batch batch = *renderer.render_batch(0, {});
        // (s, t) of 1 to 5 edges.
        EXPECT_EQ(batch.strategies.size(), 2u + 3 + 4 + 5 + 6);
        for (std::size_t i = 0; i < batch.mean.pixels.size(); ++i) {
            images::Rgb sum(0.0);
            for (const auto& [strategy, image] : batch.strategies) sum += image.pixels[i];
            sum /= options.batch_size;
            for (int channel = 0; channel < 3; ++channel) // roundings as above
                EXPECT_NEAR(sum[channel], batch.mean.pixels[i][channel],
                            0x1p-24 * 2 * (32 + 4 + 1000) * sum[channel]);
        }
    }
}

TEST(BatchRenderer, UnweightedLayersHoldWhatEachStrategyFound)
{
    const auto scene = our_scene("all_emitters");
    auto options = short_paths(Integrator::bdpt);
    options.strategies = images::StrategyPictures::unweighted;
    options.deterministic = true;
    const auto renderer = fast::host_renderer(scene, width, height, options, 2);
    const images::Batch batch = *renderer->render_batch(0, {});
    std::map<std::pair<int, int>, images::Rgb> expected;
    const ContributionRecorder recorder(scene, width, height);
    for (std::uint32_t pixel = 0; pixel < width * height; ++pixel)
        for (std::uint32_t sample = 0; sample < options.batch_size; ++sample)
            for (const RecordedContribution& c :
                 recorder.sample(recorder.needs(), Integrator::bdpt, {7, 5, fast::Heuristic::balance},
                                 {7, pixel, sample}))
                expected[{c.s, c.t}] += images::Rgb(c.value);
    for (const auto& [strategy, image] : batch.strategies) {
        const images::Rgb sum =
            std::accumulate(image.pixels.begin(), image.pixels.end(), images::Rgb(0.0));
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(sum[channel], expected[strategy][channel], 1e-6 * expected[strategy][channel])
                << strategy.first << ", " << strategy.second;
    }
}

TEST(BatchRenderer, StopsBetweenLaunchesAndGoesOnAsIfNothingHadBeen)
{
    fast::HostMemory memory;
    fast::HostThreads executor(1);
    fast::BatchRenderer renderer(memory, executor, {8192, 8192, std::size_t{1} << 30},
                                 our_scene("cornell_diffuse"), 100, 100, short_paths(Integrator::bdpt),
                                 {}); // five launches
    const images::Image whole = renderer.render_batch(2, {})->mean;
    int asked = 0;
    std::vector<double> parts;
    const images::Monitor monitor{[&](double part) { parts.push_back(part); },
                                  [&] { return ++asked > 2; }};
    EXPECT_FALSE(renderer.render_batch(2, monitor));
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_GT(parts[0], 2.0);
    EXPECT_LT(parts[0], parts[1]);
    EXPECT_LT(parts[1], 3.0);
    EXPECT_TRUE(renderer.render_batch(2, {})->mean == whole);
}

TEST(BatchRenderer, RefusesOptionsThatOnlyTheReferenceHas)
{
    const auto scene = our_scene("cornell_diffuse");
    const auto refusal = [&](const images::RenderOptions& options) {
        return refusal_of([&] { (void)fast::host_renderer(scene, 8, 8, options, 1); });
    };
    EXPECT_EQ(refusal({.roulette_from = 4}),
              "the fast path has no choice of the first bounce of roulette: only the reference does");
    EXPECT_EQ(refusal({.heuristic = images::Heuristic::uniform}),
              "the fast path has no uniform weights: only the reference does");
    EXPECT_EQ(refusal({.families = {.light_image = false}}),
              "the fast path has no choice of the families of strategies: only the reference does");
}

TEST(BatchRenderer, RefusesOptionsThatContradictEachOther)
{
    const auto scene = our_scene("cornell_diffuse");
    images::RenderOptions options;
    options.max_edges = 0;
    EXPECT_THROW(fast::host_renderer(scene, 8, 8, options, 1), std::invalid_argument);
    options.max_edges = images::most_edges_of_strategies + 1;
    options.strategies = images::StrategyPictures::weighted;
    EXPECT_THROW(fast::host_renderer(scene, 8, 8, options, 1), std::invalid_argument);
}

// Longer walks than memory is needed for have a probability of at most 2^-24. The bounces that roulette
// spares end no walk.
TEST(LightVertices, HaveMemoryForEveryWalkThatMayOccur)
{
    constexpr int spared = fast::bounces_without_roulette + 1; // the vertices that are always reached
    fast::SceneArrays arrays;
    const auto most = [&](float survival, int max_edges) {
        arrays.largest_survival = survival;
        return fast::most_light_vertices(arrays, max_edges);
    };
    EXPECT_EQ(most(0.0f, 1000), spared);
    EXPECT_EQ(most(0x1p-24f, 1000), spared + 1);
    EXPECT_EQ(most(0.5f, 1000), spared + 24);
    EXPECT_EQ(most(0.5f, spared + 23), spared + 23);
    EXPECT_EQ(most(1.0f, 1000), 1000);
}

TEST(BatchRenderer, ASceneWithoutLightIsBlack)
{
    scenes::Scene scene = our_scene("point_over_plane");
    scene.point_lights.clear();
    for (const Integrator integrator : {Integrator::path, Integrator::bdpt, Integrator::light}) {
        const images::Image image = batch_of(scene, short_paths(integrator), 1, 64, 0);
        for (const images::Rgb& pixel : image.pixels) EXPECT_EQ(pixel, images::Rgb(0.0));
    }
}

// The parts that a kernel leaves out change no bit of its result.
TEST(Needs, LeavingOutWhatASceneDoesNotHaveChangesNothing)
{
    std::array<bool, fast::compiled_needs.size()> seen{};
    for (const auto& file : transport_test::our_scene_files()) {
        const scenes::Scene scene = scenes::read_scene(file);
        const ContributionRecorder recorder(scene, width, height);
        const fast::Needs needs = recorder.needs();
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const fast::Needs& compiled = fast::compiled_needs[i];
            if (compiled == fast::compiled_for(needs)) seen[i] = true;
            if ((compiled | needs) != compiled || compiled == fast::any_needs) continue;
            for (std::uint32_t pixel = 0; pixel < width * height; ++pixel)
                for (const Integrator integrator :
                     {Integrator::path, Integrator::bdpt, Integrator::light}) {
                    const fast::PathOptions options{1, 6, fast::Heuristic::balance};
                    EXPECT_EQ(recorder.sample(compiled, integrator, options, {1, pixel, 0}),
                              recorder.sample(fast::any_needs, integrator, options, {1, pixel, 0}))
                        << scene.name << ", kernel " << i << ", pixel " << pixel;
                }
        }
    }
    for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_TRUE(seen[i]) << "no scene uses kernel " << i;
}

TEST(Needs, AreRoundedUpToTheSmallestCompiledOnesThatIncludeThem)
{
    const auto count = [](const fast::Needs& needs) {
        return int{needs.spheres} + int{needs.specular} + int{needs.other_lights} +
               int{needs.coincident};
    };
    for (const bool spheres : {false, true})
        for (const bool specular : {false, true})
            for (const unsigned others : {0u, 1u, 2u, 3u}) {
                const fast::Needs needs{spheres, specular, (others & 1) != 0, (others & 2) != 0};
                const fast::Needs chosen = fast::compiled_for(needs);
                EXPECT_EQ(chosen | needs, chosen);
                EXPECT_NE(std::ranges::find(fast::compiled_needs, chosen), fast::compiled_needs.end());
                for (const fast::Needs& compiled : fast::compiled_needs)
                    if ((compiled | needs) == compiled) {
                        EXPECT_LE(count(chosen), count(compiled));
                    }
                int calls = 0;
                fast::with_needs(needs, [&]<fast::Needs known>() {
                    ++calls;
                    EXPECT_EQ(known, chosen);
                });
                EXPECT_EQ(calls, 1);
            }
}

TEST(Needs, OfARendererAreThoseThatItsKernelsAreCompiledFor)
{
    const auto needs_of = [](const char* scene, fast::Needs at_least = {}) {
        return fast::host_renderer(our_scene(scene), width, height, short_paths(Integrator::path), 1,
                                   {.at_least = at_least})
            ->needs();
    };
    EXPECT_EQ(needs_of("mesh_knot"), fast::Needs{});
    EXPECT_EQ(needs_of("cornell_diffuse"), (fast::Needs{true, true, false})); // spheres alone
    EXPECT_EQ(needs_of("point_over_plane"), fast::any_needs);                 // another light alone
    EXPECT_EQ(needs_of("mesh_knot", {false, true, false}), (fast::Needs{true, true, false}));

    scenes::Scene doubled = our_scene("mesh_knot");
    doubled.triangles.push_back(doubled.triangles.front()); // surfaces that coincide, alone
    EXPECT_EQ(fast::host_renderer(doubled, width, height, short_paths(Integrator::path), 1)->needs(),
              fast::any_needs);
}

TEST(RendererOptions, ChangeNoBitOfAPicture)
{
    for (const std::string& name : transport_test::our_scene_names()) {
        const scenes::Scene scene = our_scene(name);
        for (const Integrator integrator : {Integrator::path, Integrator::bdpt, Integrator::light}) {
            auto options = short_paths(integrator);
            options.deterministic = true;
            const auto picture = [&](const fast::RendererOptions& choices) {
                return fast::host_renderer(scene, width, height, options, 1, choices)
                    ->render_batch(0, {})
                    ->mean;
            };
            const images::Image expected = picture({});
            for (const fast::TreeBuilder tree : fast::tree_builders)
                EXPECT_TRUE(picture({.tree = tree}) == expected) << name << ", " << name_of(tree);
            for (std::size_t i = 0; i < fast::compiled_needs.size(); ++i)
                EXPECT_TRUE(picture({.at_least = fast::compiled_needs[i]}) == expected)
                    << name << ", kernel " << i;
        }
    }
}

TEST(RendererOptions, DecideOnTheTree)
{
    const auto tree_of = [](const fast::RendererOptions& choices) {
        return fast::host_renderer(our_scene("mesh_knot"), width, height, short_paths(Integrator::path),
                                   1, choices)
            ->tree();
    };
    EXPECT_EQ(tree_of({}), fast::TreeBuilder::hploc63);
    for (const fast::TreeBuilder tree : fast::tree_builders) EXPECT_EQ(tree_of({.tree = tree}), tree);
}

// scenes::requirements decides which kernel is used. Black lights require nothing.
TEST(Needs, OfBlackLightsAreEmptyAndTheLightsChangeNoBit)
{
    const scenes::Scene scene = our_scene("cornell_diffuse");
    scenes::Scene more = scene;
    const scenes::Rgb black(0.0);
    more.point_lights.push_back({scenes::Vec3(0.0), black});
    more.spot_lights.push_back({scenes::Vec3(0.0), scenes::Vec3(0, 0, 1), black, 0.5, 1.0});
    more.directional_lights.push_back({scenes::Vec3(0, 0, 1), black});
    more.environment = black;
    const fast::Needs needs = ContributionRecorder(scene, width, height).needs();
    EXPECT_EQ(needs, (fast::Needs{true, false, false})); // it has spheres
    EXPECT_EQ(ContributionRecorder(more, width, height).needs(), needs);
    for (const Integrator integrator : {Integrator::path, Integrator::bdpt, Integrator::light}) {
        const auto options = short_paths(integrator);
        EXPECT_EQ(batch_of(more, options, 1, 64, 0).pixels, batch_of(scene, options, 1, 64, 0).pixels);
    }
}

class RendererOnDevice : public parallel_test::OnDevice {};

TEST_F(RendererOnDevice, GivesTheHostsPicture)
{
    for (const Integrator integrator : {Integrator::path, Integrator::bdpt, Integrator::light}) {
        const auto scene = our_scene("cornell_glass");
        auto options = short_paths(integrator);
        options.deterministic = true;
        const images::Image host = batch_of(scene, options, 1, 512, 0);
        const images::Image device =
            fast::device_renderer(scene, width, height, options)->render_batch(0, {})->mean;
        // Sine, cosine and power differ in their last bits between the two. Sometimes a path changes
        // because of this, and then a pixel of four samples changes. Most pixels agree up to rounding.
        std::size_t different = 0;
        for (std::size_t i = 0; i < host.pixels.size(); ++i)
            if (glm::length(host.pixels[i] - device.pixels[i]) > 1e-3 * glm::length(host.pixels[i]))
                ++different;
        EXPECT_LE(different, host.pixels.size() / 20);
    }
}

TEST_F(RendererOnDevice, DeterministicMeansTheSameBitsAgain)
{
    auto options = short_paths(Integrator::bdpt);
    options.deterministic = true;
    const auto renderer = fast::device_renderer(our_scene("cornell_glass"), 64, 64, options);
    const images::Image first = renderer->render_batch(0, {})->mean;
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(renderer->render_batch(0, {})->mean == first);
}

} // namespace
