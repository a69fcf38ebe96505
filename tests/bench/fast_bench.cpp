// Times of building and tracing the trees of the fast path on the host, in single precision, compared
// with Embree.
//
//   bench_fast [--benchmark_...]
//
// Builds start from boxes, and use memory that an earlier build has used; "hploc" sorts as morton63, and
// then clusters instead of building a radix tree and refitting it; "hploc-wide" also makes the wide
// tree, in new memory: what rays need. With more than one thread the elapsed time is measured, otherwise
// the CPU time. SAH costs: C_trav = C_isect = 1. For rays also: nodes and leaves (groups of a wide tree)
// per ray, and nodes if no hit stopped the traversal; and the nodes and groups of a wide tree.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/trees/hploc.h"
#include "cuda/trees/lbvh.h"
#include "cuda/trees/sah_cost.h"
#include "cuda/trees/scene_geometry.h"
#include "cuda/trees/surfaces.h"
#include "tests/bench/bumpy_sphere.h"
#include "tests/bench/embree.h"
#include "tests/cuda/trees/binary_tree.h"

#include <benchmark/benchmark.h>

#include <memory>

namespace {

using fast::Vec3;

enum class Built { radix, clustered, wide };

template <class Code>
void build(benchmark::State& state, const scenes::Scene& scene, unsigned threads, Built built)
{
    const bool cluster = built != Built::radix;
    const auto n = static_cast<std::uint32_t>(scene.triangles.size());
    fast::HostMemory memory;
    const fast::Buffer<fast::Triangle> triangles(memory, fast::triangles_of(scene));
    const fast::Buffer<fast::Aabb> boxes(memory, fast::boxes_of(scene));
    fast::ThreadedExecutor executor(threads);
    fast::Lbvh<Code> tree(memory, executor, cluster ? 0 : n);
    fast::MortonOrder<Code> order(memory, executor, cluster ? n : 0);
    fast::Hploc clustered(memory, cluster ? n : 0);
    const auto build_once = [&] {
        if (!cluster) return tree.build(executor, boxes.all());
        order.build(executor, boxes.all());
        clustered.build(executor, boxes.all(), order);
        if (built == Built::clustered) return;
        const fast::WideTree wide(memory, executor, clustered.nodes(), clustered.divisions(),
                                  order.primitives(), triangles.all());
        benchmark::DoNotOptimize(wide.levels());
    };
    build_once(); // touches the memory, which the system clears at the first access
    for (auto _ : state) build_once();
    state.counters["sah_cost"] =
        fast::sah_cost(cluster ? clustered.nodes() : std::as_const(tree).nodes());
    if (cluster) state.counters["height"] = clustered.height();
}

/// Rays from outside to points of the bounding box, and in random directions from the hits of these
/// rays.
struct Rays {
    std::vector<fast::Ray> camera;
    std::vector<fast::Ray> diffuse;
};

/// A scene with the trees of the fast path, ready for rays.
class Traceable {
public:
    explicit Traceable(const scenes::Scene& scene)
        : triangles_(fast::triangles_of(scene)), count_(static_cast<std::uint32_t>(triangles_.size())),
          tree_(memory_, fast::SerialExecutor{}, count_), clustered_(memory_, count_), ordered_(count_)
    {
        fast::SerialExecutor executor;
        const std::vector<fast::Aabb> boxes = fast::boxes_of(scene);
        tree_.build(executor, boxes);
        clustered_.build(executor, boxes, tree_.order());
        executor(count_, fast_trees_test::OrderTriangles{triangles_, tree_.primitives(), ordered_});
        const fast::Divisions divisions(memory_, executor, tree_.nodes(), tree_.leaf_links());
        for (const bool clustered : {false, true})
            wide_.emplace_back(memory_, executor, narrow(clustered).nodes,
                               clustered ? clustered_.divisions() : divisions.all(), tree_.primitives(),
                               triangles_);
    }
    [[nodiscard]] fast_trees_test::TreeView narrow(bool clustered) const
    {
        return {clustered ? clustered_.nodes() : tree_.nodes(), tree_.primitives(), ordered_};
    }
    [[nodiscard]] fast::Surfaces<false> wide(bool clustered) const
    {
        return {wide_[clustered ? 1 : 0].view(), {}, count_};
    }
    [[nodiscard]] Vec3 normal(std::uint32_t triangle) const
    {
        const auto& v = triangles_[triangle].vertices;
        return glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
    }

private:
    fast::HostMemory memory_;
    std::vector<fast::Triangle> triangles_;
    std::uint32_t count_;
    fast::Lbvh<std::uint64_t> tree_;
    fast::Hploc clustered_;
    std::vector<fast::WideTree> wide_;
    std::vector<fast::Triangle> ordered_;
};

Rays make_rays(const Traceable& scene)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    const auto in_cube = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
    const fast::Surfaces<false> tree = scene.wide(true);
    Rays rays;
    for (int i = 0; i < 100000; ++i) {
        const Vec3 eye(2.9f, 3.6f, 3.8f);
        rays.camera.push_back({eye, infinity, 1.1f * in_cube() - eye});
        const fast::Ray& ray = rays.camera.back();
        const fast::Hit hit = intersect(tree, ray);
        if (hit.primitive == fast::no_primitive) continue;
        Vec3 normal = scene.normal(hit.primitive);
        if (glm::dot(normal, ray.direction) > 0) normal = -normal;
        Vec3 in_ball = in_cube();
        while (glm::dot(in_ball, in_ball) > 1) in_ball = in_cube();
        // The normal plus a point of the unit sphere: cosine-distributed.
        rays.diffuse.push_back({ray.origin + hit.t * ray.direction + 1e-4f * normal, infinity,
                                normal + glm::normalize(in_ball)});
    }
    return rays;
}

