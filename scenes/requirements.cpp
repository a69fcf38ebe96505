// A strategy can carry light if there is an emitter to start from, and a vertex that can be joined at
// each end of its connecting edge:
//
//   - An emitter that has an area (a triangle or a sphere) or surrounds the scene (the environment) can
//   be
//     hit by the eye walk, so emission_hit exists. It can also be joined to the pinhole: (s,t) = (1,1),
//     a light image.
//   - A point light, a directional light or a spot light is a delta emitter: no ray hits it. Seen
//   directly
//     it would be a single bright point without area in the picture, which no strategy renders.
//   - A mirror or smooth glass scatters into single directions. The probability that one of them leads
//   to a
//     given other vertex is zero, so such a vertex is joined to nothing. Surfaces that emit reflect
//     nothing. A Lambertian surface that is not black can be joined: to a fresh point on any emitter
//     (next_event), to the pinhole at the end of a light subpath of two vertices or more (light_image),
//     and to another such surface (inner_connection).
//
// Occlusion is not considered, nor whether the scene has two surfaces that face each other. A scene
// without a camera has no paths at all.

#include "scenes/requirements.h"

#include "scenes/for_each_light.h"
#include "scenes/is_emitter.h"

#include <variant>
#include <vector>

namespace scenes {
namespace {

std::set<Strategy> strategies(const std::set<EmitterKind>& emitters, bool joinable)
{
    std::set<Strategy> possible;
    const bool can_be_hit = emitters.contains(EmitterKind::triangle) ||
                            emitters.contains(EmitterKind::sphere) ||
                            emitters.contains(EmitterKind::environment);
    if (can_be_hit) possible.insert({Strategy::emission_hit, Strategy::light_image});
    if (!emitters.empty() && joinable)
        possible.insert({Strategy::next_event, Strategy::light_image, Strategy::inner_connection});
    return possible;
}

} // namespace

Requirements requirements(const Scene& scene)
{
    Requirements required;
    // Flags and not sets in the loops: a scene may have millions of triangles.
    std::vector<bool> used(scene.materials.size());
    bool emitting_triangle = false;
    bool emitting_sphere = false;
    for (const Triangle& triangle : scene.triangles) {
        used[triangle.material] = true;
        emitting_triangle = emitting_triangle || is_emitter(scene, triangle);
    }
    for (const Sphere& sphere : scene.spheres) {
        used[sphere.material] = true;
        emitting_sphere = emitting_sphere || is_emitter(scene, sphere);
    }
    if (!scene.triangles.empty()) required.shapes.insert(Shape::triangle);
    if (!scene.spheres.empty()) required.shapes.insert(Shape::sphere);

    bool joinable = false; // some surface can be joined to another vertex
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (!used[i]) continue;
        if (const auto* lambertian = std::get_if<Lambertian>(&scene.materials[i])) {
            required.bsdfs.insert(Bsdf::lambertian);
            joinable = joinable || lambertian->albedo != Rgb(0.0);
        }
        if (std::holds_alternative<Mirror>(scene.materials[i])) required.bsdfs.insert(Bsdf::mirror);
        if (std::holds_alternative<Glass>(scene.materials[i])) required.bsdfs.insert(Bsdf::glass);
    }

    if (emitting_triangle) required.emitters.insert(EmitterKind::triangle);
    if (emitting_sphere) required.emitters.insert(EmitterKind::sphere);
    for_each_light(scene, [&](const auto& light, std::size_t) {
        if (is_emitter(light)) required.emitters.insert(kind_of(light));
    });
    if (has_environment(scene)) required.emitters.insert(EmitterKind::environment);

    if (scene.camera) {
        required.fov_axes.insert(scene.camera->fov_axis);
        required.strategies = strategies(required.emitters, joinable);
    }
    return required;
}

} // namespace scenes
