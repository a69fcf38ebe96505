// Times of building and tracing trees: generated meshes, and any scene files named as arguments.
//
//   bench_trees [--benchmark_...] [SCENE.dae ...]
//   bench_trees --benchmark_format=json > trees.json
//
// One thread; times are CPU times. Counters: primitives, SAH cost, depth, boxes entered and primitives
// tested per ray. If Embree is installed, its fast builder is measured too, as a reference for the
// machine.

#include "cli/builders.h"
#include "ref/transport/random.h"
#include "ref/transport/sampling.h"
#include "ref/trees/geometry.h"
#include "ref/trees/quality.h"
#include "scenes/bounds.h"
#include "scenes/read_scene.h"
#include "tests/bench/build_steps.h"
#include "tests/bench/bumpy_sphere.h"
#include "tests/bench/embree.h"

#include <benchmark/benchmark.h>

#include <iostream>
#include <memory>
#include <random>

namespace {

using ref::Builder;
using ref::Vec3;

/// Rays from one point outside to points of the bounding box, and cosine-distributed rays from their
/// hits.
struct Rays {
    std::vector<ref::Ray> camera;
    std::vector<ref::Ray> diffuse;
};

Rays make_rays(const scenes::Scene& scene)
{
    Rays rays;
    const ref::Geometry geometry(scene, Builder::sah_leaf);
    const scenes::Bounds box = *scenes::bounds(scene);
    const Vec3 middle = 0.5 * (box.min + box.max);
    const Vec3 eye = middle + Vec3(0.48, 0.6, 0.64) * 1.5 * glm::length(box.max - box.min);
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const ref::Uniforms u = ref::uniforms({1, i, 0}, ref::Event::camera);
        const Vec3 target = box.min + Vec3(u[0], u[1], u[2]) * (box.max - box.min);
        const ref::Ray ray{eye, target - eye};
        rays.camera.push_back(ray);
        const auto hit = intersect(geometry, ray);
        if (!hit) continue;
        const ref::SurfacePoint point = surface_point(geometry, ray, *hit);
        const Vec3 normal = glm::dot(ray.direction, point.normal) < 0 ? point.normal : -point.normal;
        const ref::Uniforms v = ref::uniforms({1, i, 0}, ref::Event::eye_bounce);
        const Vec3 direction = ref::Frame(normal).to_world(ref::sample_cosine_hemisphere(v[0], v[1]));
        rays.diffuse.push_back({leave_surface(point, direction), direction});
    }
    return rays;
}

void build_tree(benchmark::State& state, const scenes::Scene& scene, Builder builder)
{
    const std::vector<ref::Aabb> boxes = ref::primitive_bounds(scene);
    ref::Tree tree;
    for (auto _ : state) {
        tree = ref::Tree{};
        tree = ref::build(boxes, builder);
    }
    const ref::Quality quality = ref::quality(tree);
    state.counters["primitives"] = static_cast<double>(boxes.size());
    state.counters["sah_cost"] = quality.sah_cost;
    state.counters["depth"] = quality.depth;
}

void trace_rays(benchmark::State& state, const scenes::Scene& scene, Builder builder,
                const std::vector<ref::Ray>& rays)
{
    const ref::Geometry geometry(scene, builder);
    ref::TraversalCounts counts;
    for (auto _ : state)
        for (const ref::Ray& ray : rays) benchmark::DoNotOptimize(intersect(geometry, ray, &counts));
    const auto traced = static_cast<double>(state.iterations()) * static_cast<double>(rays.size());
    state.counters["rays"] = benchmark::Counter(traced, benchmark::Counter::kIsRate);
    state.counters["nodes_per_ray"] = static_cast<double>(counts.nodes) / traced;
    state.counters["primitives_per_ray"] = static_cast<double>(counts.primitives) / traced;
}

void register_scene(const std::shared_ptr<const scenes::Scene>& scene)
{
    const auto rays = std::make_shared<const Rays>(make_rays(*scene));
    const auto add = [&](const std::string& what, const std::string& who, auto function) {
        benchmark::RegisterBenchmark((what + "/" + scene->name + "/" + who).c_str(), function)
            ->Unit(benchmark::kMillisecond);
    };
    for (const cli::NamedBuilder& named : cli::builders) {
        const Builder builder = named.builder;
        add("build", named.name, [=](benchmark::State& state) { build_tree(state, *scene, builder); });
        add("camera", named.name,
            [=](benchmark::State& state) { trace_rays(state, *scene, builder, rays->camera); });
        add("diffuse", named.name,
            [=](benchmark::State& state) { trace_rays(state, *scene, builder, rays->diffuse); });
    }
    const auto boxes = std::make_shared<const std::vector<ref::Aabb>>(ref::primitive_bounds(*scene));
    for (const bench::Step& step : bench::lbvh_steps(*boxes))
        add("morton30-step", step.name, [boxes, step](benchmark::State& state) {
            for (auto _ : state) step.run();
        });
    if constexpr (bench::have_embree) {
        add("build", "embree-low", [=](benchmark::State& state) { bench::embree_build(state, *scene); });
        add("camera", "embree-low",
            [=](benchmark::State& state) { bench::embree_trace(state, *scene, rays->camera); });
        add("diffuse", "embree-low",
            [=](benchmark::State& state) { bench::embree_trace(state, *scene, rays->diffuse); });
    }
}

} // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv); // removes its own options
    try {
        if (argc == 1)
            for (const auto& [name, triangles] :
                 {std::pair("sphere-1e5", 1e5), std::pair("sphere-1e6", 1e6)})
                register_scene(
                    std::make_shared<const scenes::Scene>(bench::bumpy_sphere(name, triangles)));
        for (int i = 1; i < argc; ++i)
            register_scene(std::make_shared<const scenes::Scene>(scenes::read_scene(argv[i])));
    } catch (const std::exception& error) {
        std::cerr << "bench_trees: " << error.what() << '\n';
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
