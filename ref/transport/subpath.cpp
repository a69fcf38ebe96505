#include "ref/transport/subpath.h"

#include "ref/transport/emission.h"

namespace ref {

namespace {

/// Follows `ray` and its bounces, and appends the vertices to `path`. `alpha` is the weight of the
/// first vertex found, without the BSDF there.
void walk(const World& world, const PathOptions& options, const SampleId& id, Transport carried, Ray ray,
          Rgb alpha, std::size_t max_vertices, std::vector<Vertex>& path)
{
    const Event event = carried == Transport::radiance ? Event::eye_bounce : Event::light_bounce;
    for (int bounce = 1; path.size() < max_vertices && alpha != Rgb(0.0); ++bounce) {
        const auto hit = intersect(world.geometry, ray);
        if (!hit) {
            if (carried == Transport::radiance && world.scene.environment)
                path.push_back(infinity_vertex(*world.emitters.environment(), ray.direction, alpha));
            return;
        }
        const SurfacePoint point = surface_point(world.geometry, ray, *hit);
        path.push_back(surface_vertex(world, point, alpha));

        const auto& material = world.scene.materials[point.material];
        const Frame frame(point.normal);
        const Uniforms u = uniforms(id, event, static_cast<std::uint32_t>(bounce));
        const BsdfSample sample = sample_bsdf(material, frame.to_local(-ray.direction), u, carried);
        const double survival =
            survival_probability(material, bounce, options.roulette, options.roulette_from);
        if (u[3] >= survival) return;
        const Vec3 wi = glm::normalize(frame.to_world(sample.wi_local));
        ray = {leave_surface(point, wi), wi};
        alpha *= sample.value / survival; // map: throughput
    }
}

} // namespace

std::vector<Vertex> eye_subpath(const World& world, const PathOptions& options, const SampleId& id,
                                std::size_t max_vertices)
{
    std::vector<Vertex> z = {eye_vertex(world)};
    walk(world, options, id, Transport::radiance, camera_ray(world, id), Rgb(1.0), max_vertices, z);
    return z;
}

std::vector<Vertex> light_subpath(const World& world, const PathOptions& options, const SampleId& id,
                                  std::size_t max_vertices)
{
    if (max_vertices == 0) return {};
    const auto emission = sample_emission(world, uniforms(id, Event::emission_position),
                                          uniforms(id, Event::emission_direction));
    if (!emission) return {};
    std::vector<Vertex> y = {emission->y0};
    walk(world, options, id, Transport::power, emission->ray, emission->alpha, max_vertices, y);
    return y;
}

} // namespace ref
