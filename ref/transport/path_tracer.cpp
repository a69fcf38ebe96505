#include "ref/transport/path_tracer.h"

#include "ref/transport/visibility.h"

namespace ref {

namespace {

/// The weight of the emission hit in a path that next-event estimation samples with density
/// `pdf_light`.
double weight_of_hit(const EyeWalk& walk, double pdf_light)
{
    return walk.delta ? 1.0 : walk.pdf / (walk.pdf + pdf_light); // map: weight-of-hit
}

} // namespace

EyeWalk first_edge(const World& world, const SampleId& id)
{
    const Ray first = camera_ray(world, id);
    // A directly seen emitter has no other strategy in this integrator, so its hit counts as a delta.
    return {first, first.origin, Rgb(1.0), 0.0, true};
}

double pdf_of_next_event(const World& world, const EyeWalk& walk, const SurfacePoint* point)
{
    return point == nullptr ? pdf_solid_angle_environment(world.emitters)
                            : pdf_solid_angle_incident(world.emitters, walk.from, *point);
}

std::optional<Contribution> environment_of_edge(const World& world, const SampleId& id, int j,
                                                const EyeWalk& walk)
{
    if (!world.scene.environment) return std::nullopt;
    return Contribution{id.pixel, 0, j + 1, walk.throughput * *world.scene.environment,
                        weight_of_hit(walk, pdf_of_next_event(world, walk, nullptr))};
}

std::optional<Contribution> emission_of_edge(const World& world, const SampleId& id, int j,
                                             const EyeWalk& walk, const SurfacePoint& point)
{
    const Rgb emitted = emitted_radiance(world.scene, point, -walk.ray.direction);
    if (emitted == Rgb(0.0)) return std::nullopt;
    return Contribution{id.pixel, 0, j + 1, walk.throughput * emitted, // map: emission-hit
                        weight_of_hit(walk, pdf_of_next_event(world, walk, &point))};
}

WalkVertex::WalkVertex(const World& world, const EyeWalk& walk, const SurfacePoint& hit)
    : point(hit), material(world.scene.materials[hit.material]), frame(hit.normal),
      wo_local(frame.to_local(-walk.ray.direction))
{}

double pdf_of_bounce(const PathOptions& options, int j, const WalkVertex& vertex, const Vec3& wi_local)
{
    return pdf_solid_angle_bsdf(vertex.material, vertex.wo_local, wi_local) *
           survival_probability(vertex.material, j, options.roulette, options.roulette_from);
}

std::optional<Contribution> next_event_of_vertex(const World& world, const PathOptions& options,
                                                 const SampleId& id, int j, const EyeWalk& walk,
                                                 const WalkVertex& vertex)
{
    if (is_delta(vertex.material)) return std::nullopt;
    const auto light = sample_incident(world.emitters, vertex.point.position,
                                       uniforms(id, Event::next_event, static_cast<std::uint32_t>(j)));
    if (!light) return std::nullopt;
    const Vec3 wi_local = vertex.frame.to_local(light->wi);
    const Rgb f = evaluate_bsdf(vertex.material, vertex.wo_local, wi_local);
    if (f == Rgb(0.0) || !visible(world.geometry, vertex.point, *light)) return std::nullopt;

    const double pdf_hit = light->delta ? 0.0 : pdf_of_bounce(options, j, vertex, wi_local);
    // map: next-event
    const Rgb value = walk.throughput * f * std::abs(wi_local.z) * light->radiance / light->pdf;
    // map: weight-of-event
    return Contribution{id.pixel, 1, j + 1, value, light->pdf / (light->pdf + pdf_hit)};
}

std::optional<EyeWalk> next_edge(const PathOptions& options, const SampleId& id, int j,
                                 const EyeWalk& walk, const WalkVertex& vertex)
{
    const Uniforms u = uniforms(id, Event::eye_bounce, static_cast<std::uint32_t>(j));
    const BsdfSample bounce = sample_bsdf(vertex.material, vertex.wo_local, u, Transport::radiance);
    const double survival =
        survival_probability(vertex.material, j, options.roulette, options.roulette_from);
    if (bounce.value == Rgb(0.0) || u[3] >= survival) return std::nullopt;

    const Vec3 wi = glm::normalize(vertex.frame.to_world(bounce.wi_local));
    return EyeWalk{{leave_surface(vertex.point, wi), wi},
                   vertex.point.position,
                   walk.throughput * bounce.value / survival, // map: throughput
                   bounce.pdf_fwd * survival,
                   bounce.delta};
}

int last_edge(const PathOptions& options)
{
    return options.families.emission_hit ? options.max_edges : options.max_edges - 1;
}

void trace_path(const World& world, const PathOptions& options, const SampleId& id,
                std::vector<Contribution>& out)
{
    const auto add = [&](const std::optional<Contribution>& c) {
        if (c) out.push_back(*c);
    };
    const images::Families& families = options.families;
    EyeWalk walk = first_edge(world, id);
    for (int j = 1; j <= last_edge(options); ++j) { // the edge from z_{j-1} to z_j
        const auto hit = intersect(world.geometry, walk.ray);
        if (!hit) {
            if (families.emission_hit) add(environment_of_edge(world, id, j, walk));
            return;
        }
        const SurfacePoint point = surface_point(world.geometry, walk.ray, *hit);
        if (families.emission_hit) add(emission_of_edge(world, id, j, walk, point));
        if (j == options.max_edges) return;

        const WalkVertex vertex(world, walk, point);
        if (families.next_event) add(next_event_of_vertex(world, options, id, j, walk, vertex));
        const auto next = next_edge(options, id, j, walk, vertex);
        if (!next) return;
        walk = *next;
    }
}

} // namespace ref
