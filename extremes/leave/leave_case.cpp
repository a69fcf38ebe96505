#include "extremes/leave/leave_case.h"

#include "scenes/largest_component.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace extremes {

namespace {

/// Whether it is certain in doubles that a line along `d` passes outside a triangle with the corners a,
/// b, c relative to a point of the line: two signed volumes differ in sign, and each is far larger than
/// its error, which is less than 20 roundings. Saves most of the exact arithmetic.
bool certainly_outside(scenes::Vec3 a, scenes::Vec3 b, scenes::Vec3 c, const scenes::Vec3& d)
{
    const double largest = std::max(
        {scenes::largest_component(a), scenes::largest_component(b), scenes::largest_component(c)});
    if (!(largest > 0.0) || !std::isfinite(largest)) return false;
    for (scenes::Vec3* v : {&a, &b, &c}) *v /= largest; // any unit of length
    const auto sign = [&](const scenes::Vec3& p, const scenes::Vec3& q) {
        const double volume = glm::dot(d, glm::cross(p, q));
        const double error = 1e-13 * glm::length(d) * glm::length(p) * glm::length(q);
        if (!(error > 1e-100)) return 0; // nothing can be told, or it underflowed
        return volume > error ? 1 : volume < -error ? -1 : 0;
    };
    const int u = sign(b, c);
    const int v = sign(c, a);
    if (u * v < 0) return true;
    const int w = sign(a, b);
    return u * w < 0 || v * w < 0;
}

/// The t at which the line from `origin` along `direction` crosses the plane of the triangle; none if it
/// passes outside the triangle or parallel to it.
std::optional<Exact> triangle_crossing(const scenes::Triangle& triangle, const ExactVec3& origin,
                                       const ExactVec3& direction)
{
    const ExactVec3 a = ExactVec3(triangle.vertices[0]) - origin;
    const ExactVec3 b = ExactVec3(triangle.vertices[1]) - origin;
    const ExactVec3 c = ExactVec3(triangle.vertices[2]) - origin;
    if (certainly_outside(in_doubles(a), in_doubles(b), in_doubles(c), in_doubles(direction)))
        return std::nullopt;
    // Signed volumes of the line with each edge: of one sign where it passes inside.
    const ExactVec3 bc = cross(b, c);
    const Exact u = dot(direction, bc);
    const Exact v = dot(direction, cross(c, a));
    if ((u < 0 && v > 0) || (u > 0 && v < 0)) return std::nullopt;
    const Exact w = dot(direction, cross(a, b));
    if ((u < 0 && w > 0) || (u > 0 && w < 0) || (v < 0 && w > 0) || (v > 0 && w < 0))
        return std::nullopt;
    const Exact sum = u + v + w; // the volume of the parallelepiped of the normal and the direction
    if (sum == 0) return std::nullopt;
    return Exact(dot(a, bc) / sum);
}

/// Calls found(t) for the points at which a line crosses a primitive.
template <class Found>
void for_each_crossing(const scenes::Scene& scene, std::uint32_t primitive, const ExactVec3& origin,
                       const ExactVec3& direction, const Found& found)
{
    if (primitive < scene.triangles.size()) {
        if (const auto t = triangle_crossing(scene.triangles[primitive], origin, direction)) found(*t);
        return;
    }
    const scenes::Sphere& sphere = scene.spheres[primitive - scene.triangles.size()];
    const ExactVec3 f = origin - ExactVec3(sphere.center);
    const Exact a = dot(direction, direction);
    const Exact b = dot(f, direction);
    const Exact discriminant = b * b - a * (dot(f, f) - Exact(sphere.radius) * Exact(sphere.radius));
    if (discriminant < 0) return;
    const Exact root = sqrt(discriminant);
    found(Exact((-b - root) / a));
    found(Exact((-b + root) / a));
}

} // namespace

std::optional<Onward> exact_onward(const scenes::Scene& scene, const LeaveRay& ray)
{
    const ExactVec3 origin(ray.origin);
    const ExactVec3 direction(ray.direction);
    std::optional<Onward> first;
    for (std::uint32_t i = 0; i < primitive_count(scene); ++i)
        for_each_crossing(scene, i, origin, direction, [&](const Exact& t) {
            if (t > 0 && (!first || t < first->distance)) first = Onward{i, t};
        });
    if (!first || first->primitive != ray.start) return std::nullopt;
    const ExactVec3 point = origin + first->distance * direction;
    const ExactVec3 onward(ray.onward);
    // The start itself is crossed at 0, up to the rounding of 60 digits, and a sphere once more.
    Exact largest = 0;
    std::optional<Exact> far;
    for_each_crossing(scene, ray.start, point, onward, [&](const Exact& t) {
        if (abs(t) < largest) return;
        largest = abs(t);
        far = t;
    });
    std::optional<Onward> next;
    if (ray.start >= scene.triangles.size() && far && *far > 0) next = Onward{ray.start, *far};
    for (std::uint32_t i = 0; i < primitive_count(scene); ++i)
        if (i != ray.start)
            for_each_crossing(scene, i, point, onward, [&](const Exact& t) {
                if (t > 0 && (!next || t < next->distance)) next = Onward{i, t};
            });
    return next;
}

const std::vector<AnsweredCase>& answered_cases(MakeLeaveCase make, double parameter, Random& random,
                                                int cases)
{
    constexpr int rays_of_scene = 25;
    struct Last {
        MakeLeaveCase make = nullptr;
        double parameter = 0;
        int cases = 0;
        Random before{0}, after{0};
        std::vector<AnsweredCase> answered;
    };
    thread_local Last last;
    if (last.make == make && last.parameter == parameter && last.cases == cases &&
        last.before == random) {
        random = last.after;
        return last.answered;
    }
    Last now{make, parameter, cases, random, random, {}};
    for (int done = 0; done < cases; done += rays_of_scene) {
        AnsweredCase answered{make(parameter, random, std::min(rays_of_scene, cases - done)), {}};
        for (const LeaveRay& ray : answered.from.rays)
            answered.truths.push_back(exact_onward(answered.from.scene, ray));
        now.answered.push_back(std::move(answered));
    }
    now.after = random;
    last = std::move(now);
    return last.answered;
}

void judge_onward(const LeaveCase& from, const LeaveRay& ray, const Onward& truth,
                  const FoundOnward& found, Tally& tally)
{
    if (found.first != ray.start) {
        tally.add(Failure::missed);
        return;
    }
    if (!found.second) {
        tally.add(Failure::leaked);
        return;
    }
    if (!found.finite) {
        tally.add(Failure::not_finite);
        return;
    }
    const Exact difference = (found.distance - truth.distance) * Exact(glm::length(ray.onward));
    if (*found.second == truth.primitive)
        tally.add((abs(difference) / Exact(from.size)).to_double());
    else if (*found.second == ray.start)
        tally.add(Failure::self_hit);
    else
        tally.add(difference > 0 ? Failure::leaked : Failure::wrong_order);
}

} // namespace extremes
