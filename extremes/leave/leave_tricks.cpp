// The usual tricks by which renderers leave surfaces, in both formats. Coordinates are used as they
// stand in the file, rounded to the format, and positions are origin + t direction. The tests of
// primitives are those of our two implementations, so what differs is the trick.

#include "extremes/leave/for_each_ray.h"
#include "extremes/leave/moved_by_ulps.h"
#include "extremes/leave/rounded_scene.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace extremes {

namespace {

enum class Trick { fixed, relative, ulps, exclude, determinant };

/// The unit normal at `position` on the side of `onward`.
template <class F>
auto facing_normal(const RoundedScene<F>& scene, std::size_t triangles, std::uint32_t primitive,
                   const typename RoundedScene<F>::Vec3& position,
                   const typename RoundedScene<F>::Vec3& onward)
{
    using Vec3 = typename RoundedScene<F>::Vec3;
    Vec3 normal;
    if (primitive < triangles) {
        const Vec3 v0 = scene.corner(primitive, 0);
        normal = glm::cross(scene.corner(primitive, 1) - v0, scene.corner(primitive, 2) - v0);
    } else {
        normal = position - scene.center(primitive - static_cast<std::uint32_t>(triangles));
    }
    normal = glm::normalize(normal);
    return glm::dot(normal, onward) < 0 ? -normal : normal;
}

template <class F>
FoundOnward found_by_trick(const RoundedScene<F>& scene, std::size_t triangles, const LeaveRay& ray,
                           Trick trick, F epsilon)
{
    using Vec3 = typename RoundedScene<F>::Vec3;
    FoundOnward found;
    const Vec3 origin(ray.origin);
    const Vec3 direction = glm::normalize(Vec3(ray.direction));
    Left<F> left;
    if (trick == Trick::determinant) left.least_determinant = epsilon;
    const auto first = scene.intersect(origin, direction, left);
    if (!first) return found;
    found.first = first->primitive;
    const Vec3 onward(ray.onward);
    const F length = glm::length(onward);
    Vec3 start = origin + first->t * direction;
    F moved = 0; // along the ray, in multiples of onward
    if (trick == Trick::fixed) moved = epsilon / length;
    if (trick == Trick::relative) moved = epsilon * first->t / length;
    start += moved * onward;
    if (trick == Trick::ulps)
        start =
            point_moved_by_ulps(start, facing_normal(scene, triangles, first->primitive, start, onward));
    if (trick == Trick::exclude || trick == Trick::determinant) left.primitive = first->primitive;
    const auto next = scene.intersect(start, onward, left);
    if (!next) return found;
    found.second = next->primitive;
    const F distance = next->t + moved;
    found.finite = std::isfinite(distance);
    if (found.finite) found.distance = Exact(distance);
    return found;
}

template <class F>
Method trick_method(const std::string& name, MakeLeaveCase make, Trick trick, double epsilon = 0)
{
    constexpr bool is_double = std::is_same_v<F, double>;
    return {(is_double ? "double, " : "float, ") + name, is_double ? Format::binary64 : Format::binary32,
            [=](double parameter, Random& random, int cases, Tally& tally) {
                for_each_leave_ray(
                    make, parameter, random, cases, tally, [&](const LeaveCase& from, Tally& /*t*/) {
                        const RoundedScene<F> scene(from.scene);
                        std::vector<FoundOnward> all;
                        for (const LeaveRay& ray : from.rays)
                            all.push_back(found_by_trick<F>(scene, from.scene.triangles.size(), ray,
                                                            trick, static_cast<F>(epsilon)));
                        return all;
                    });
            }};
}

template <class F>
void add_tricks(std::vector<Method>& methods, MakeLeaveCase make, bool triangles)
{
    methods.push_back(trick_method<F>("fixed 1e-3", make, Trick::fixed, 1e-3));
    methods.push_back(trick_method<F>("fixed 1e-4", make, Trick::fixed, 1e-4));
    methods.push_back(trick_method<F>("fixed 1e-6", make, Trick::fixed, 1e-6));
    methods.push_back(trick_method<F>("relative 1e-3", make, Trick::relative, 1e-3));
    methods.push_back(trick_method<F>("ulps", make, Trick::ulps));
    methods.push_back(trick_method<F>("exclude", make, Trick::exclude));
    if (triangles)
        methods.push_back(trick_method<F>("determinant 1e-6", make, Trick::determinant, 1e-6));
}

} // namespace

std::vector<Method> leave_tricks(MakeLeaveCase make, bool triangles)
{
    std::vector<Method> methods;
    add_tricks<float>(methods, make, triangles);
    add_tricks<double>(methods, make, triangles);
    return methods;
}

} // namespace extremes
