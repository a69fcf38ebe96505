#include "ref/transport/connect.h"

#include "ref/transport/emission.h"

namespace ref {

namespace {

/// The contribution of a path whose ends are joined; nullopt if it carries no light.
std::optional<Contribution> contribution(const World& world, const PathOptions& options,
                                         std::uint32_t pixel, std::span<const Vertex> y,
                                         std::span<const Vertex> z, const Rgb& value)
{
    if (value == Rgb(0.0)) return std::nullopt;
    return Contribution{pixel, static_cast<int>(y.size()), static_cast<int>(z.size()), value,
                        mis_weight(world, options, join(y, z), y.size())};
}

} // namespace

LineOfSight line_to_eye(const World& world, const Vertex& vertex)
{
    if (vertex.kind == Vertex::Kind::infinity)
        return {LineOfSight::Test::ray, {world.camera.eye(), vertex.towards, Ray{}.t_max, world.eye_on}};
    return line_of_sight(world.geometry, vertex.point, world.camera.eye(), world.eye_on);
}

Vertex light_vertex(const World& world, const IncidentLight& light)
{
    const Rgb no_walk(1.0);
    return light.infinite ? infinity_vertex(*light.emitter, light.wi, no_walk)
           : light.delta  ? source_vertex(*light.emitter, light.end.position, no_walk)
                          : surface_vertex(world, light.end, no_walk);
}

Path join(std::span<const Vertex> y, std::span<const Vertex> z)
{
    Path x;
    for (const Vertex& vertex : y) x.push_back(&vertex);
    for (std::size_t t = z.size(); t > 0; --t) x.push_back(&z[t - 1]);
    return x;
}

std::optional<Contribution> emission_hit(const World& world, const PathOptions& options,
                                         const SampleId& id, std::span<const Vertex> z)
{
    const Vertex& last = z.back();
    if (last.emitter == nullptr) return std::nullopt;
    return contribution(world, options, id.pixel, {}, z,
                        last.alpha * emitted(world, last, z[z.size() - 2])); // map: emission-hit
}

std::optional<Contribution> next_event(const World& world, const PathOptions& options,
                                       const SampleId& id, std::span<const Vertex> z)
{
    const Vertex& last = z.back();
    if (!scatters(world, last)) return std::nullopt;
    const auto light =
        sample_incident(world.emitters, last.point.position,
                        uniforms(id, Event::next_event, static_cast<std::uint32_t>(z.size() - 1)));
    if (!light) return std::nullopt;
    const Vertex y0 = light_vertex(world, *light);
    const Rgb f = evaluate_bsdf(world, y0, last, z[z.size() - 2]);
    if (f == Rgb(0.0) || !visible(world.geometry, last.point, *light)) return std::nullopt;
    return contribution(world, options, id.pixel, {&y0, 1}, z,
                        // map: next-event
                        last.alpha * f * cosine(last, light->wi) * light->radiance / light->pdf);
}

std::optional<Contribution> light_image(const World& world, const PathOptions& options,
                                        std::span<const Vertex> y, const Vertex& eye)
{
    const Vertex& last = y.back();
    const bool first = y.size() == 1;
    if (first ? !can_be_hit(*last.emitter) : !scatters(world, last)) return std::nullopt;
    const Vec3 w = direction(eye, last);
    const auto film = world.camera.project(w);
    if (!film) return std::nullopt;
    const Rgb scattered =
        first ? emitted(world, last, eye) : evaluate_bsdf(world, y[y.size() - 2], last, eye);
    if (scattered == Rgb(0.0) || !is_free(world.geometry, line_to_eye(world, last))) return std::nullopt;
    if (first && last.kind == Vertex::Kind::surface && !sees_first(world.geometry, last.point, -w))
        return std::nullopt;
    const auto pixel =
        static_cast<std::uint32_t>(film->y) * static_cast<std::uint32_t>(world.camera.width()) +
        static_cast<std::uint32_t>(film->x);
    return contribution(world, options, pixel, y, {&eye, 1},
                        // map: light-image
                        last.alpha * scattered * geometric_term(last, eye) * world.camera.cosine(w) *
                            world.camera.importance(w));
}

std::optional<Contribution> inner_connection(const World& world, const PathOptions& options,
                                             const SampleId& id, std::span<const Vertex> y,
                                             std::span<const Vertex> z)
{
    const Vertex& y_last = y.back();
    const Vertex& z_last = z.back();
    if (!scatters(world, y_last) || !scatters(world, z_last)) return std::nullopt;
    const Rgb f = evaluate_bsdf(world, y[y.size() - 2], y_last, z_last) *
                  evaluate_bsdf(world, y_last, z_last, z[z.size() - 2]);
    if (f == Rgb(0.0) || !visible(world.geometry, y_last.point, z_last.point)) return std::nullopt;
    return contribution(world, options, id.pixel, y, z,
                        // map: inner-connection
                        y_last.alpha * f * geometric_term(y_last, z_last) * z_last.alpha);
}

} // namespace ref
