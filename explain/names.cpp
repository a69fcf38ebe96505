#include "explain/names.h"

#include "scenes/kinds.h"

#include <array>
#include <cstdio>

namespace explain {

namespace {

using Kind = ref::Vertex::Kind;

/// The kind of material: "lambertian", "mirror", "glass" or "emission".
std::string_view kind_of(const scenes::Material& material)
{
    constexpr std::array<std::string_view, 4> names = {"lambertian", "mirror", "glass", "emission"};
    return names[material.index()];
}

struct Words {
    std::string_view name;
    std::string_view sentence;
};

Words words_of(Obstacle obstacle)
{
    switch (obstacle) {
    case Obstacle::none:
        return {"none", ""};
    case Obstacle::no_eye_vertex:
        return {"no_eye_vertex", "the eye walk has no such vertex"};
    case Obstacle::no_light_vertex:
        return {"no_light_vertex", "the light walk has no such vertex"};
    case Obstacle::too_long:
        return {"too_long", "beyond --max-edges"};
    case Obstacle::left_out:
        return {"left_out", "its family is left out (--without)"};
    case Obstacle::not_an_emitter:
        return {"not_an_emitter", "emits nothing"};
    case Obstacle::dark_side:
        return {"dark_side", "sends no light in this direction"};
    case Obstacle::delta_vertex:
        return {"delta_vertex", "is a delta vertex, which joins to nothing"};
    case Obstacle::no_scattering:
        return {"no_scattering", "is on an emitter, which reflects nothing"};
    case Obstacle::at_infinity:
        return {"at_infinity", "is at infinity, where nothing can be joined"};
    case Obstacle::delta_emitter:
        return {"delta_emitter", "has no extent: the pinhole does not see it"};
    case Obstacle::no_emitter:
        return {"no_emitter", "no emitter has power"};
    case Obstacle::edge_on:
        return {"edge_on", "is seen edge-on: density 0"};
    case Obstacle::outside_picture:
        return {"outside_picture", "is outside the picture"};
    case Obstacle::other_side:
        return {"other_side", "faces away: its two edges are on different sides of the surface"};
    case Obstacle::black:
        return {"black", "the BSDF is 0: a colour of a surface is black"};
    case Obstacle::blocked:
        return {"blocked", "blocked by"};
    case Obstacle::in_plane:
        return {"in_plane", "one triangle contains both ends"};
    case Obstacle::covered:
        return {"covered", "is covered by another surface in the same place"};
    case Obstacle::vanishes:
        return {"vanishes", "the product of its factors is 0"};
    }
    return {"", ""};
}

Words words_of(WalkEnd end)
{
    switch (end) {
    case WalkEnd::longest_path:
        return {"longest_path", "no strategy needs a further vertex (--max-edges)"};
    case WalkEnd::left_scene:
        return {"left_scene", "the ray leaves the scene"};
    case WalkEnd::environment:
        return {"environment", "it reaches the environment"};
    case WalkEnd::absorbed:
        return {"absorbed", "the surface scatters nothing"};
    case WalkEnd::roulette:
        return {"roulette", "by Russian roulette"};
    case WalkEnd::dark:
        return {"dark", "y_0 emits nothing in the direction drawn"};
    case WalkEnd::no_emitter:
        return {"no_emitter", "no emitter has power"};
    case WalkEnd::covered:
        return {"covered", "another emitter covers the point drawn"};
    case WalkEnd::not_walked:
        return {"not_walked", "this integrator needs no such walk"};
    }
    return {"", ""};
}

} // namespace

std::string_view name_of(ref::Event event)
{
    constexpr std::array<std::string_view, 6> names = {
        "camera", "emission_position", "emission_direction", "eye_bounce", "light_bounce", "next_event"};
    return names[static_cast<std::size_t>(event)];
}

std::string_view name_of(WalkEnd end)
{
    return words_of(end).name;
}

std::string_view name_of(Obstacle obstacle)
{
    return words_of(obstacle).name;
}

std::string_view name_of(images::Integrator integrator)
{
    constexpr std::array<std::string_view, 3> names = {"path", "bdpt", "light"};
    return names[static_cast<std::size_t>(integrator)];
}

std::string_view name_of(images::Heuristic heuristic)
{
    constexpr std::array<std::string_view, 3> names = {"balance", "power", "uniform"};
    return names[static_cast<std::size_t>(heuristic)];
}

std::string_view family_of(const Strategy& strategy)
{
    using Family = scenes::Strategy;
    return scenes::name_of(strategy.t == 1   ? Family::light_image
                           : strategy.s == 0 ? Family::emission_hit
                           : strategy.s == 1 ? Family::next_event
                                             : Family::inner_connection);
}

std::string_view sentence(WalkEnd end)
{
    return words_of(end).sentence;
}

std::string sentence(const Strategy& strategy, const scenes::Scene& scene)
{
    if (strategy.is_dropped()) return "not finite: left out of the picture";
    std::string text(words_of(strategy.obstacle).sentence);
    if (!strategy.at.empty()) text = strategy.at + " " + text;
    if (strategy.blocker) text += " " + describe_primitive(scene, *strategy.blocker);
    return text;
}

std::string describe_primitive(const scenes::Scene& scene, std::uint32_t primitive)
{
    const std::uint32_t material = material_of(scene, primitive);
    const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
    return (primitive < triangles ? "triangle " + std::to_string(primitive)
                                  : "sphere " + std::to_string(primitive - triangles)) +
           ", " + std::string(kind_of(scene.materials[material])) + " " + scene.material_names[material];
}

std::string describe(const scenes::Scene& scene, const ref::Vertex& vertex)
{
    if (vertex.kind == Kind::eye) return "the eye";
    if (vertex.kind == Kind::surface) return describe_primitive(scene, vertex.point.primitive);
    if (vertex.emitter->kind == ref::EmitterKind::environment) return "the environment";
    return std::string(scenes::name_of(vertex.emitter->kind)) + " light " +
           std::to_string(vertex.emitter->index);
}

std::string pixel_name(std::uint32_t pixel, int width)
{
    const auto w = static_cast<std::uint32_t>(width);
    return std::to_string(pixel % w) + "," + std::to_string(pixel / w);
}

std::string number(double x)
{
    std::array<char, 32> text{};
    (void)std::snprintf(text.data(), text.size(), "%.6g", x);
    return text.data();
}

std::string numbers(const Vec3& v)
{
    return number(v.x) + " " + number(v.y) + " " + number(v.z);
}

} // namespace explain
