// When can a strategy carry light? It needs an emitter to start from and a vertex that can be joined at
// each end of its connecting edge.
//
//   - An emitter that has an area (a mesh or a sphere) or surrounds the scene (the environment) can be
//   hit
//     by the eye walk, so emission_hit exists. Seen directly it can also be joined to the pinhole:
//     (s,t) = (1,1), a light image.
//   - A point or directional light or a spot is a delta emitter: no ray hits it. Seen directly it would
//   be
//     a single bright point of no area in the picture, which no strategy renders.
//   - A mirror or smooth glass scatters into single directions: the probability that these contain the
//     other vertex is zero, so such a vertex joins to nothing. Emission surfaces reflect nothing. What
//     can be joined is a Lambertian surface that is not black: to a fresh point on any emitter
//     (next_event), to the pinhole at the end of a light subpath of two vertices or more (light_image),
//     and to another such surface (inner_connection).
//
// Whether anything stands between is not considered, nor whether the scene has two surfaces facing each
// other. A scene without a camera has no paths at all.

#include "scenes/requirements.h"

#include "scenes/emission.h"

#include <glm/geometric.hpp>

#include <variant>

namespace scenes {
namespace {

/// Notes what a primitive of that shape and material asks for.
void require_surface(Requirements& needs, Shape shape, const Material& material, bool& joinable)
{
    needs.shapes.insert(shape);
    if (const auto* lambertian = std::get_if<Lambertian>(&material)) {
        needs.bsdfs.insert(Bsdf::lambertian);
        joinable = joinable || lambertian->albedo != Rgb(0.0);
    }
    if (std::holds_alternative<Mirror>(material)) needs.bsdfs.insert(Bsdf::mirror);
    if (std::holds_alternative<Glass>(material)) needs.bsdfs.insert(Bsdf::glass);
    if (is_emissive(material))
        needs.emitters.insert(shape == Shape::sphere ? Emitter::sphere : Emitter::mesh);
}

std::set<Strategy> strategies(const std::set<Emitter>& emitters, bool joinable)
{
    std::set<Strategy> possible;
    const bool can_be_hit = emitters.contains(Emitter::mesh) || emitters.contains(Emitter::sphere) ||
                            emitters.contains(Emitter::environment);
    if (can_be_hit) possible.insert({Strategy::emission_hit, Strategy::light_image});
    if (!emitters.empty() && joinable)
        possible.insert({Strategy::next_event, Strategy::light_image, Strategy::inner_connection});
    return possible;
}

} // namespace

Requirements requirements(const Scene& scene)
{
    Requirements needs;
    bool joinable = false; // some surface can be joined to
    for (const Triangle& triangle : scene.triangles)
        require_surface(needs, Shape::triangle, scene.materials[triangle.material], joinable);
    for (const Sphere& sphere : scene.spheres)
        require_surface(needs, Shape::sphere, scene.materials[sphere.material], joinable);

    const auto require = [&](Emitter emitter, const auto& lights) {
        if (!lights.empty()) needs.emitters.insert(emitter);
    };
    require(Emitter::point, scene.point_lights);
    require(Emitter::directional, scene.directional_lights);
    require(Emitter::spot, scene.spot_lights);
    if (scene.environment) needs.emitters.insert(Emitter::environment);

    if (scene.camera) {
        needs.fov_axes.insert(scene.camera->fov_axis);
        needs.strategies = strategies(needs.emitters, joinable);
    }
    return needs;
}

} // namespace scenes
