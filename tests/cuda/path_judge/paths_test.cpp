// Path by path: every sample of the fast path must agree, step by step and strategy by strategy, with
// the reference for the same random numbers (method: followed_walk.h; tolerances: path_rounding.h and
// path_weights.cpp).

#include "tests/cuda/path_judge/judged_paths.h"
#include "tests/cuda/transport/float_scene.h"
#include "tests/ref/transport/random_scene.h"
#include "tests/ref/transport/scene_files.h"

#include "cuda/launch/renderer.h"
#include "scenes/read_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace {

using path_judge_test::Disagreement;
using path_judge_test::Tally;

constexpr int width = 24;
constexpr int height = 16;

bool at_length()
{
    return std::getenv("PLUMBLINE_LONG") != nullptr;
}

struct Job {
    fast::Integrator integrator;
    ref::PathOptions options;
};

std::string name_of(fast::Integrator integrator)
{
    using enum fast::Integrator;
    return integrator == path ? "path" : integrator == bdpt ? "bdpt" : "light";
}

/// A scene in both wings.
class BothWings {
public:
    BothWings(const scenes::Scene& scene, bool roulette)
        : scene_(fast_transport_test::float_scene(scene)), world_(scene_, width, height),
          floats_(scene_, width, height, roulette)
    {}
    /// Throws Disagreement that names the sample.
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
    path_judge_test::WalkRecorder floats_;
};

/// The scene without some of its surfaces and lights, so that a failure shrinks to those that matter.
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
    using enum fast::Integrator;
    Job job{*rc::gen::element(bdpt, bdpt, path, light), {}};
    job.options.seed = *transport_test::any_word();
    job.options.heuristic = *rc::gen::element(ref::Heuristic::balance, ref::Heuristic::power);
    job.options.roulette = *rc::gen::element(true, true, false);
    job.options.max_edges = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(1, 14));
    if (job.options.max_edges == 13 && job.options.roulette) job.options.max_edges = fast::most_edges;
    return job;
}

/// Only few samples may be so close to a threshold that they are not judged; otherwise the test would
/// detect nothing. At most one in a thousand samples may be left out, or have a strategy that is left
/// out. The weight may be too inaccurate to compare for at most the fraction `without_weight` of the
/// contributions; long walks over small spheres have more of these.
void expect_few_left(const Tally& tally, double without_weight)
{
    std::cout << tally.report();
    EXPECT_GT(tally.contributions, tally.samples / 10);
    EXPECT_LE(static_cast<double>(tally.left()), 0.001 * static_cast<double>(tally.samples));
    EXPECT_LE(static_cast<double>(tally.weights_left_open),
              without_weight * static_cast<double>(tally.contributions));
}

// map: film-position, camera-ray, camera-projection, importance, camera-density
// map: emission-surface, emission-triangle, emission-sphere, emission-point, emission-directional
// map: emission-environment, emitted-radiance, geometric-term, area-conversion, throughput, roulette
// map: cosine-sampling, bsdf-lambertian, bsdf-mirror, bsdf-glass
// map: refraction, fresnel, eta-squared, delta-lobe
// map: emission-hit, next-event, light-image, inner-connection
// map: density-y0, density-y1, density-light, density-z1, density-eye
TEST(PathsInFloat, AreThoseOfTheReferenceInRandomScenes)
{
    Tally tally;
    const std::uint32_t samples = at_length() ? 20'000 : 600;
    const bool holds = rc::check("every sample agrees with the reference", [&] {
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
    using enum fast::Integrator;
    scenes::Scene scene;
    scene.camera =
        scenes::Camera{scenes::Vec3(0.0),     scenes::Vec3(1, 0, 0),       scenes::Vec3(0, 1, 0),
                       scenes::Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.0};
    scene.environment = scenes::Rgb(0.5, 1.0, 2.0);
    const BothWings wings(scene, true);
    Tally tally;
    for (const auto integrator : {bdpt, path, light}) wings.judge({integrator, {1, 4}}, 0, 0, tally);
    EXPECT_EQ(tally.contributions, 2); // no light walk starts there
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
        for (const int max_edges : {1, 2, 3, 6, 12, roulette ? fast::most_edges : 8})
            for (const auto integrator :
                 {fast::Integrator::bdpt, fast::Integrator::path, fast::Integrator::light})
                for (std::uint32_t i = 0; i < count; ++i) {
                    const auto heuristic = i % 4 == 3 ? ref::Heuristic::power : ref::Heuristic::balance;
                    const Job job{integrator,
                                  {.seed = 7,
                                   .max_edges = max_edges,
                                   .roulette = roulette,
                                   .heuristic = heuristic}};
                    try {
                        wings.judge(job, 5 * sample % (width * height), sample, tally);
                    } catch (const Disagreement& why) {
                        FAIL() << why.what();
                    }
                    ++sample;
                }
    }
    // Where lights lie in the plane of a surface that they shine along, every path to that surface may
    // be blocked by rounding. No such path may disagree, but many are left out here; touching_test.cpp
    // compares their means.
    if (scene.name == "flush_lights")
        std::cout << tally.report();
    else
        expect_few_left(tally, 0.005);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PathsInFloatOf, testing::ValuesIn(transport_test::our_scene_files()),
                         [](const auto& file) { return file.param.stem().string(); });

} // namespace
