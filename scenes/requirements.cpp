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

#include "scenes/is_emitter.h"

#include <algorithm>
#include <variant>

namespace scenes {
namespace {

/// Notes what a surface of that material asks for, apart from its light.
void require_surface(Requirements& needs, const Material& material, bool& joinable)
{
    if (const auto* lambertian = std::get_if<Lambertian>(&material)) {
        needs.bsdfs.insert(Bsdf::lambertian);
        joinable = joinable || lambertian->albedo != Rgb(0.0);
    }
    if (std::holds_alternative<Mirror>(material)) needs.bsdfs.insert(Bsdf::mirror);
    if (std::holds_alternative<Glass>(material)) needs.bsdfs.insert(Bsdf::glass);
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

template <class Enumeration, std::size_t count>
std::string_view pick(const std::array<std::string_view, count>& names, Enumeration enumerator)
{
    static_assert(count == all_of<Enumeration>.size());
    return names.at(static_cast<std::size_t>(enumerator));
}

} // namespace

std::string_view name_of(Shape shape)
{
    return pick(std::array<std::string_view, 2>{"triangle", "sphere"}, shape);
}

std::string_view name_of(Bsdf bsdf)
{
    return pick(std::array<std::string_view, 3>{"lambertian", "mirror", "glass"}, bsdf);
}

std::string_view name_of(Emitter emitter)
{
    return pick(
        std::array<std::string_view, 6>{"mesh", "sphere", "point", "directional", "spot", "environment"},
        emitter);
}

std::string_view name_of(Strategy strategy)
{
    return pick(
        std::array<std::string_view, 4>{"emission_hit", "next_event", "light_image", "inner_connection"},
        strategy);
}

std::string_view name_of(FovAxis axis)
{
    return pick(std::array<std::string_view, 2>{"horizontal", "vertical"}, axis);
}

Requirements requirements(const Scene& scene)
{
    Requirements needs;
    bool joinable = false; // some surface can be joined to
    for (const Triangle& triangle : scene.triangles) {
        needs.shapes.insert(Shape::triangle);
        require_surface(needs, scene.materials[triangle.material], joinable);
        if (is_emitter(scene, triangle)) needs.emitters.insert(Emitter::mesh);
    }
    for (const Sphere& sphere : scene.spheres) {
        needs.shapes.insert(Shape::sphere);
        require_surface(needs, scene.materials[sphere.material], joinable);
        if (is_emitter(scene, sphere)) needs.emitters.insert(Emitter::sphere);
    }
    const auto require = [&](Emitter emitter, const auto& lights) {
        if (std::any_of(lights.begin(), lights.end(),
                        [](const auto& light) { return is_emitter(light); }))
            needs.emitters.insert(emitter);
    };
    require(Emitter::point, scene.point_lights);
    require(Emitter::directional, scene.directional_lights);
    require(Emitter::spot, scene.spot_lights);
    if (has_environment(scene)) needs.emitters.insert(Emitter::environment);

    if (scene.camera) {
        needs.fov_axes.insert(scene.camera->fov_axis);
        needs.strategies = strategies(needs.emitters, joinable);
    }
    return needs;
}

} // namespace scenes
