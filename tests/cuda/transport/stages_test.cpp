// The stages give the same bits as the kernel for whole samples, with every instruction set and number
// of threads. stage_launches_test.cpp is about the order in queues.

#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/host_kernels.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using transport_test::our_scene;

/// A batch by the kernel that computes whole samples.
images::Batch whole_samples(const scenes::Scene& scene, int width, int height,
                            const images::RenderOptions& options)
{
    fast::HostMemory memory;
    fast::ThreadedExecutor executor(1);
    fast::BatchRenderer renderer(memory, executor, {4096, 4096, std::size_t{1} << 30}, scene, width,
                                 height, options, {});
    return *renderer.render_batch(3, {});
}

void expect_same(const images::Batch& a, const images::Batch& b, const std::string& what)
{
    EXPECT_EQ(a.mean.pixels, b.mean.pixels) << what;
    ASSERT_EQ(a.strategies.size(), b.strategies.size()) << what;
    for (const auto& [strategy, image] : a.strategies)
        EXPECT_EQ(image.pixels, b.strategies.at(strategy).pixels)
            << what << ", strategy " << strategy.first << ", " << strategy.second;
    EXPECT_EQ(a.dropped.count, b.dropped.count) << what;
}

class Staged : public testing::TestWithParam<std::string> {};

// Splats are summed exactly here, because the order in which floats are added counts.
TEST_P(Staged, SamplesHaveTheBitsOfWholeSamples)
{
    const scenes::Scene scene = our_scene(GetParam());
    constexpr int width = 21; // not a multiple of the lanes
    constexpr int height = 14;
    images::RenderOptions options;
    options.max_edges = 9; // beyond the bounces without roulette
    options.batch_size = 3;
    options.seed = 12345678901;
    options.deterministic = true;
    for (const auto integrator :
         {images::Integrator::path, images::Integrator::bdpt, images::Integrator::light})
        for (const auto strategies :
             {images::StrategyPictures::none, images::StrategyPictures::weighted}) {
            options.integrator = integrator;
            options.strategies = strategies;
            const images::Batch expected = whole_samples(scene, width, height, options);
            for (const fast::InstructionSet set : fast::instruction_sets())
                for (const unsigned threads : {1u, 3u})
                    expect_same(*fast::host_renderer(scene, width, height, options, threads,
                                                     {.instructions = set})
                                     ->render_batch(3, {}),
                                expected,
                                "integrator " + std::to_string(static_cast<int>(integrator)) + ", " +
                                    std::string(name_of(set)) + ", " + std::to_string(threads) +
                                    " threads");
        }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Staged, testing::ValuesIn(transport_test::our_scene_names()),
                         [](const auto& tested) { return tested.param; });

TEST(InstructionSets, OfTheSameBitsAreWithoutFastMath)
{
    for (const fast::InstructionSet set : fast::instruction_sets())
        EXPECT_NE(set, fast::InstructionSet::fastmath);
    EXPECT_NE(fast::best_instruction_set(), fast::InstructionSet::fastmath);
    EXPECT_EQ(name_of(fast::InstructionSet::fastmath), "fastmath");
}

class EveryInstructionSet : public testing::TestWithParam<images::Integrator> {};

TEST_P(EveryInstructionSet, GivesTheSameDeterministicPicture)
{
    images::RenderOptions options;
    options.integrator = GetParam();
    options.max_edges = 6;
    options.deterministic = true;
    options.strategies = images::StrategyPictures::unweighted;
    for (const char* name : {"cornell_glass", "all_emitters"}) {
        const scenes::Scene scene = our_scene(name);
        const auto render = [&](unsigned threads, fast::InstructionSet set) {
            return *fast::host_renderer(scene, 16, 12, options, threads, {.instructions = set})
                        ->render_batch(0, {});
        };
        const images::Batch expected = render(1, fast::InstructionSet::baseline);
        for (const fast::InstructionSet set : fast::instruction_sets())
            expect_same(render(2, set), expected, std::string(name) + ", " + std::string(name_of(set)));
    }
}

INSTANTIATE_TEST_SUITE_P(Integrators, EveryInstructionSet,
                         testing::Values(images::Integrator::path, images::Integrator::bdpt,
                                         images::Integrator::light));

} // namespace