/// The hits of a ray in a leaf of a narrow tree.
template <class Found>
void intersect(const fast_trees_test::TreeView& tree, std::uint32_t leaf, const fast::Ray& ray,
               const fast::ShearedRay& sheared, const Found& found)
{
    fast::Hit hit{0, tree.primitives[leaf], 0, 0};
    if (intersect_triangle(sheared, tree.triangles[leaf], ray.t_max, hit)) found(hit);
}

/// The same for groups of a wide tree.
template <class Found>
void intersect(const fast::Surfaces<false>& tree, std::uint32_t group, const fast::Ray& ray,
               const fast::ShearedRay& sheared, const Found& found)
{
    intersect_group(tree, group, ray, sheared, found);
}

const fast_trees_test::TreeView& nodes_of(const fast_trees_test::TreeView& tree)
{
    return tree;
}

const fast::WideTreeView& nodes_of(const fast::Surfaces<false>& tree)
{
    return tree.tree;
}

void count_parts(benchmark::State& /*state*/, const fast_trees_test::TreeView& /*tree*/) {}

/// The size of a wide tree.
void count_parts(benchmark::State& state, const fast::Surfaces<false>& tree)
{
    state.counters["wide_nodes"] = static_cast<double>(tree.tree.nodes.size());
    state.counters["groups"] = static_cast<double>(tree.tree.groups.size());
}

/// Nodes and leaves (or groups) that a ray visits on average, and the nodes if no hit stops the
/// traversal.
template <class View>
void count_visits(benchmark::State& state, const View& tree, const std::vector<fast::Ray>& rays)
{
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
    std::uint64_t unstopped = 0;
    for (const fast::Ray& ray : rays) {
        const fast::ShearedRay sheared(ray);
        fast::Hit best{ray.t_max, fast::no_primitive, 0, 0};
        const auto test = [&](std::uint32_t leaf) {
            ++leaves;
            intersect(tree, leaf, ray, sheared, [&](const fast::Hit& hit) {
                if (comes_before(hit, best)) best = hit;
            });
            return best.t;
        };
        traverse(nodes_of(tree), ray, test, [&] { ++nodes; });
        const auto pass = [&](std::uint32_t /*leaf*/) { return ray.t_max; };
        traverse(nodes_of(tree), ray, pass, [&] { ++unstopped; });
    }
    const auto per_ray = [&](std::uint64_t count) {
        return static_cast<double>(count) / static_cast<double>(rays.size());
    };
    state.counters["nodes"] = per_ray(nodes);
    state.counters["leaves"] = per_ray(leaves);
    state.counters["unstopped"] = per_ray(unstopped);
}

