#include "extremes/spheres/sphere_rays.h"
#include "extremes/grey_scene.h"
#include "extremes/hits_of_pairs.h"

#include "cuda/parallel/executor.h"
#include "cuda/scene/scene_in_memory.h"
#include "ref/trees/geometry.h"
#include "scenes/contacts.h"
#include "scenes/placed.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace extremes {

namespace {

struct Met {
    std::uint32_t primitive;
    scenes::Vec3 position;
};
using BothMet = std::array<std::optional<Met>, 2>;

BothMet both_met_by_reference(const scenes::Scene& scene, const scenes::Vec3& first,
                              const scenes::Vec3& onward)
{
    const ref::Geometry geometry(scene, ref::Builder::sah_leaf, scenes::coincidences(scene));
    const std::vector<std::uint32_t> on = scenes::surfaces_at(scene, scene.camera->eye);
    const ref::Ray ray{scene.camera->eye, first, std::numeric_limits<double>::infinity(), on};
    const auto hit = ref::intersect(geometry, ray);
    if (!hit) return {};
    const ref::SurfacePoint point = ref::surface_point(geometry, ray, *hit);
    const ref::Ray next{ref::leave_surface(point, onward), onward};
    const auto next_hit = ref::intersect(geometry, next);
    BothMet met{Met{hit->primitive, point.position}, std::nullopt};
    if (next_hit)
        met[1] = Met{next_hit->primitive, ref::surface_point(geometry, next, *next_hit).position};
    return met;
}

/// By Wing::host or Wing::cuda. Positions are computed from the hits on the host.
BothMet both_met_by_fast_path(Wing wing, const scenes::Scene& scene, const scenes::Vec3& first,
                              const scenes::Vec3& onward)
{
    const fast::SceneArrays arrays = fast::scene_arrays(scene, false);
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    const fast::SceneInMemory in_memory(memory, executor, arrays, fast::Camera{});
    const auto view = in_memory.view<fast::any_needs>();
    const auto position = [&](const fast::Ray& ray, const fast::Hit& hit) {
        const fast::Vec3 here = fast::surface_point<fast::any_needs, float>(view, ray, hit).position;
        return arrays.place.origin + scenes::Vec3(here) / arrays.place.scale;
    };
    const fast::RayPair pair{
        {arrays.place(scene.camera->eye), std::numeric_limits<float>::infinity(), fast::Vec3(first)},
        fast::Vec3(onward)};
    const fast::PairOfHits hits = hits_of_pairs(wing, arrays, std::span(&pair, 1)).front();
    BothMet met{};
    if (hits.first.primitive == fast::no_primitive) return met;
    met[0] = Met{hits.first.primitive, position(pair.first, hits.first)};
    if (hits.second.primitive == fast::no_primitive) return met;
    const auto point = fast::surface_point<fast::any_needs, float>(view, pair.first, hits.first);
    const fast::Ray next{fast::leave_surface(point, pair.onward), std::numeric_limits<float>::infinity(),
                         pair.onward};
    met[1] = Met{hits.second.primitive, position(next, hits.second)};
    return met;
}

std::optional<Failure> failure_of_two_rays(const TwoRays& rays, const BothMet& met)
{
    if (!met[0]) return Failure::missed;
    if (met[0]->primitive != rays.first) return Failure::wrong_order;
    if (!met[1]) {
        if (!rays.second) return std::nullopt;
        return rays.inward ? Failure::leaked : Failure::missed;
    }
    if (rays.second && met[1]->primitive == *rays.second) return std::nullopt;
    if (met[1]->primitive == rays.first) return Failure::self_hit;
    return rays.inward ? Failure::leaked : Failure::wrong_order;
}

auto cases_of_two_rays(Wing wing, const TwoRaysDraw& draw)
{
    return [wing, draw](double parameter, Random& random, int cases, Tally& tally) {
        for (int i = 0; i < cases; ++i) {
            const TwoRays rays = draw(parameter, random);
            const scenes::Vec3 first =
                rounded_unit(rays.first_point - ExactVec3(rays.scene.camera->eye));
            const scenes::Scene scene = scenes::placed(rays.scene);
            const double unit = scene.unit / rays.scene.unit;
            const BothMet met = wing == Wing::ref
                                    ? both_met_by_reference(scene, first, rays.onward)
                                    : both_met_by_fast_path(wing, scene, first, rays.onward);
            if (const auto failure = failure_of_two_rays(rays, met)) {
                tally.add(*failure);
                continue;
            }
            const auto error = [&](const Met& at, const ExactVec3& point, double relative_to) {
                return length(ExactVec3(at.position / unit) - point).to_double() / relative_to;
            };
            double largest = error(*met[0], rays.first_point, rays.first_length);
            if (rays.second)
                largest = std::max(largest, error(*met[1], rays.second_point, rays.second_length));
            tally.add(largest);
        }
    };
}

} // namespace

std::vector<Method> methods_of_two_rays(const TwoRaysDraw& draw)
{
    std::vector<Method> methods;
    for (const Wing wing : wings())
        methods.push_back({name_of(wing), format_of(wing), cases_of_two_rays(wing, draw)});
    return methods;
}

ExactVec3 point_of_sphere(const scenes::Sphere& sphere, const ExactVec3& towards)
{
    return ExactVec3(sphere.center) + (Exact(sphere.radius) / length(towards)) * towards;
}

scenes::Vec3 direction_near(const scenes::Vec3& axis, double largest_sine, Random& random)
{
    const scenes::Vec3 x = glm::normalize(glm::cross(axis, random.direction()));
    const double sine = largest_sine * std::sqrt(random.uniform());
    const double phi = random.between(0, 2 * std::numbers::pi);
    return std::sqrt(1 - sine * sine) * axis +
           sine * (std::cos(phi) * x + std::sin(phi) * glm::cross(axis, x));
}

scenes::Scene scene_of_spheres(std::vector<scenes::Sphere> spheres, const scenes::Vec3& eye)
{
    scenes::Scene scene = grey_scene();
    scene.spheres = std::move(spheres);
    scene.camera = scenes::Camera{eye, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, scenes::FovAxis::horizontal, 1};
    return scene;
}

} // namespace extremes
