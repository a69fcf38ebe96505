// The stages give the same bits as the kernel for whole samples, with every instruction set and number
// of threads, and in every order of the queues.

#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/host_kernels.h"
#include "cuda/stages/trace_paths.h"
#include "cuda/stages/trace_rays.h"
#include "tests/cuda/parallel/interleaved_executor.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <random>
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
                    expect_same(*fast::host_renderer(scene, width, height, options, threads, set)
                                     ->render_batch(3, {}),
                                expected,
                                "integrator " + std::to_string(static_cast<int>(integrator)) + ", " +
                                    std::string(name_of(set)) + ", " + std::to_string(threads) +
                                    " threads");
        }
}

std::vector<std::string> names_of_our_scenes()
{
    std::vector<std::string> names;
    for (const auto& file : transport_test::our_scene_files()) names.push_back(file.stem());
    return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Staged, testing::ValuesIn(names_of_our_scenes()),
                         [](const auto& tested) { return tested.param; });

/// The samples of one launch of `scene`, by the stages for one index on `executor`.
template <class E>
std::vector<fast::Rgb> traced_on(E& executor, const scenes::Scene& scene)
{
    constexpr fast::Launch launch{0, 8 * 6, 0, 2};
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    const fast::SceneInMemory in_memory(memory, serial, arrays,
                                        fast::camera_of(scene, arrays.place, 8, 6));
    std::vector<fast::Rgb> own(launch.count(), fast::Rgb(-1.0f));
    std::vector<fast::DroppedCount> dropped(1);
    const fast::FilmTarget film{own, {}, {}, dropped, false, launch.pixels};
    std::vector<std::uint32_t> words(fast::PathMemory::words_for(launch.count()));
    fast::PathMemory paths(words, launch.count());
    paths.trace(executor,
                fast::StageJob<fast::any_needs>{
                    in_memory.view<fast::any_needs>(), {7, 5, images::Heuristic::balance}, launch, film},
                0, launch.count());
    return own;
}

// The queues are filled by atomic counts, in an order that depends on the schedule.
TEST(StagedPaths, DoNotDependOnTheOrderInTheirQueues)
{
    const scenes::Scene scene = our_scene("cornell_glass");
    fast::SerialExecutor serial;
    const std::vector<fast::Rgb> expected = traced_on(serial, scene);
    for (const std::uint32_t threads : {2u, 4u}) {
        fast::ThreadedExecutor executor(threads, 1);
        EXPECT_EQ(traced_on(executor, scene), expected) << threads << " threads";
    }
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        std::mt19937_64 schedule(seed);
        parallel_test::InterleavedExecutor adversary(
            6, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(schedule() % ready); });
        EXPECT_EQ(traced_on(adversary, scene), expected) << "schedule " << seed;
    }
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
            return *fast::host_renderer(scene, 16, 12, options, threads, set)->render_batch(0, {});
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
