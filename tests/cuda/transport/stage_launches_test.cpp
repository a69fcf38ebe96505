// Launches in stages by the code that a GPU uses (launch_stages.h): the same bits as whole samples, in
// every order of the queues, in memory that the host cannot access; and with a GPU, there.

#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/launch_stages.h"
#include "cuda/parallel/threaded_executor.h"
#include "cuda/stages/trace_rays.h"
#include "tests/cuda/parallel/any_executor.h"
#include "tests/cuda/parallel/far_memory.h"
#include "tests/cuda/parallel/interleaved_executor.h"
#include "tests/cuda/parallel/kernel_name.h"
#include "tests/cuda/parallel/on_device.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace {

using fast::Integrator;
using parallel_test::AnyExecutor;
using transport_test::our_scene;

constexpr int width = 7;
constexpr int height = 5;
constexpr std::uint32_t pixels = width * height;
/// The second finds what the first one has left in memory.
constexpr fast::Launch launches[] = {{0, pixels, 0, 2}, {0, pixels, 2, 2}};
constexpr int longest = 7;                    // path, in edges: beyond the bounces without roulette
constexpr std::uint32_t samples = 2 * pixels; // of each

/// All that the launches have written.
struct Film {
    std::vector<fast::Rgb> own;
    std::vector<std::uint64_t> splats; // the words of exact sums
    std::uint64_t dropped;
    friend bool operator==(const Film&, const Film&) = default;
};

/// The film of the launches of `scene` on `executor`. `serial` is on the same memory, and builds the
/// tree.
template <Integrator integrator, class E>
Film film_of(const scenes::Scene& scene, fast::Memory& memory, AnyExecutor& serial, E& executor)
{
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    const fast::SceneInMemory in_memory(memory, serial, arrays,
                                        fast::camera_of(scene, arrays.place, width, height));
    const int capacity = integrator == Integrator::bdpt ? fast::most_light_vertices(arrays, longest) : 0;
    fast::Buffer<fast::Rgb> own(memory, samples);
    fast::Buffer<fast::ExactSum> splats(memory, std::size_t{3} * pixels);
    fast::Buffer<fast::DroppedCount> dropped(memory, 1);
    fast::Buffer<fast::LightVertex> kept(memory, static_cast<std::size_t>(capacity) * samples);
    fast::Buffer<std::uint32_t> queues(memory, fast::queue_words(executor, integrator, samples));
    serial(static_cast<std::uint32_t>(splats.size()), fast::Clear<fast::ExactSum>{splats.all()});
    serial(1, fast::Clear<fast::DroppedCount>{dropped.all()});
    const fast::FilmTarget film{own.all(), {{}, splats.all()}, {}, dropped.all(), false, pixels};
    for (const fast::Launch& launch : launches)
        fast::launch_samples<integrator>(executor, arrays.needs, in_memory,
                                         fast::SampleJob{{7, longest, images::Heuristic::balance},
                                                         launch,
                                                         film,
                                                         kept.all(),
                                                         capacity,
                                                         queues.all()});
    Film result{own.read(own.size()), {}, dropped.read(1)[0].count};
    for (const fast::ExactSum& sum : splats.read(splats.size())) {
        result.splats.insert(result.splats.end(), std::begin(sum.words), std::end(sum.words));
        result.splats.push_back(sum.lost);
    }
    return result;
}

/// By the kernel for whole samples.
template <Integrator integrator>
Film whole_film(const scenes::Scene& scene)
{
    fast::HostMemory memory;
    fast::SerialExecutor on_host;
    AnyExecutor serial(on_host);
    return film_of<integrator>(scene, memory, serial, serial);
}

/// In stages whose kernels run on `executor`, in memory that only they can access.
template <Integrator integrator, class E>
Film staged_film(const scenes::Scene& scene, E& executor, const AnyExecutor::Watch& watch = {})
{
    parallel_test::FarMemory memory(std::size_t{1} << 28);
    fast::SerialExecutor on_host;
    parallel_test::FarExecutor serial_in_far(memory, on_host);
    parallel_test::FarExecutor in_far(memory, executor);
    AnyExecutor serial(serial_in_far);
    AnyExecutor any(in_far);
    any.watch = watch;
    fast::StagedExecutor staged(memory, any);
    return film_of<integrator>(scene, memory, serial, staged);
}

template <Integrator integrator>
void expect_whole_samples(const scenes::Scene& scene)
{
    const Film expected = whole_film<integrator>(scene);
    fast::SerialExecutor serial;
    EXPECT_EQ(staged_film<integrator>(scene, serial), expected) << "serial";
    for (const std::uint32_t threads : {2u, 4u}) {
        fast::ThreadedExecutor threaded(threads, 1);
        EXPECT_EQ(staged_film<integrator>(scene, threaded), expected) << threads << " threads";
    }
    for (std::uint64_t seed = 0; seed < 2; ++seed) {
        std::mt19937_64 schedule(seed);
        parallel_test::InterleavedExecutor interleaved(
            6, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(schedule() % ready); });
        EXPECT_EQ(staged_film<integrator>(scene, interleaved), expected) << "schedule " << seed;
    }
}

class StageLaunches : public testing::TestWithParam<std::string> {};

TEST_P(StageLaunches, HaveTheBitsOfWholeSamples)
{
    const scenes::Scene scene = our_scene(GetParam());
    expect_whole_samples<Integrator::path>(scene);
    expect_whole_samples<Integrator::bdpt>(scene);
    expect_whole_samples<Integrator::light>(scene);
}

INSTANTIATE_TEST_SUITE_P(Scenes, StageLaunches, testing::ValuesIn(transport_test::our_scene_names()),
                         [](const auto& tested) { return tested.param; });

