// Both walks, vertex by vertex, with the densities and the numbers that led to each.

#include "explain/parts.h"
#include "ref/transport/subpath.h"

namespace explain {

namespace {

using Kind = ref::Vertex::Kind;

/// Appends the bounces and their densities to `walk`, whose vertices stand in `vertices`; the first two
/// have their densities already. `direction`: of the walk's first ray. Finds out why the walk ends.
void follow(const Setting& setting, ref::Transport carried, const std::vector<ref::Vertex>& vertices,
            Vec3 direction, std::size_t most, Walk& walk, std::vector<Draw>& draws)
{
    walk.end = vertices.size() == most ? WalkEnd::longest_path : WalkEnd::left_scene;
    for (std::size_t j = 1; j < vertices.size(); ++j) {
        const ref::Vertex& vertex = vertices[j];
        if (j > 1) {
            const Bounce& before = *walk.steps[j - 1].bounce;
            walk.steps.push_back(step_to(vertices[j - 1], vertex,
                                         before.sample.pdf_fwd * before.survival, before.sample.delta));
        }
        if (vertex.kind == Kind::infinity) {
            walk.end = WalkEnd::environment;
            return;
        }
        if (j + 1 == most) break;
        const Bounce bounce = bounce_at(setting, carried, vertex, -direction, static_cast<int>(j));
        walk.steps[j].bounce = bounce;
        append(draws, draw_of_bounce(setting, carried, vertex, static_cast<int>(j)));
        direction = bounce.wi;
        if (!bounce.survives) walk.end = WalkEnd::roulette;
        if (vertex.alpha * bounce.sample.value == Rgb(0.0)) walk.end = WalkEnd::absorbed;
    }
}

} // namespace

Step step_to(const ref::Vertex& from, const ref::Vertex& vertex, double pdf, bool delta)
{
    if (delta) return {vertex, std::nullopt, std::nullopt, pdf};
    if (vertex.kind == Kind::infinity) return {vertex, pdf, std::nullopt};
    const Vec3 d = vertex.point.position - from.point.position;
    return {vertex, pdf, pdf * cosine(vertex, direction(from, vertex)) / glm::dot(d, d)};
}

Bounce bounce_at(const Setting& setting, ref::Transport carried, const ref::Vertex& vertex,
                 const Vec3& wo, int j)
{
    const ref::Event event =
        carried == ref::Transport::radiance ? ref::Event::eye_bounce : ref::Event::light_bounce;
    const auto& material = material_at(setting.world, vertex);
    const ref::Frame frame(vertex.point.normal);
    const ref::Uniforms u = uniforms(setting.id, event, static_cast<std::uint32_t>(j));
    const ref::BsdfSample sample = ref::sample_bsdf(material, frame.to_local(wo), u, carried);
    const double survival =
        ref::survival_probability(material, j, setting.options.roulette, setting.options.roulette_from);
    return {sample, survival, u[3] < survival, glm::normalize(frame.to_world(sample.wi_local))};
}

Walk eye_walk(const Setting& setting, std::size_t most, std::vector<Draw>& draws)
{
    const std::vector<ref::Vertex> z = eye_subpath(setting.world, setting.options, setting.id, most);
    Walk walk{{{z[0], std::nullopt, std::nullopt, 1.0}}, WalkEnd::not_walked};
    if (most < 2) return walk;
    append(draws, draw_of_camera(setting.id));
    if (z.size() > 1) {
        const double pdf = setting.world.camera.pdf_solid_angle(direction(z[0], z[1]));
        walk.steps.push_back(step_to(z[0], z[1], pdf, false));
    }
    follow(setting, ref::Transport::radiance, z, camera_ray(setting.world, setting.id).direction, most,
           walk, draws);
    return walk;
}

Walk light_walk(const Setting& setting, std::size_t most, std::vector<Draw>& draws)
{
    if (most == 0) return {{}, WalkEnd::not_walked};
    const std::vector<ref::Vertex> y = light_subpath(setting.world, setting.options, setting.id, most);
    const Draw position = draw_of_emitter(setting, ref::Event::emission_position, 0);
    append(draws, position);
    if (y.empty()) {
        const bool any = setting.world.emitters.choose(position.uniforms[0]) != nullptr;
        return {{}, any ? WalkEnd::covered : WalkEnd::no_emitter};
    }
    Walk walk{{}, WalkEnd::longest_path};
    const double pdf = pdf_emission_position(y[0]);
    if (y[0].kind == Kind::surface)
        walk.steps.push_back({y[0], std::nullopt, pdf});
    else if (can_be_hit(*y[0].emitter))
        walk.steps.push_back({y[0], pdf, std::nullopt});
    else
        walk.steps.push_back({y[0], std::nullopt, std::nullopt, pdf});
    if (most == 1) return walk;
    const Draw towards = draw_of_emission_direction(setting, y[0]);
    append(draws, towards);
    if (y.size() > 1) {
        const double pdf_area = pdf_area_emission_direction(setting.world, y[0], y[1]);
        Step step{y[1], std::nullopt, pdf_area};
        const double g = cosine(y[1], direction(y[0], y[1]));
        if (y[0].kind != Kind::infinity && g > 0.0) { // [Veach 1997, eq. 8.10], the other way
            const Vec3 d = y[1].point.position - y[0].point.position;
            step.pdf_solid_angle = pdf_area * glm::dot(d, d) / g;
        }
        walk.steps.push_back(step);
    }
    const auto emission = sample_emission(setting.world, position.uniforms, towards.uniforms);
    follow(setting, ref::Transport::power, y, emission->ray.direction, most, walk, draws);
    if (emission->alpha == Rgb(0.0)) walk.end = WalkEnd::dark;
    return walk;
}

} // namespace explain
