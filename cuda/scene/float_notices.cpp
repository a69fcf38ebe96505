#include "cuda/scene/float_notices.h"

#include "cuda/scene/scene_arrays.h"
#include "cuda/transport/surface_point.h"
#include "scenes/bounds.h"
#include "scenes/contacts.h"
#include "scenes/for_each_light.h"
#include "scenes/largest_component.h"
#include "scenes/primitive_name.h"
#include "scenes/short_number.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fast {
namespace {

/// The number of primitives of one sort, and the first of them.
class Count {
public:
    void add(std::uint32_t primitive)
    {
        if (count_++ == 0) first_ = primitive;
    }
    /// Appends "3 triangles or spheres, first triangle 5 (material "wall"), ..." if there are any.
    void say(std::vector<std::string>& notices, const scenes::Scene& scene, const char* what) const
    {
        if (count_ == 0) return;
        notices.push_back(std::to_string(count_) + " surface(s), first " +
                          scenes::primitive_name(scene, first_) + ", " + what);
    }

private:
    std::size_t count_ = 0;
    std::uint32_t first_ = 0;
};

/// Whether an extent a at a distance M from the centre is less than its clearance, up to
/// sqrt(3) u (2 M + 8 a), with room for a chord to be met that is shorter than the surface is wide.
bool is_too_small(double extent, double distance)
{
    return extent < 16 * unit_roundoff * distance;
}

/// The largest distance from a triangle at which rays begin that leave it, in the scene's own unit of
/// length.
double clearance_of(const scenes::Triangle& triangle, const Placement& place)
{
    const Vec3 v[] = {place(triangle.vertices[0]), place(triangle.vertices[1]),
                      place(triangle.vertices[2])};
    const Vec3 e1 = v[1] - v[0];
    const Vec3 e2 = v[2] - v[0];
    const Vec3 normal = unit_normal(e1, e2);
    const Vec3 farthest = glm::max(glm::max(glm::abs(v[0]), glm::abs(v[1])), glm::abs(v[2]));
    const float own = triangle_clearance(normal, e1, e2, triangle_extent(e1, e2));
    return static_cast<double>(clearance_at(farthest, normal, own)) / place.scale;
}

/// The distance of the centre of b from the plane of a.
double distance_between(const scenes::Triangle& a, const scenes::Triangle& b)
{
    const auto& v = a.vertices;
    const scenes::Vec3 middle = (b.vertices[0] + b.vertices[1] + b.vertices[2]) / 3.0;
    return std::abs(glm::dot(glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0])), middle - v[0]));
}

/// Glass triangles from which rays begin beyond another triangle; but not those that coincide with one,
/// for which there is a rule (scenes/contacts.h).
void add_narrow_gaps(std::vector<std::string>& notices, const scenes::Scene& scene,
                     const Placement& place, double diagonal)
{
    const auto is_glass = [&](std::uint32_t primitive) {
        return std::holds_alternative<scenes::Glass>(scene.materials[material_of(scene, primitive)]);
    };
    if (std::ranges::none_of(scene.materials, [](const scenes::Material& material) {
            return std::holds_alternative<scenes::Glass>(material);
        }))
        return;
    const double reach = 30 * unit_roundoff * diagonal; // more than any clearance
    const scenes::Coincidences near =
        scenes::coincidences(scene, scenes::double_rounding, nullptr, reach);
    if (near.empty()) return;
    const scenes::Coincidences touching = scenes::coincidences(scene);
    Count gaps;
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        if (!is_glass(i)) continue;
        const scenes::Triangle& triangle = scene.triangles[i];
        const bool too_close = std::ranges::any_of(near.of(i), [&](std::uint32_t other) {
            return !std::ranges::binary_search(touching.of(i), other) &&
                   distance_between(triangle, scene.triangles[other]) < clearance_of(triangle, place);
        });
        if (too_close) gaps.add(i);
    }
    gaps.say(notices, scene,
             "are of glass and closer to another surface than single precision can resolve: light that "
             "passes between them is lost");
}

// The limits of docs/extremes.md in single precision: up to there no result is wrong by more than 1%.
constexpr double farthest_eye = 1.1e4;    // axis far-camera: in diagonals from the middle of the scene
constexpr double narrowest_view = 0.16;   // axis fov-narrow: in degrees, of a picture of 64 pixels
constexpr double least_missing = 0.42;    // axis fov-wide: to 180 degrees
constexpr double smallest_emitter = 3e-5; // axis emitter-size: in diagonals
constexpr double largest_ior = 250;       // axis ior; its reciprocal, too
constexpr double nearest_to_air = 2.5e-5; // axis ior-near-1: |ior - 1|

