#include "ref/transport/path_tracer.h"

#include "ref/transport/bsdf.h"
#include "ref/transport/visibility.h"

namespace ref {

namespace {

/// The state of the eye walk.
struct Walk {
    Ray ray;
    Vec3 from;      // the vertex that `ray` leaves, without offset
    Rgb throughput; // product of f |cos| / pdf over the bounces so far
    double pdf;     // of the ray's direction, per solid angle, with roulette included
    bool delta;     // the bounce was a delta: next-event estimation cannot sample its direction
};

/// The weight of the emission hit in a path that next-event estimation samples with density
/// `pdf_light`.
double weight_of_hit(const Walk& walk, double pdf_light)
{
    return walk.delta ? 1.0 : walk.pdf / (walk.pdf + pdf_light);
}

/// Next event: joins `point`, eye vertex j, to a point of an emitter.
void add_next_event(const World& world, const PathOptions& options, const SampleId& id, int j,
                    const SurfacePoint& point, const Frame& frame, const Vec3& wo_local,
                    const Walk& walk, std::vector<Contribution>& out)
{
    const auto& material = world.scene.materials[point.material];
    const auto light = sample_incident(world.emitters, point.position,
                                       uniforms(id, Event::next_event, static_cast<std::uint32_t>(j)));
    if (!light) return;
    const Vec3 wi_local = frame.to_local(light->wi);
    const Rgb f = evaluate_bsdf(material, wo_local, wi_local);
    if (f == Rgb(0.0) || !visible(world.geometry, point, *light)) return;

    const double pdf_hit =
        light->delta ? 0.0
                     : pdf_solid_angle_bsdf(material, wo_local, wi_local) *
                           survival_probability(material, j, options.roulette, options.roulette_from);
    const Rgb value = walk.throughput * f * std::abs(wi_local.z) * light->radiance / light->pdf;
    out.push_back({id.pixel, 1, j + 1, value, light->pdf / (light->pdf + pdf_hit)});
}

} // namespace

void trace_path(const World& world, const PathOptions& options, const SampleId& id,
                std::vector<Contribution>& out)
{
    const Ray first = camera_ray(world, id);
    // A directly seen emitter has no other strategy in this integrator, so its hit counts as a delta.
    Walk walk{first, first.origin, Rgb(1.0), 0.0, true};
    const images::Families& families = options.families;
    // The last vertex of a path of max_edges edges can only be an emission hit.
    const int last = families.emission_hit ? options.max_edges : options.max_edges - 1;

    for (int j = 1; j <= last; ++j) { // the edge from z_{j-1} to z_j
        const auto hit = intersect(world.geometry, walk.ray);
        if (!hit) {
            if (families.emission_hit && world.scene.environment)
                out.push_back({id.pixel, 0, j + 1, walk.throughput * *world.scene.environment,
                               weight_of_hit(walk, pdf_solid_angle_environment(world.emitters))});
            return;
        }
        const SurfacePoint point = surface_point(world.geometry, walk.ray, *hit);
        const Vec3 wo = -walk.ray.direction;
        const Rgb emitted = families.emission_hit ? emitted_radiance(world.scene, point, wo) : Rgb(0.0);
        if (emitted != Rgb(0.0))
            out.push_back(
                {id.pixel, 0, j + 1, walk.throughput * emitted,
                 weight_of_hit(walk, pdf_solid_angle_incident(world.emitters, walk.from, point))});
        if (j == options.max_edges) return;

        const auto& material = world.scene.materials[point.material];
        const Frame frame(point.normal);
        const Vec3 wo_local = frame.to_local(wo);
        if (families.next_event && !is_delta(material))
            add_next_event(world, options, id, j, point, frame, wo_local, walk, out);

        const Uniforms u = uniforms(id, Event::eye_bounce, static_cast<std::uint32_t>(j));
        const BsdfSample bounce = sample_bsdf(material, wo_local, u, Transport::radiance);
        const double survival =
            survival_probability(material, j, options.roulette, options.roulette_from);
        if (bounce.value == Rgb(0.0) || u[3] >= survival) return;

        const Vec3 wi = glm::normalize(frame.to_world(bounce.wi_local));
        walk = {{leave_surface(point, wi), wi},
                point.position,
                walk.throughput * bounce.value / survival,
                bounce.pdf_fwd * survival,
                bounce.delta};
    }
}

} // namespace ref
