// A point light far away from the scene.

#include "extremes/axes/axes.h"
#include "extremes/far/far_light_scene.h"
#include "extremes/refusal.h"
#include "extremes/wing.h"

#include "cuda/launch/probes.h"
#include "ref/transport/visibility.h"
#include "scenes/placed.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace extremes {

namespace {

std::vector<double> irradiance_of_reference(const FarLight& far, const scenes::Scene& placed)
{
    const ref::Geometry geometry(placed);
    const ref::Emitters emitters(geometry);
    std::vector<double> result;
    for (const FarLight::OnFloor& on : far.points) {
        const ref::SurfacePoint point =
            ref::triangle_point(geometry, on.triangle, {1 - on.b1 - on.b2, on.b1, on.b2});
        const auto light = ref::sample_incident(emitters, point.position, {0.5, 0.5, 0.5, 0.5});
        result.push_back(light && ref::visible(geometry, point, *light)
                             ? light->radiance.x / light->pdf * glm::dot(point.normal, light->wi)
                             : 0.0);
    }
    return result;
}

std::vector<double> irradiance_of_fast_path(Wing wing, const FarLight& far, const scenes::Scene& placed)
{
    const fast::SceneArrays arrays = fast::scene_arrays(placed, false);
    std::vector<fast::PointProbe> probes;
    for (const FarLight::OnFloor& on : far.points)
        probes.push_back({on.triangle, static_cast<float>(on.b1), static_cast<float>(on.b2)});
    const auto compute = wing == Wing::cuda ? fast::probe_irradiance_on_device : fast::probe_irradiance;
    const std::vector<float> found = compute(arrays, probes);
    return {found.begin(), found.end()};
}

/// The irradiance at the points of the floor from the light, 0 in shadow.
std::vector<double> far_irradiance(Wing wing, const FarLight& far, const scenes::Scene& placed)
{
    return wing == Wing::ref ? irradiance_of_reference(far, placed)
                             : irradiance_of_fast_path(wing, far, placed);
}

/// `checked`: by scenes::placed, which refuses bright lights.
auto far_light_cases(Wing wing, bool checked)
{
    return [wing, checked](double parameter, Random& random, int cases, Tally& tally) {
        for (int done = 0; done < cases; done += points_of_far_light) {
            FarLight far = far_light(parameter, random);
            far.points.resize(static_cast<std::size_t>(std::min(points_of_far_light, cases - done)));
            std::vector<double> computed;
            const bool accepted = unless_refused(tally, far.points.size(), [&] {
                computed = far_irradiance(wing, far, checked ? scenes::placed(far.scene) : far.scene);
            });
            if (!accepted) continue;
            for (std::size_t i = 0; i < computed.size(); ++i) {
                const FarLight::OnFloor& point = far.points[i];
                if (!point.lit && computed[i] != 0) // also if it is NaN
                    tally.add(Failure::leaked);
                else if (!point.lit)
                    tally.add(0.0);
                else if (!std::isfinite(computed[i]))
                    tally.add(Failure::not_finite);
                else if (computed[i] == 0)
                    tally.add(Failure::missed);
                else
                    tally.add(relative_error(computed[i], point.irradiance));
            }
        }
    };
}

// The relative error of the irradiance I cos / d^2. Let u be the unit roundoff, D the distance of the
// light and d >= D - 0.5 that to the point, in diameters. To first order in u:
//
// 1. The vector d = s - p. The position p has a rounding of each vertex, of the products and the sums,
//    and it may be moved off the edge of its triangle by 72 u in single precision: in total less than
//    80 u. The position s of the light is rounded, u D, and so is the difference, u d.
// 2. The intensity is rounded, twice with the factor of the scale, the squares and their sum add
//    3 u, the reciprocal and the product 2 u, the probability of the choice 1 u: 8 u, and twice the
//    error of d.
// 3. The cosine. The normal has an angle of 4 u times 2, the ratio of the longest edge to the
//    height, and 6 u from the vertices; the unit vector has 3.5 u, the product with it and the sum 4 u.
//    With the error of d this is relative to the cosine, which is at least least_far_cosine less 0.5 /
//    d.
double bound_of_far_light(Format format, double distance)
{
    const double u = unit_roundoff(format);
    const double d = distance - 0.5;
    const double of_d = (80 + distance) / d + 1;
    const double cosine = (least_far_cosine * distance) / (distance + 0.5);
    return 1.01 * u * (8 + 2 * of_d + (22 + of_d) / cosine);
}

} // namespace

Axis far_light_axis()
{
    Axis axis;
    axis.number = 3;
    axis.name = "far-light";
    axis.title = "Distance of a point light";
    axis.parameter = "distance of the light from the middle of the scene, in diameters of the scene";
    axis.about =
        "The scene is a square floor with a sphere over it, lit by a point light. Its intensity grows "
        "with the square of the distance, so that the irradiance stays near 1. The error is that of the "
        "irradiance at a random point of the floor, relative to itself; at a point in the shadow of the "
        "sphere, light is a leak, and elsewhere no light is a miss. The truth is I cos / d^2 with sixty "
        "digits.";
    axis.ordinary = 1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(0, 20, 0.5);
    for (const Wing wing : wings())
        axis.methods.push_back({name_of(wing), format_of(wing), far_light_cases(wing, true)});
    axis.methods.push_back(
        {"not refused (double)", Format::binary64, far_light_cases(Wing::ref, false)});
    axis.methods.push_back(
        {"not refused (float)", Format::binary32, far_light_cases(Wing::host, false)});
    const std::string because =
        "an intensity of more than 1e30 (with the scene about one unit large) is refused: use a "
        "directional light, which gives the same picture from a distance of 1e8 on";
    axis.limits = {{"ref", 9.9e14, [](double x) { return bound_of_far_light(Format::binary64, x); },
                    1.02e15, Failure::refused, because},
                   {"host", 9.9e14, [](double x) { return bound_of_far_light(Format::binary32, x); },
                    1.02e15, Failure::refused, because}};
    axis.derivation =
        "the irradiance is I cos / d^2. The vector to the light has a relative error below 2 u "
        "from a distance of 80 on, the square and the division add 8 u, and the cosine has an "
        "error of about 22 u relative to the least cosine. The bound does not grow with the "
        "distance. The program refuses an intensity above 1e30, and the intensity here is the "
        "square of the distance.";
    return axis;
}

} // namespace extremes
