#include "scenes/placed.h"

#include "scenes/bounds.h"
#include "scenes/for_each_light.h"
#include "scenes/largest_component.h"
#include "scenes/read_scene.h"
#include "scenes/short_number.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace scenes {
namespace {

constexpr double step_in_diagonals = 1024;
constexpr double coarsest_noticed = 1e-6; // spacing of doubles in diagonals
constexpr double coarsest_held = 1e-3;
constexpr double brightest = 1e30; // leaves 8 decades of a float for what sampling multiplies it with
constexpr double dimmest = 1e-30;  // and as many above 2^-126, below which floats lose digits

bool is_finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// `v` times 2^exponent: exact unless it leaves the range of normal doubles.
Vec3 scaled(const Vec3& v, int exponent)
{
    return {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent), std::ldexp(v.z, exponent)};
}

/// Calls change(point) for every place in the scene, and change_length(radius) for every length.
template <typename Point, typename Length>
void for_each_coordinate(Scene& scene, const Point& change, const Length& change_length)
{
    for (Triangle& triangle : scene.triangles)
        for (Vec3& vertex : triangle.vertices) change(vertex);
    for (Sphere& sphere : scene.spheres) {
        change(sphere.center);
        change_length(sphere.radius);
    }
    for_each_light_position(scene, [&](Vec3& position, const std::string&) { change(position); });
    if (scene.camera) change(scene.camera->eye);
}

void check_finite(Scene& scene)
{
    bool finite = true;
    for_each_coordinate(
        scene, [&](const Vec3& v) { finite = finite && is_finite(v); },
        [&](double length) { finite = finite && std::isfinite(length); });
    if (!finite) throw SceneError(scene.name + ": a coordinate is NaN or infinite");
}

void check_light(const Scene& scene)
{
    double largest = 0; // of all light
    const auto check = [&](const Rgb& light, const std::string& what) {
        largest = std::max(largest, largest_component(light));
        if (!is_finite(light) || largest_component(light) > brightest)
            throw SceneError(scene.name + ": " + what + " of " + short_number(largest_component(light)) +
                             " is more than the " + short_number(brightest) +
                             " that a picture can hold");
    };
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (const auto* emission = std::get_if<Emission>(&scene.materials[i]))
            check(emission->radiance, "material \"" + scene.material_names[i] + "\": a radiance");
    for_each_light(scene, [&](const auto& light, std::size_t index) {
        check(emitted_by(light),
              light_name(light, index) +
                  (has_position<decltype(light)> ? ": an intensity (with the scene about one unit large)"
                                                 : ": an irradiance"));
    });
    if (scene.environment) check(*scene.environment, "the environment: a radiance");
    // One dim light beside a bright one loses nothing that a picture shows.
    if (largest > 0 && largest < dimmest)
        throw SceneError(scene.name + ": the brightest light, " + short_number(largest) +
                         " (with the scene about one unit large), is less than the " +
                         short_number(dimmest) + " that a picture can hold");
}

/// The multiple of the step that is nearest to the middle of the box, whose diagonal is in [1, 2).
Vec3 new_origin(const Bounds& box)
{
    const Vec3 center = 0.5 * box.min + 0.5 * box.max;
    return step_in_diagonals * glm::round(center / step_in_diagonals);
}

/// Checks the spacing of doubles at the scene's coordinates, relative to its diagonal (1 to 2).
void check_spacing(Scene& scene, const Bounds& box)
{
    const double farthest = std::max(largest_component(box.min), largest_component(box.max));
    const double spacing =
        farthest * std::numeric_limits<double>::epsilon() / glm::length(box.max - box.min);
    if (spacing < coarsest_noticed) return;
    const std::string what =
        "the scene lies so far from the origin that its coordinates are rounded to " +
        short_number(spacing) + " of its diagonal";
    if (!(spacing < coarsest_held))
        throw SceneError(scene.name + ": " + what + ": move it to the origin");
    scene.notices.push_back(what);
}

} // namespace

Scene placed(Scene scene)
{
    check_finite(scene);
    if (const auto box = bounds(scene)) {
        // A quarter of the extent cannot overflow where the corners do not.
        const Vec3 quarter = 0.25 * box->max - 0.25 * box->min;
        const double largest = largest_component(quarter);
        if (!std::isfinite(largest)) throw SceneError(scene.name + ": a sphere reaches to infinity");
        if (largest > 0) {
            // The diagonal is 4 |quarter|: brought to [1, 2) in two steps, since its square may
            // overflow.
            int exponent = 0;
            int rest = 0;
            std::frexp(largest, &exponent);
            std::frexp(4 * glm::length(scaled(quarter, -exponent)), &rest);
            const int scale = 1 - exponent - rest;
            scene.unit = std::ldexp(scene.unit, scale);
            const auto scale_point = [&](Vec3& v) { v = scaled(v, scale); };
            for_each_coordinate(scene, scale_point,
                                [&](double& length) { length = std::ldexp(length, scale); });
            for_each_light(scene,
                           [&](auto& light, std::size_t) { // intensities grow with a length squared
                               if constexpr (has_position<decltype(light)>)
                                   light.intensity = scaled(light.intensity, 2 * scale);
                           });

            const Bounds here = *bounds(scene);
            check_spacing(scene, here);
            const Vec3 origin = new_origin(here);
            for_each_coordinate(
                scene, [&](Vec3& v) { v -= origin; }, [](double&) {});
        }
    }
    check_finite(scene);
    check_light(scene);
    return scene;
}

} // namespace scenes
