#include "extremes/far/met_points.h"

#include "extremes/hits_of_pairs.h"

#include "ref/trees/geometry.h"
#include "scenes/contacts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace extremes {

namespace {

/// `moved_near`: the origin of each ray is moved along it to the scene, in double, before it is rounded.
MetPoints met_by_floats(Wing wing, const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards,
                        bool moved_near)
{
    const fast::SceneArrays arrays = fast::scene_arrays(scene, false);
    const scenes::Vec3 eye = scene.camera->eye;
    const double distance = glm::length(eye - arrays.place.origin);
    std::vector<fast::RayPair> pairs;
    for (const scenes::Vec3& direction : towards) {
        const scenes::Vec3 from =
            moved_near ? eye + std::max(0.0, distance - 1 / arrays.place.scale) * direction : eye;
        const fast::Vec3 d(direction);
        pairs.push_back({{arrays.place(from), std::numeric_limits<float>::infinity(), d}, -d});
    }
    MetPoints met;
    const auto hits = hits_of_pairs(wing, arrays, pairs);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const fast::Hit& hit = hits[i].first;
        if (hit.primitive == fast::no_primitive) {
            met.emplace_back();
            continue;
        }
        fast::Vec3 position;
        if (hit.primitive < arrays.triangles.size()) {
            const auto& v = arrays.triangles[hit.primitive].vertices;
            position = v[0] + (hit.b1 * (v[1] - v[0]) + hit.b2 * (v[2] - v[0]));
        } else {
            const fast::Sphere& sphere = arrays.spheres[hit.primitive - arrays.triangles.size()];
            const fast::Ray& ray = pairs[i].first;
            position =
                sphere.center +
                sphere.radius * glm::normalize(ray.origin + hit.t * ray.direction - sphere.center);
        }
        met.emplace_back(arrays.place.origin + scenes::Vec3(position) / arrays.place.scale);
    }
    return met;
}

MetPoints met_by_reference(const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards)
{
    const ref::Geometry geometry(scene);
    const std::vector<std::uint32_t> on = scenes::surfaces_at(scene, scene.camera->eye);
    MetPoints met;
    for (const scenes::Vec3& direction : towards) {
        const ref::Ray ray{scene.camera->eye, direction, std::numeric_limits<double>::infinity(), on};
        const auto hit = ref::intersect(geometry, ray);
        met.push_back(hit ? std::optional(ref::surface_point(geometry, ray, *hit).position)
                          : std::nullopt);
    }
    return met;
}

} // namespace

MetPoints met_by(Wing wing, const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards)
{
    return wing == Wing::ref ? met_by_reference(scene, towards)
                             : met_by_floats(wing, scene, towards, false);
}

MetPoints met_from_nearby(const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards)
{
    return met_by_floats(Wing::host, scene, towards, true);
}

} // namespace extremes
