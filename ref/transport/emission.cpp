#include "ref/transport/emission.h"

namespace ref {

namespace {

double disc_area(const World& world)
{
    return pi * world.emitters.radius() * world.emitters.radius();
}

/// A ray that comes from direction `towards`, through a uniform point of a disc that covers the scene.
Ray ray_from_infinity(const World& world, const Vec3& towards, double u1, double u2)
{
    const Frame frame(towards);
    const glm::dvec2 disc = sample_disc(u1, u2);
    const double radius = world.emitters.radius();
    return {world.emitters.center() + radius * (disc.x * frame.x + disc.y * frame.y + 2.0 * towards),
            -towards};
}

} // namespace

std::optional<SampledEmission> sample_emission(const World& world, const Uniforms& position,
                                               const Uniforms& direction)
{
    const Emitter* emitter = world.emitters.choose(position[0]);
    if (emitter == nullptr) return std::nullopt;
    const double choice = emitter->probability;

    if (is_surface(emitter->kind)) {
        const SurfacePoint point = sample_surface(world.geometry, *emitter, position[1], position[2]);
        const Vec3 w = glm::normalize(
            Frame(point.normal).to_world(sample_cosine_hemisphere(direction[0], direction[1])));
        if (!sees_first(world.geometry, point, w)) return std::nullopt; // another emitter covers it
        const Rgb alpha(emitter->area / choice);
        // L cos / (p_A cos / pi)
        return SampledEmission{surface_vertex(world, point, alpha),
                               {leave_surface(point, w), w},
                               // map: emission-surface
                               alpha * pi * emitted_radiance(world.scene, point, w)};
    }
    if (is_at_infinity(emitter->kind))
        return visit_distant(world.scene, emitter->kind, emitter->index, [&](const auto& light) {
            const Vec3 towards = sample_towards(light, position[1], position[2]);
            const Rgb alpha(1.0 / (choice * pdf_towards(emitter->kind)));
            return SampledEmission{infinity_vertex(*emitter, towards, alpha),
                                   ray_from_infinity(world, towards, direction[0], direction[1]),
                                   // map: emission-directional, emission-environment
                                   alpha * emitted(light) * disc_area(world)};
        });
    return visit_source(world.scene, emitter->kind, emitter->index, [&](const auto& light) {
        const Vec3 w = sample_direction(light, direction[0], direction[1]);
        const double pdf = pdf_solid_angle_direction(light, w); // 0 where w rounds out of a cone
        return SampledEmission{source_vertex(*emitter, light.position, Rgb(1.0 / choice)),
                               {light.position, w, Ray{}.t_max, emitter->on},
                               // map: emission-point, emission-spot
                               pdf > 0.0 ? intensity(light, w) / (choice * pdf) : Rgb(0.0)};
    });
}

double pdf_emission_position(const Vertex& y0)
{
    const Emitter& emitter = *y0.emitter;
    // map: density-y0
    if (is_surface(emitter.kind)) return emitter.area > 0.0 ? emitter.probability / emitter.area : 0.0;
    return is_at_infinity(emitter.kind) ? emitter.probability * pdf_towards(emitter.kind)
                                        : emitter.probability;
}

double pdf_area_emission_direction(const World& world, const Vertex& y0, const Vertex& y1)
{
    const Vec3 w = direction(y0, y1);
    if (y0.kind == Vertex::Kind::infinity) return cosine(y1, w) / disc_area(world); // map: density-y1

    const double pdf_solid_angle =
        y0.kind == Vertex::Kind::surface
            ? std::max(0.0, glm::dot(y0.point.normal, w)) * inverse_pi
            : visit_source(world.scene, y0.emitter->kind, y0.emitter->index,
                           [&](const auto& light) { return pdf_solid_angle_direction(light, w); });
    const Vec3 d = y1.point.position - y0.point.position;
    return pdf_solid_angle * cosine(y1, w) / glm::dot(d, d); // map: density-y1
}

Rgb emitted(const World& world, const Vertex& y0, const Vertex& y1)
{
    const auto [kind, index] = std::pair(y0.emitter->kind, y0.emitter->index);
    const Vec3 w = direction(y0, y1);
    if (is_surface(kind)) return emitted_radiance(world.scene, y0.point, w);
    if (is_at_infinity(kind))
        return visit_distant(world.scene, kind, index, [](const auto& light) { return emitted(light); });
    return visit_source(world.scene, kind, index,
                        [&](const auto& light) { return intensity(light, w); });
}

} // namespace ref