/// Says so if the rays of the camera cannot be aimed.
void add_camera(std::vector<std::string>& notices, const scenes::Camera& camera,
                const scenes::Bounds& box, double diagonal)
{
    const double distance =
        glm::length(camera.eye - (0.5 * box.min + 0.5 * box.max)) / std::max(diagonal, 1e-300);
    if (distance > farthest_eye)
        notices.push_back(
            "the eye is " + scenes::short_number(distance) +
            " diagonals away from the middle of the scene: single precision aims rays from "
            "more than " +
            scenes::short_number(farthest_eye) +
            " with an error of more than 1% of the scene (--device ref does not)");
    const double degrees = camera.fov * 180 / std::numbers::pi;
    if (degrees < narrowest_view || degrees > 180 - least_missing)
        notices.push_back("a field of view of " + scenes::short_number(degrees) +
                          " degrees: in single precision the directions of rays may be off by more than "
                          "1% of a pixel (--device ref is more precise)");
}

/// Says so if Fresnel's equations lose too many digits.
void add_glass(std::vector<std::string>& notices, const scenes::Scene& scene)
{
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const auto* glass = std::get_if<scenes::Glass>(&scene.materials[i]);
        if (glass == nullptr || glass->ior == 1.0) continue;
        const double ior = glass->ior;
        if (ior > largest_ior || ior < 1 / largest_ior || std::abs(ior - 1) < nearest_to_air)
            notices.push_back("material \"" + scene.material_names[i] +
                              "\": an index of refraction of " + scenes::short_number(ior) +
                              " is beyond what single precision holds to 1% (--device ref does)");
    }
}

/// Says so if `position` is so close to a surface that its height is not known: it is rounded by
/// sqrt(3) u D / 2 at most, D the diagonal of the scene, and so is the surface.
void add_end(std::vector<std::string>& notices, const scenes::Scene& scene, double diagonal,
             const std::string& what, const scenes::Vec3& position)
{
    const double near = 2 * unit_roundoff * diagonal;
    for (const scenes::NearSurface& surface : scenes::surfaces_near(scene, position, near)) {
        if (surface.side == 0) continue; // on it: there is a rule
        notices.push_back(what + " is closer to a surface (material \"" +
                          scene.material_names[material_of(scene, surface.primitive)] +
                          "\") than single precision can resolve: what is right beside it is wrong");
        return;
    }
}

} // namespace

std::vector<std::string> float_notices(const scenes::Scene& scene)
{
    const Placement place = placement_of(scene);
    Count collapsed;
    Count small;
    Count small_emitters;
    const auto box = scenes::bounds(scene);
    const double diagonal = box ? glm::length(box->max - box->min) : 0.0;
    std::uint32_t primitive = 0;
    for (const scenes::Triangle& triangle : scene.triangles) {
        const auto& v = triangle.vertices;
        const double extent =
            std::max(scenes::largest_component(v[1] - v[0]), scenes::largest_component(v[2] - v[0]));
        if (has_area_in_double(triangle)) {
            if (!has_area(triangle, place))
                collapsed.add(primitive);
            else if (is_too_small(extent, scenes::largest_component(v[0] - place.origin)))
                small.add(primitive);
            else if (extent < smallest_emitter * diagonal &&
                     std::holds_alternative<scenes::Emission>(scene.materials[triangle.material]))
                small_emitters.add(primitive);
        }
        ++primitive;
    }
    for (const scenes::Sphere& sphere : scene.spheres) {
        if (is_too_small(sphere.radius, scenes::largest_component(sphere.center - place.origin)))
            small.add(primitive);
        ++primitive;
    }
    std::vector<std::string> notices;
    collapsed.say(notices, scene,
                  "collapse to a line or a point in single precision: no ray meets them");
    small.say(notices, scene,
              "are so small for their distance from the centre of the scene that single precision "
              "cannot leave them safely: light to and from them may be wrong");
    small_emitters.say(notices, scene,
                       "emit and are so small that single precision places points on them with an error "
                       "that may change their light by more than 1%");
    if (!box) return notices;
    add_narrow_gaps(notices, scene, place, diagonal);
    add_glass(notices, scene);
    if (scene.camera) {
        add_end(notices, scene, diagonal, "the eye", scene.camera->eye);
        add_camera(notices, *scene.camera, *box, diagonal);
    }
    scenes::for_each_light_position(scene, [&](const scenes::Vec3& position, const std::string& name) {
        add_end(notices, scene, diagonal, name, position);
    });
    return notices;
}

} // namespace fast
