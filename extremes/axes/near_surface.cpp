// An eye close above a surface.

#include "extremes/axes/axes.h"
#include "extremes/exact.h"
#include "extremes/far/met_points.h"
#include "extremes/grey_scene.h"
#include "extremes/leave/rounded_scene.h"

#include "scenes/placed.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <type_traits>
#include <utility>

namespace extremes {

namespace {

constexpr double least_cosine_from_near = 0.3; // between a ray and the normal

/// An eye over the middle of a triangle of diameter 1. Its ray goes down to the triangle, or up.
struct NearEye {
    scenes::Scene scene;
    scenes::Vec3 direction;
    bool down;
    ExactVec3 target; // if it goes down
};

NearEye near_eye(double height, Random& random)
{
    NearEye near;
    const scenes::Vec3 up = random.direction();
    const scenes::Vec3 x = glm::normalize(glm::cross(up, random.direction()));
    const scenes::Vec3 y = glm::cross(up, x);
    const scenes::Vec3 center = 0.1 * random.direction();
    const auto corner = [&](double degrees) {
        const double angle = degrees * std::numbers::pi / 180;
        return center + (std::cos(angle) * x + std::sin(angle) * y) / std::sqrt(3.0);
    };
    const std::array<scenes::Vec3, 3> v{corner(90), corner(210), corner(330)};
    near.scene = grey_scene();
    near.scene.triangles = {{v, 0}};

    const ExactVec3 e1 = ExactVec3(v[1]) - ExactVec3(v[0]);
    const ExactVec3 e2 = ExactVec3(v[2]) - ExactVec3(v[0]);
    const ExactVec3 across = cross(e1, e2);
    const ExactVec3 normal = (1 / length(across)) * across;
    const ExactVec3 below =
        ExactVec3(v[0]) + Exact(random.between(0.3, 0.36)) * e1 + Exact(random.between(0.3, 0.36)) * e2;
    const ExactVec3 eye = below + Exact(height) * normal;
    near.scene.camera = scenes::Camera{{eye.x.to_double(), eye.y.to_double(), eye.z.to_double()},
                                       {1, 0, 0},
                                       {0, 1, 0},
                                       {0, 0, 1},
                                       scenes::FovAxis::horizontal,
                                       1};
    const double cosine = random.between(least_cosine_from_near, 1.0);
    const double phi = random.between(0, 2 * std::numbers::pi);
    near.down = random.below(4) > 0;
    near.direction = (near.down ? -cosine : cosine) * up +
                     std::sqrt(1 - cosine * cosine) * (std::cos(phi) * x + std::sin(phi) * y);
    const ExactVec3 direction(near.direction);
    near.target = eye - (Exact(height) / dot(direction, normal)) * direction;
    return near;
}

/// What rays from the eye meet in the scene as it stands in the file, in the format F; hits nearer than
/// `epsilon` are ignored, as is usual for all rays.
template <class F>
MetPoints met_beyond(double epsilon, const scenes::Scene& scene,
                     const std::vector<scenes::Vec3>& towards)
{
    using Vec3 = typename RoundedScene<F>::Vec3;
    const RoundedScene<F> rounded(scene);
    const Vec3 eye(scene.camera->eye);
    MetPoints met;
    for (const scenes::Vec3& direction : towards) {
        const auto hit = rounded.intersect(eye, Vec3(direction), {});
        if (hit && hit->t >= static_cast<F>(epsilon))
            met.emplace_back(eye + hit->t * Vec3(direction));
        else
            met.emplace_back();
    }
    return met;
}

/// `placed`: as both renderers do it before they use a scene.
auto near_eye_cases(
    std::function<MetPoints(const scenes::Scene&, const std::vector<scenes::Vec3>&)> trace, bool placed)
{
    return [trace = std::move(trace), placed](double parameter, Random& random, int cases,
                                              Tally& tally) {
        for (int i = 0; i < cases; ++i) {
            const NearEye near = near_eye(parameter, random);
            const scenes::Scene scene = placed ? scenes::placed(near.scene) : near.scene;
            const auto met = trace(scene, {near.direction}).front();
            if (near.down && !met)
                tally.add(Failure::missed);
            else if (!near.down && met)
                tally.add(Failure::self_hit);
            else if (!near.down)
                tally.add(0.0);
            else
                tally.add(
                    length(ExactVec3(*met * (near.scene.unit / scene.unit)) - near.target).to_double() /
                    parameter);
        }
    };
}

template <class F>
void add_epsilons(std::vector<Method>& methods)
{
    constexpr bool is_double = std::is_same_v<F, double>;
    const auto add = [&](const char* name, double epsilon) {
        methods.push_back(
            {(is_double ? "double, " : "float, ") + std::string(name),
             is_double ? Format::binary64 : Format::binary32,
             near_eye_cases(
                 [epsilon](const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards) {
                     return met_beyond<F>(epsilon, scene, towards);
                 },
                 false)});
    };
    add("fixed 1e-3", 1e-3);
    add("fixed 1e-4", 1e-4);
    add("fixed 1e-6", 1e-6);
    add("no epsilon", 0);
}

// Lengths are in diameters of the triangle: its extents are at most 1, and coordinates at most 0.7. Let
// c be the cosine between the ray and the normal, and h the height. To first order in u:
//
// 1. The query is exact for perturbed vertices (ref/trees/geometry.cpp, step 3). A vertex at m from the
//    eye, |m| <= 0.62, is moved across the ray's longest axis by 2 u |m_i| + 3 u |m_z| along each of two
//    axes, and along the ray by 2 u |m_z| sqrt(3) at most: in total 0.62 (2 + 3 sqrt(2) + 2 sqrt(3)) u
//    = 6.1 u. The weights are those of the point where the ray meets the perturbed triangle. That is
//    6.1 u from the plane, so 6.1 u / c along the ray from the true point; and the same weights of the
//    true vertices give a point 6.1 u from it.
// 2. The position v0 + (b1 e1 + b2 e2) has an error of 7 u (b1 |e1| + b2 |e2|) + u |p| < 8 u.
// 3. The eye is rounded: 0.7 u (1 + 1 / c). In single precision so are the vertices, by as much; and the
//    direction, which is an error of u h / c.
// The error is relative to h.
double bound_of_near_eye(Format format, double height)
{
    const bool is_double = format == Format::binary64;
    const double u = unit_roundoff(format);
    const double of_plane = 6.1 + (is_double ? 0.7 : 1.4);
    return 1.01 * u *
           ((of_plane * (1 + 1 / least_cosine_from_near) + 8) / height + 4 / least_cosine_from_near);
}

} // namespace

Axis near_surface_axis()
{
    Axis axis;
    axis.number = 5;
    axis.name = "near-surface";
    axis.title = "Eye close above a surface";
    axis.parameter = "height of the eye above the surface, in diameters of the surface";
    axis.about =
        "The eye is over the middle of a triangle. Three of four rays go down, at up to 72 degrees from "
        "the normal; the error is the distance between the point that is met and the true one, relative "
        "to the height. A ray down that meets nothing has missed; a ray up that meets the triangle is a "
        "self-hit. The truth is computed with sixty digits, for an eye that is not rounded. Of the "
        "usual "
        "tricks only the fixed epsilon concerns a ray from the eye: hits that are nearer are ignored. A "
        "relative epsilon, units in the last place and excluding the primitive that was left do nothing "
        "here, because the eye is on no surface, and no ray comes before.";
    axis.ordinary = 0.05;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-18, -1.5, 0.5);
    axis.values.push_back(axis.ordinary);
    for (const Wing wing : wings())
        axis.methods.push_back(
            {name_of(wing), format_of(wing),
             near_eye_cases(
                 [wing](const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards) {
                     return met_by(wing, scene, towards);
                 },
                 true)});
    add_epsilons<float>(axis.methods);
    add_epsilons<double>(axis.methods);
    const std::string because = "the coordinates of the eye and of the sheared vertices are rounded to "
                                "2^-24 (2^-53 in double) of the extent of the surface";
    axis.limits = {{"ref", 4.3e-13, [](double x) { return bound_of_near_eye(Format::binary64, x); },
                    1.2e-14, Failure::inaccurate, because},
                   {"host", 2.5e-4, [](double x) { return bound_of_near_eye(Format::binary32, x); },
                    6e-6, Failure::inaccurate, because}};
    axis.derivation =
        "the vertices are sheared with an error of 6.1 u, which moves the meeting point by as "
        "much over the cosine; the position from its weights adds 8 u, the eye 0.7 u (1 + 1/cos), "
        "and in single precision the vertices as much again. Relative to the height h that is 37 "
        "u / h, or 40 u / h in single precision.";
    return axis;
}

} // namespace extremes
