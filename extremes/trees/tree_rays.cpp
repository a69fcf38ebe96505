#include "extremes/trees/tree_rays.h"

#include "cuda/launch/device_lbvh.h"
#include "cuda/parallel/executor.h"
#include "cuda/trees/scene_geometry.h"
#include "cuda/trees/surfaces.h"
#include "ref/trees/geometry.h"
#include "ref/trees/intersect_primitive.h"

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace extremes {

namespace {

struct RandomRay {
    scenes::Vec3 origin, direction;
};

RandomRay random_ray(Random& random)
{
    const scenes::Vec3 through(random.uniform(), random.uniform(), random.uniform());
    const scenes::Vec3 direction = random.direction();
    return {through - random.between(0, 2) * direction, direction};
}

/// Whether the tree and the search agree on a ray.
using Agree = std::function<bool(const scenes::Vec3& origin, const scenes::Vec3& direction)>;

Agree agree_of_reference(ref::Builder builder, const scenes::Scene& scene)
{
    return [&scene, geometry = ref::Geometry(scene, builder)](const scenes::Vec3& origin,
                                                              const scenes::Vec3& direction) {
        const ref::Ray ray{origin, direction};
        const ref::ShearedRay sheared(ray);
        std::optional<ref::Hit> closest;
        for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
            const auto hit = ref::intersect_primitive(scene, ray, sheared, i);
            if (hit && (!closest || ref::comes_before(*hit, *closest))) closest = hit;
        }
        const auto found = ref::intersect(geometry, ray);
        return found.has_value() == closest.has_value() &&
               (!found || (found->primitive == closest->primitive && found->t == closest->t));
    };
}

/// A tree of the fast path and its memory.
struct FloatSurfaces {
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    std::vector<fast::Triangle> triangles;
    fast::SurfaceTree tree;

    FloatSurfaces(fast::TreeBuilder builder, const scenes::Scene& scene)
        : triangles(fast::triangles_of(scene)), tree(memory, executor, triangles, {}, builder)
    {}
};

/// The closest hit, without a tree.
fast::Hit searched(std::span<const fast::Triangle> triangles, const fast::Ray& ray)
{
    const fast::ShearedRay sheared(ray);
    fast::Hit closest{ray.t_max, fast::no_primitive, 0, 0};
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        fast::Hit hit{0, i, 0, 0};
        if (fast::intersect_triangle(sheared, triangles[i], ray.t_max, hit) &&
            fast::comes_before(hit, closest))
            closest = hit;
    }
    return closest;
}

Agree agree_of_fast_path(fast::TreeBuilder builder, const scenes::Scene& scene)
{
    return [surfaces = std::make_shared<const FloatSurfaces>(builder, scene)](
               const scenes::Vec3& origin, const scenes::Vec3& direction) {
        const fast::Ray ray{fast::Vec3(origin), std::numeric_limits<float>::infinity(),
                            fast::Vec3(direction)};
        const fast::Hit closest = searched(surfaces->triangles, ray);
        const fast::Hit found = fast::intersect(surfaces->tree.view<false>(), ray);
        return found.primitive == closest.primitive && found.t == closest.t;
    };
}

/// The rays that a GPU and a search on the host answer differently. The GPU builds its default tree.
int wrong_rays_of_device(const scenes::Scene& scene, int count, Random& random)
{
    std::vector<fast::Ray> rays;
    for (int i = 0; i < count; ++i) {
        const auto [origin, direction] = random_ray(random);
        rays.push_back(
            {fast::Vec3(origin), std::numeric_limits<float>::infinity(), fast::Vec3(direction)});
    }
    const std::vector<fast::Triangle> triangles = fast::triangles_of(scene);
    const std::vector<fast::Hit> hits = fast::intersect_on_device(triangles, {}, rays);
    int wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const fast::Hit closest = searched(triangles, rays[i]);
        if (hits[i].primitive != closest.primitive || hits[i].t != closest.t) ++wrong;
    }
    return wrong;
}

} // namespace

int wrong_rays(const AnyBuilder& builder, const scenes::Scene& scene, int count, Random& random)
{
    if (std::holds_alternative<DeviceBuilder>(builder))
        return wrong_rays_of_device(scene, count, random);
    const auto* reference = std::get_if<ref::Builder>(&builder);
    const Agree agree = reference != nullptr
                            ? agree_of_reference(*reference, scene)
                            : agree_of_fast_path(std::get<fast::TreeBuilder>(builder), scene);
    int wrong = 0;
    for (int i = 0; i < count; ++i) {
        const auto [origin, direction] = random_ray(random);
        if (!agree(origin, direction)) ++wrong;
    }
    return wrong;
}

} // namespace extremes
