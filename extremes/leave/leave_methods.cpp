// How our own two implementations leave surfaces, as they are used in renders.

#include "extremes/hits_of_pairs.h"
#include "extremes/leave/for_each_ray.h"

#include "cuda/scene/float_notices.h"
#include "cuda/scene/scene_arrays.h"
#include "ref/trees/geometry.h"
#include "scenes/placed.h"
#include "scenes/read_scene.h"

#include <exception>
#include <stdexcept>

namespace extremes {

namespace {

/// `scene` as both renderers get it: placed near the origin, about one unit large, and with it the
/// origins of the rays, which are made point lights for this.
scenes::Scene placed_with_origins(const LeaveCase& from)
{
    scenes::Scene scene = from.scene;
    for (const LeaveRay& ray : from.rays) scene.point_lights.push_back({ray.origin, scenes::Rgb(0.0)});
    return scenes::placed(std::move(scene));
}

/// The number by which placing the scene multiplied lengths, a power of two. It may be beyond the range
/// of doubles.
Exact placed_unit(const LeaveCase& from, const scenes::Scene& placed)
{
    // The largest difference of two coordinates, before and after: both are exact.
    const auto extent = [](const scenes::Scene& scene) {
        Exact largest = 0;
        const auto add = [&](const scenes::Vec3& a, const scenes::Vec3& b) {
            for (int axis = 0; axis < 3; ++axis) {
                const Exact d = abs(Exact(a[axis]) - Exact(b[axis]));
                if (d > largest) largest = d;
            }
        };
        for (const scenes::Triangle& t : scene.triangles) {
            add(t.vertices[0], t.vertices[1]);
            add(t.vertices[0], t.vertices[2]);
        }
        for (const scenes::Sphere& s : scene.spheres) add(scenes::Vec3(s.radius), scenes::Vec3(0.0));
        return largest;
    };
    return extent(placed) / extent(from.scene);
}

void run_ref(MakeLeaveCase make, double parameter, Random& random, int cases, Tally& tally)
{
    for_each_leave_ray(make, parameter, random, cases, tally, [](const LeaveCase& from, Tally& /*t*/) {
        const scenes::Scene scene = placed_with_origins(from);
        const Exact unit = placed_unit(from, scene);
        const ref::Geometry geometry(scene, ref::Builder::sah_leaf, scenes::coincidences(scene));
        std::vector<FoundOnward> all;
        for (std::size_t i = 0; i < from.rays.size(); ++i) {
            const LeaveRay& ray = from.rays[i];
            FoundOnward found;
            const ref::Ray first{scene.point_lights[i].position, ray.direction};
            if (const auto hit = intersect(geometry, first)) {
                found.first = hit->primitive;
                const ref::SurfacePoint point = surface_point(geometry, first, *hit);
                if (const auto next =
                        intersect(geometry, {leave_surface(point, ray.onward), ray.onward})) {
                    found.second = next->primitive;
                    found.finite = std::isfinite(next->t);
                    if (found.finite) found.distance = Exact(next->t) / unit;
                }
            }
            all.push_back(found);
        }
        return all;
    });
}

void run_fast(Wing wing, MakeLeaveCase make, double parameter, Random& random, int cases, Tally& tally)
{
    for_each_leave_ray(make, parameter, random, cases, tally, [&](const LeaveCase& from, Tally& of) {
        const scenes::Scene scene = placed_with_origins(from);
        const Exact unit = placed_unit(from, scene);
        for (const std::string& notice : fast::float_notices(scene)) of.notice(notice);
        const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
        std::vector<fast::RayPair> pairs;
        for (std::size_t i = 0; i < from.rays.size(); ++i)
            pairs.push_back(
                {{arrays.place(scene.point_lights[i].position), std::numeric_limits<float>::infinity(),
                  fast::Vec3(from.rays[i].direction)},
                 fast::Vec3(from.rays[i].onward)});
        std::vector<FoundOnward> all;
        for (const auto& [first, second] : hits_of_pairs(wing, arrays, pairs)) {
            FoundOnward found;
            if (first.primitive != fast::no_primitive) found.first = first.primitive;
            if (second.primitive != fast::no_primitive) {
                found.second = second.primitive;
                found.finite = std::isfinite(second.t);
                if (found.finite) found.distance = Exact(second.t) / (unit * Exact(arrays.place.scale));
            }
            all.push_back(found);
        }
        return all;
    });
}

} // namespace

std::vector<Method> leave_methods(MakeLeaveCase make, bool tricks)
{
    std::vector<Method> methods;
    for (const Wing wing : wings())
        methods.push_back({name_of(wing), format_of(wing),
                           [wing, make](double parameter, Random& random, int cases, Tally& tally) {
                               if (wing == Wing::ref)
                                   run_ref(make, parameter, random, cases, tally);
                               else
                                   run_fast(wing, make, parameter, random, cases, tally);
                           }});
    if (tricks)
        for (Method& trick : leave_tricks(make)) methods.push_back(std::move(trick));
    return methods;
}

} // namespace extremes
