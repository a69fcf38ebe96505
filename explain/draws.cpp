// Which random numbers have an effect, and what they decide.

#include "explain/parts.h"

#include <algorithm>

namespace explain {

namespace {

Draw draw(const ref::SampleId& id, ref::Event event, int j, std::array<const char*, 4> use)
{
    const auto vertex = static_cast<std::uint32_t>(j);
    return {event, vertex, uniforms(id, event, vertex), use};
}

} // namespace

Draw draw_of_camera(const ref::SampleId& id)
{
    return draw(id, ref::Event::camera, 0, {"x in the pixel", "y in the pixel"});
}

Draw draw_of_bounce(const Setting& setting, ref::Transport carried, const ref::Vertex& vertex, int j)
{
    const auto& material = material_at(setting.world, vertex);
    std::array<const char*, 4> use{};
    if (std::holds_alternative<scenes::Lambertian>(material)) use[0] = use[1] = "direction";
    if (std::holds_alternative<scenes::Glass>(material)) use[2] = "lobe";
    if (setting.options.roulette && j >= setting.options.roulette_from) use[3] = "roulette";
    const bool eye = carried == ref::Transport::radiance;
    return draw(setting.id, eye ? ref::Event::eye_bounce : ref::Event::light_bounce, j, use);
}

Draw draw_of_emitter(const Setting& setting, ref::Event event, int j)
{
    Draw result = draw(setting.id, event, j, {"emitter"});
    const ref::Emitter* emitter = setting.world.emitters.choose(result.uniforms[0]);
    if (emitter == nullptr) return result;
    if (ref::is_surface(emitter->kind)) result.use[1] = result.use[2] = "point";
    if (emitter->kind == ref::EmitterKind::environment) result.use[1] = result.use[2] = "direction";
    return result;
}

Draw draw_of_emission_direction(const Setting& setting, const ref::Vertex& y0)
{
    const char* use =
        y0.kind == ref::Vertex::Kind::infinity ? "point of the disc that covers the scene" : "direction";
    return draw(setting.id, ref::Event::emission_direction, 0, {use, use});
}

void append(std::vector<Draw>& draws, const Draw& draw)
{
    if (std::ranges::any_of(draw.use, [](const char* use) { return use != nullptr; }))
        draws.push_back(draw);
}

} // namespace explain
