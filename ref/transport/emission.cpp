#include "ref/transport/emission.h"

namespace ref {

namespace {

/// Directions of a spot light are uniform in its cone.
double pdf_solid_angle_cone(const scenes::SpotLight& light)
{
    return 1.0 / (2.0 * pi * (1.0 - light.cos_cutoff));
}

Vec3 sample_cone(const scenes::SpotLight& light, double u1, double u2)
{
    const double z = 1.0 - u1 * (1.0 - light.cos_cutoff);
    const double radius = std::sqrt(std::max(0.0, 1.0 - z * z));
    const double phi = 2.0 * pi * u2;
    return Frame(light.direction).to_world({radius * std::cos(phi), radius * std::sin(phi), z});
}

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

    switch (emitter->kind) {
    case EmitterKind::triangle:
    case EmitterKind::sphere: {
        const SurfacePoint point = sample_surface(world.geometry, *emitter, position[1], position[2]);
        const Vec3 w = glm::normalize(
            Frame(point.normal).to_world(sample_cosine_hemisphere(direction[0], direction[1])));
        if (!sees_first(world.geometry, point, w)) return std::nullopt; // another emitter covers it
        const Rgb alpha(emitter->area / choice);
        // L cos / (p_A cos / pi)
        return SampledEmission{surface_vertex(world, point, alpha),
                               {leave_surface(point, w), w},
                               alpha * pi * emitted_radiance(world.scene, point, w)};
    }
    case EmitterKind::point: {
        const auto& light = world.scene.point_lights[emitter->index];
        const Vec3 w = sample_sphere(direction[0], direction[1]);
        return SampledEmission{source_vertex(*emitter, light.position, Rgb(1.0 / choice)),
                               {light.position, w, Ray{}.t_max, emitter->on},
                               light.intensity / (choice * pdf_solid_angle_sphere)};
    }
    case EmitterKind::spot: {
        const auto& light = world.scene.spot_lights[emitter->index];
        const Vec3 w = sample_cone(light, direction[0], direction[1]);
        return SampledEmission{source_vertex(*emitter, light.position, Rgb(1.0 / choice)),
                               {light.position, w, Ray{}.t_max, emitter->on},
                               spot_intensity(light, w) / (choice * pdf_solid_angle_cone(light))};
    }
    case EmitterKind::directional: {
        const auto& light = world.scene.directional_lights[emitter->index];
        const Rgb alpha(1.0 / choice);
        return SampledEmission{infinity_vertex(*emitter, -light.direction, alpha),
                               ray_from_infinity(world, -light.direction, direction[0], direction[1]),
                               alpha * light.irradiance * disc_area(world)};
    }
    case EmitterKind::environment: {
        const Vec3 towards = sample_sphere(position[1], position[2]);
        const Rgb alpha(1.0 / (choice * pdf_solid_angle_sphere));
        return SampledEmission{infinity_vertex(*emitter, towards, alpha),
                               ray_from_infinity(world, towards, direction[0], direction[1]),
                               alpha * *world.scene.environment * disc_area(world)};
    }
    }
    return std::nullopt;
}

double pdf_emission_position(const Vertex& y0)
{
    const double choice = y0.emitter->probability;
    switch (y0.emitter->kind) {
    case EmitterKind::triangle:
    case EmitterKind::sphere:
        return y0.emitter->area > 0.0 ? choice / y0.emitter->area : 0.0;
    case EmitterKind::environment:
        return choice * pdf_solid_angle_sphere;
    default:
        return choice;
    }
}

double pdf_area_emission_direction(const World& world, const Vertex& y0, const Vertex& y1)
{
    const Vec3 w = direction(y0, y1);
    if (y0.kind == Vertex::Kind::infinity) return cosine(y1, w) / disc_area(world);

    double pdf_solid_angle = pdf_solid_angle_sphere;
    if (y0.kind == Vertex::Kind::surface) {
        pdf_solid_angle = std::max(0.0, glm::dot(y0.point.normal, w)) * inverse_pi;
    } else if (y0.emitter->kind == EmitterKind::spot) {
        const auto& light = world.scene.spot_lights[y0.emitter->index];
        pdf_solid_angle =
            glm::dot(light.direction, w) > light.cos_cutoff ? pdf_solid_angle_cone(light) : 0.0;
    }
    const Vec3 d = y1.point.position - y0.point.position;
    return pdf_solid_angle * cosine(y1, w) / glm::dot(d, d);
}

Rgb emitted(const World& world, const Vertex& y0, const Vertex& y1)
{
    const scenes::Scene& scene = world.scene;
    const std::uint32_t index = y0.emitter->index;
    switch (y0.emitter->kind) {
    case EmitterKind::triangle:
    case EmitterKind::sphere:
        return emitted_radiance(scene, y0.point, direction(y0, y1));
    case EmitterKind::point:
        return scene.point_lights[index].intensity;
    case EmitterKind::spot:
        return spot_intensity(scene.spot_lights[index], direction(y0, y1));
    case EmitterKind::directional:
        return scene.directional_lights[index].irradiance;
    case EmitterKind::environment:
        return *scene.environment;
    }
    return Rgb(0.0);
}

} // namespace ref