/// The launches of one film, by the name of their stage. `idle`: those without an index.
struct Launches {
    std::map<std::string, int> of_stages;
    int idle = 0;
};

template <Integrator integrator>
Launches launches_of(const scenes::Scene& scene)
{
    Launches found;
    fast::SerialExecutor serial;
    staged_film<integrator>(scene, serial, [&](const std::type_info& kernel, std::uint32_t count) {
        const std::string name = parallel_test::kernel_name(kernel);
        if (name == "Clear") return;
        ++found.of_stages[name];
        if (count == 0) ++found.idle;
    });
    return found;
}

template <Integrator integrator>
std::set<std::string> stages_of(const scenes::Scene& scene)
{
    std::set<std::string> names;
    for (const auto& [name, count] : launches_of<integrator>(scene).of_stages) names.insert(name);
    return names;
}

using Names = std::set<std::string>;

// The queue of a stage that a scene does not require stays empty. Such a stage is never launched.
TEST_P(StageLaunches, HaveIndices)
{
    const scenes::Scene scene = our_scene(GetParam());
    EXPECT_EQ(launches_of<Integrator::path>(scene).idle, 0);
    EXPECT_EQ(launches_of<Integrator::bdpt>(scene).idle, 0);
    EXPECT_EQ(launches_of<Integrator::light>(scene).idle, 0);
}

TEST(StageLaunches, AreThoseThatASceneRequires)
{
    const scenes::Scene lit = our_scene("cornell_diffuse");
    EXPECT_EQ(stages_of<Integrator::path>(lit), (Names{"Generate", "Extend", "Shade", "TestShadow"}));
    EXPECT_EQ(stages_of<Integrator::light>(lit),
              (Names{"GenerateLight", "Extend", "ShadeLight", "TestSplat"}));
    EXPECT_EQ(stages_of<Integrator::bdpt>(lit),
              (Names{"GenerateLight", "ShadeLight", "TestSplat", "GenerateEye", "Extend", "ShadeEye",
                     "TestShadow", "Connect"}));

    scenes::Scene dark = our_scene("point_over_plane");
    dark.point_lights.clear();
    EXPECT_EQ(stages_of<Integrator::path>(dark), (Names{"Generate", "Extend", "Shade"}));
    EXPECT_EQ(stages_of<Integrator::light>(dark), Names{});
    EXPECT_EQ(stages_of<Integrator::bdpt>(dark), (Names{"GenerateEye", "Extend", "ShadeEye"}));

    // Mirrors and glass cannot be joined.
    scenes::Scene mirrors = lit;
    for (scenes::Material& material : mirrors.materials)
        if (std::holds_alternative<scenes::Lambertian>(material))
            material = scenes::Mirror{scenes::Rgb(0.9)};
    EXPECT_EQ(stages_of<Integrator::path>(mirrors), (Names{"Generate", "Extend", "Shade"}));
    EXPECT_EQ(stages_of<Integrator::bdpt>(mirrors),
              (Names{"GenerateLight", "ShadeLight", "TestSplat", "GenerateEye", "Extend", "ShadeEye"}));
}

// The last vertex has no bounce, and is not joined.
TEST(StageLaunches, EndWithTheLongestPath)
{
    const Launches found = launches_of<Integrator::path>(our_scene("cornell_diffuse"));
    EXPECT_EQ(found.of_stages.at("Extend"), found.of_stages.at("Shade"));
    EXPECT_EQ(found.of_stages.at("Extend"), 2 * longest); // closed: some path reaches the limit
    EXPECT_EQ(found.of_stages.at("TestShadow"), 2 * (longest - 1)); // the last vertex is not joined
}

images::RenderOptions options_for(Integrator integrator)
{
    images::RenderOptions options;
    options.integrator = integrator;
    options.max_edges = 9;
    options.seed = 3;
    options.deterministic = true;
    return options;
}

// A launch takes as many samples as the limit on memory allows, queues included: a million would need
// more than there is.
TEST(StageLaunches, KeepToTheLimitOnMemory)
{
    const scenes::Scene scene = our_scene("cornell_glass");
    for (const Integrator integrator : {Integrator::path, Integrator::bdpt, Integrator::light}) {
        const images::RenderOptions options = options_for(integrator);
        parallel_test::FarMemory memory(std::size_t{1} << 24);
        fast::SerialExecutor on_host;
        parallel_test::FarExecutor in_far(memory, on_host);
        AnyExecutor any(in_far);
        fast::StagedExecutor staged(memory, any);
        fast::BatchRenderer renderer(memory, staged, {1u << 20, 1u << 20, std::size_t{1} << 22}, scene,
                                     40, 30, options, {});
        EXPECT_EQ(renderer.render_batch(0, {})->mean,
                  fast::host_renderer(scene, 40, 30, options, 1)->render_batch(0, {})->mean);
    }
}

class StagesOnDevice : public parallel_test::OnDevice {};

TEST_F(StagesOnDevice, HaveTheBitsOfWholeSamples)
{
    for (const std::string& name : transport_test::our_scene_names()) {
        const scenes::Scene scene = our_scene(name);
        for (const Integrator integrator : {Integrator::path, Integrator::bdpt, Integrator::light}) {
            const auto batch_by = [&](fast::DeviceKernels kernels) {
                return *fast::device_renderer(scene, 120, 80, options_for(integrator),
                                              {.kernels = kernels})
                            ->render_batch(1, {});
            };
            const images::Batch whole = batch_by(fast::DeviceKernels::samples);
            const images::Batch staged = batch_by(fast::DeviceKernels::stages);
            EXPECT_EQ(staged.mean, whole.mean)
                << name << ", integrator " << static_cast<int>(integrator);
            EXPECT_EQ(staged.dropped.count, whole.dropped.count) << name;
        }
    }
}

} // namespace
