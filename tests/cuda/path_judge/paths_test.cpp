// Path by path: every sample of the fast path, step by step and strategy by strategy, is what the
// reference makes of the same random numbers (followed_walk.h says how that is judged, path_rounding.h
// and path_weights.cpp to within what).

#include "tests/cuda/path_judge/judged_paths.h"
#include "tests/cuda/transport/float_scene.h"
#include "tests/ref/transport/random_scene.h"
#include "tests/ref/transport/scene_files.h"

#include "cuda/transport/renderer.h"
#include "scenes/read_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace {

using cuda_test::Disagreement;
using cuda_test::Tally;

constexpr int width = 24;
constexpr int height = 16;

bool at_length()
{
    return std::getenv("PLUMBLINE_LONG") != nullptr;
}

struct Job {
    gpu::Integrator integrator;
    ref::PathOptions options;
};

std::string name_of(gpu::Integrator integrator)
{
    using enum gpu::Integrator;
    return integrator == path ? "path" : integrator == bdpt ? "bdpt" : "light";
}

/// Both wings' view of a scene.
class BothWings {
public:
    BothWings(const scenes::Scene& scene, bool roulette)
        : scene_(cuda_test::float_scene(scene)), world_(scene_, width, height),
          floats_(scene_, width, height, roulette)
    {}
    /// Throws Disagreement, which names the sample.
    void judge(const Job& job, std::uint32_t pixel, std::uint32_t sample, Tally& tally) const
    {
        try {
            judge_sample({world_, job.options, {job.options.seed, pixel, sample}}, floats_,
                         job.integrator, tally);
        } catch (const Disagreement& why) {
            std::ostringstream text;
            text << name_of(job.integrator) << ", seed " << job.options.seed << ", max_edges "
                 << job.options.max_edges << ", pixel " << pixel << ", sample " << sample << ": "
                 << why.what();
            throw Disagreement(text.str());
        }
    }

private:
    scenes::Scene scene_;
    ref::World world_;
    cuda_test::WalkRecorder floats_;
};

/// What is left of a scene when some surfaces and lights are gone: it shrinks to those that matter.
scenes::Scene any_part_of(scenes::Scene scene)
{
    const auto thin = [](auto& things) {
        std::erase_if(things, [](const auto&) { return *rc::gen::inRange(0, 24) == 0; });
    };
    thin(scene.triangles);
    thin(scene.spheres);
    thin(scene.point_lights);
    thin(scene.spot_lights);
    thin(scene.directional_lights);
    return scene;
}

Job any_job()
{
    using enum gpu::Integrator;
    Job job{*rc::gen::element(bdpt, bdpt, path, light), {}};
    job.options.seed = *transport_test::any_word();
    job.options.heuristic = *rc::gen::element(ref::Heuristic::balance, ref::Heuristic::power);
    job.options.roulette = *rc::gen::element(true, true, false);
    job.options.max_edges = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(1, 14));
    if (job.options.max_edges == 13 && job.options.roulette) job.options.max_edges = gpu::most_edges;
    return job;
}

/// Few are so close to a threshold that they are not judged: else the judge would be blind. At most one
/// in a thousand samples is left, or has a strategy that is; and of so many contributions at most the
/// weight is known too badly to compare, which long walks over small spheres have more of.
void expect_few_left(const Tally& tally, double without_weight)
{
    std::cout << tally.report();
    EXPECT_GT(tally.contributions, tally.samples / 10);
    EXPECT_LE(static_cast<double>(tally.left()), 0.001 * static_cast<double>(tally.samples));
    EXPECT_LE(static_cast<double>(tally.weights_left_open),
              without_weight * static_cast<double>(tally.contributions));
}

TEST(PathsInFloat, AreThoseOfTheReferenceInRandomScenes)
{
    Tally tally;
    const std::uint32_t samples = at_length() ? 20'000 : 600;
    const bool holds = rc::check("every sample is what the reference makes of it", [&] {
        const scenes::Scene scene = any_part_of(transport_test::any_scene());
        const Job job = any_job();
        const BothWings wings(scene, job.options.roulette);
        const auto pixel =
            *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0u, unsigned{width * height}));
        for (std::uint32_t i = 0; i < samples; ++i) {
            try {
                wings.judge(job, (pixel + i) % (width * height), i, tally);
            } catch (const Disagreement& why) {
                RC_FAIL(why.what());
            }
        }
    });
    EXPECT_TRUE(holds);
    expect_few_left(tally, 0.05);
}

TEST(PathsInFloat, SeeASkyWhereThereIsNothingElse)
{
    using enum gpu::Integrator;
    scenes::Scene scene;
    scene.camera =
        scenes::Camera{scenes::Vec3(0.0),     scenes::Vec3(1, 0, 0),       scenes::Vec3(0, 1, 0),
                       scenes::Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.0};
    scene.environment = scenes::Rgb(0.5, 1.0, 2.0);
    const BothWings wings(scene, true);
    Tally tally;
    for (const auto integrator : {bdpt, path, light}) wings.judge({integrator, {1, 4}}, 0, 0, tally);
    EXPECT_EQ(tally.contributions, 2); // no light walk begins there
    EXPECT_EQ(tally.left(), 0);
}

class PathsInFloatOf : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(PathsInFloatOf, AreThoseOfTheReference)
{
    const scenes::Scene scene = scenes::read_scene(GetParam());
    Tally tally;
    std::uint32_t sample = 0;
    const std::uint32_t count = at_length() ? 10'000 : 200;
    for (const bool roulette : {true, false}) {
        const BothWings wings(scene, roulette);
        for (const int max_edges : {1, 2, 3, 6, 12, roulette ? gpu::most_edges : 8})
            for (const auto integrator :
                 {gpu::Integrator::bdpt, gpu::Integrator::path, gpu::Integrator::light})
                for (std::uint32_t i = 0; i < count; ++i) {
                    const auto heuristic = i % 4 == 3 ? ref::Heuristic::power : ref::Heuristic::balance;
                    const Job job{integrator, {7, max_edges, roulette, heuristic}};
                    try {
                        wings.judge(job, 5 * sample % (width * height), sample, tally);
                    } catch (const Disagreement& why) {
                        FAIL() << why.what();
                    }
                    ++sample;
                }
    }
    // Where lights lie in the plane of what they shine along, every path to that plane is within
    // rounding of being blocked. No such path may disagree, but many are left to touching_test.cpp,
    // which judges means.
    if (scene.name == "flush_lights")
        std::cout << tally.report();
    else
        expect_few_left(tally, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathsInFloatOf, testing::ValuesIn(transport_test::our_scene_files()),
                         [](const auto& file) { return file.param.stem().string(); });

} // namespace