template <class View>
void trace(benchmark::State& state, const View& tree, const std::vector<fast::Ray>& rays)
{
    std::vector<fast::Hit> hits(rays.size());
    fast::SerialExecutor executor;
    for (auto _ : state)
        executor(static_cast<std::uint32_t>(rays.size()), fast::IntersectRays<View>{tree, rays, hits});
    const auto traced = static_cast<double>(state.iterations()) * static_cast<double>(rays.size());
    state.counters["rays"] = benchmark::Counter(traced, benchmark::Counter::kIsRate);
    count_visits(state, tree, rays);
    count_parts(state, tree);
}

std::vector<ref::Ray> in_double(const std::vector<fast::Ray>& rays)
{
    std::vector<ref::Ray> result;
    for (const fast::Ray& ray : rays)
        result.push_back({ref::Vec3(ray.origin), ref::Vec3(ray.direction)});
    return result;
}

template <class Function>
void add(const std::string& name, unsigned threads, Function function)
{
    auto* const entry = benchmark::RegisterBenchmark(name.c_str(), function);
    entry->Unit(benchmark::kMillisecond);
    if (threads > 1) entry->UseRealTime();
}

void add_builds(const std::shared_ptr<const scenes::Scene>& scene)
{
    for (const unsigned threads : {1u, 2u}) {
        const auto name = [&](const char* who) {
            return "build/" + scene->name + "/" + who + "/" + std::to_string(threads);
        };
        using benchmark::State;
        add(name("morton30"), threads,
            [=](State& state) { build<std::uint32_t>(state, *scene, threads, Built::radix); });
        add(name("morton63"), threads,
            [=](State& state) { build<std::uint64_t>(state, *scene, threads, Built::radix); });
        add(name("hploc"), threads,
            [=](State& state) { build<std::uint64_t>(state, *scene, threads, Built::clustered); });
        add(name("hploc-wide"), threads,
            [=](State& state) { build<std::uint64_t>(state, *scene, threads, Built::wide); });
        if constexpr (bench::have_embree)
            for (const bool medium : {false, true})
                add(name(medium ? "embree-medium" : "embree-low"), threads, [=](State& state) {
                    bench::embree_build(state, *scene, {medium, false, threads});
                });
    }
}

void add_traces(const std::shared_ptr<const scenes::Scene>& scene)
{
    const auto trees = std::make_shared<Traceable>(*scene);
    const Rays made = make_rays(*trees);
    for (const auto& [kind, rays] :
         {std::pair("camera", made.camera), std::pair("diffuse", made.diffuse)}) {
        const std::string name = std::string(kind) + "/" + scene->name + "/";
        using benchmark::State;
        for (const bool clustered : {false, true}) {
            const std::string who = clustered ? "hploc" : "morton63";
            add(name + who, 1,
                [=, rays = rays](State& state) { trace(state, trees->narrow(clustered), rays); });
            add(name + who + "-wide", 1,
                [=, rays = rays](State& state) { trace(state, trees->wide(clustered), rays); });
        }
        if constexpr (bench::have_embree)
            for (const bool robust : {false, true})
                for (const bool medium : {false, true})
                    add(name + (medium ? "embree-medium" : "embree-low") + (robust ? "-robust" : ""), 1,
                        [=, rays = in_double(rays)](State& state) {
                            bench::embree_trace(state, *scene, rays, {medium, robust, 1});
                        });
    }
}

} // namespace

int main(int argc, char** argv)
{
    benchmark::Initialize(&argc, argv);
    for (const auto& [name, triangles] :
         {std::pair("sphere-1e5", 1e5), std::pair("sphere-1e6", 1e6), std::pair("sphere-4e6", 4e6)}) {
        const auto scene = std::make_shared<const scenes::Scene>(bench::bumpy_sphere(name, triangles));
        add_builds(scene);
        if (triangles < 4e6) add_traces(scene);
    }
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
