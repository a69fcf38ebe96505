#pragma once

// How a sample becomes contributions: the light walk with its light image, and the eye walk with what is
// joined to it. Each contribution goes to a sink with its strategy (s, t), its value as if that strategy
// were the only one, and its weight.
//
//   strategy            found by
//   s = 0,  t >= 2      emission_hit: the eye walk meets a light source
//   s = 1,  t >= 2      next_event: an eye vertex and a fresh point of an emitter
//   s >= 1, t = 1       light_image: a light vertex seen from the eye; falls on any pixel
//   s >= 2, t >= 2      inner_connection: an eye vertex and a light vertex

#include "cuda/transport/watch.h"

namespace gpu {

/// What the light walk leaves for connections, of a y_{s-1} with s >= 2: only Lambertian surfaces can be
/// joined, so one cosine and a constant are all there is to their BSDF.
struct alignas(16) LightVertex {
    Vec3 position;
    float clearance; // negative where another surface is near (SurfaceContacts)
    Vec3 facing;     // unit normal on the side that the walk came from
    float onward;    // the walk's density per solid angle over the cosine, with the chance of going on
    Rgb alpha;       // BSDF included; black where the vertex can be joined to nothing
    float own;       // density of the walk at the vertex, per area
    float sums[4];   // RunningSums::without_last_factor for t = 2, 3, 4 and all above
};
static_assert(sizeof(LightVertex) == 64);

/// Where one sample keeps them: y_1, y_2, ... at distance `stride`, so that neighbouring samples write
/// to neighbouring places.
struct LightVertices {
    LightVertex* first;
    std::uint32_t stride;
    int capacity;
    HD LightVertex& operator[](int i) const { return first[static_cast<std::size_t>(i) * stride]; }
};

/// The weight of a strategy, given the sums over those of fewer and of more light vertices.
HD inline float weight(float S, float T)
{
    return 1.0f / (1.0f + S + T);
}

/// Chance that a walk goes on from its n-th bounce.
HD inline float chance_of(const Material& material, int n)
{
    return n > bounces_without_roulette ? material.survival : 1.0f;
}

/// Whether nothing stands between two places off their surfaces.
template <Needs needs>
HD bool visible(const SceneView<needs>& scene, const Vec3& from, const Vec3& to)
{
    return !any_hit(scene.geometry, {from, 1.0f, to - from});
}

/// The same by way of `middle`. The end of a segment may lie beyond a surface that is close over its
/// own; the beginning of a ray does not (clearance.h). So one goes from each place.
template <Needs needs>
SELDOM HD bool visible_by_halves(const SceneView<needs>& scene, const Vec3& a, const Vec3& b,
                                 const Vec3& middle)
{
    return visible(scene, a, middle) && visible(scene, b, middle);
}

/// t = 1: y_{s-1}, at `point`, is joined to the pinhole. `alpha`: its weight with what it sends to the
/// eye, cosine excluded. `inner`: the sum S without its last factor.
template <Needs needs, Integrator integrator, class Sink>
HD void light_image(const SceneView<needs>& scene, const PathOptions& options, int s,
                    const SurfacePoint& point, const Vec3& facing, float own, float inner,
                    const Rgb& alpha, Sink& sink)
{
    const Vec3 d = scene.camera.eye - point.position;
    const float distance2 = glm::dot(d, d);
    const float spread = 1.0f / distance2;
    const Vec3 w = d * std::sqrt(spread); // from the surface to the eye
    const float cosine = glm::dot(facing, w);
    std::uint32_t pixel = 0;
    if (!(cosine > 0.0f) || is_black(alpha) || !scene.camera.project(-w, pixel)) return;
    if (lies_on(scene, scene.eye_contacts, point.primitive)) return;
    if (s == 1 && !sees_first(scene, point, w)) return;
    if (!visible(
            scene, leave_to_side(point, facing),
            leave_end(scene, scene.camera.eye, scene.eye_contacts, -w, distance2 * std::sqrt(spread))))
        return;
    // The density of y_{s-1} for the eye walk; and the measurement, since W_e cos is that density.
    const float E = scene.camera.pdf_solid_angle(scene.camera.cosine(-w)) * cosine * spread;
    const float S = integrator == Integrator::light ? 0.0f : shared(options.heuristic, E / own) * inner;
    sink.splat(pixel, s, alpha * E, weight(S, 0.0f));
}

/// The environment's own light image, s = t = 1: its y_0 is the direction `towards`.
template <Needs needs, Integrator integrator, class Sink>
HD void light_image_of_infinity(const SceneView<needs>& scene, const PathOptions& options,
                                const Vec3& towards, float own, const Rgb& alpha, Sink& sink)
{
    std::uint32_t pixel = 0;
    if (!scene.camera.project(towards, pixel)) return;
    if (any_hit(scene.geometry, {leave_end(scene, scene.camera.eye, scene.eye_contacts, towards),
                                 std::numeric_limits<float>::infinity(), towards}))
        return;
    const float E = scene.camera.pdf_solid_angle(scene.camera.cosine(towards));
    const float S = integrator == Integrator::light ? 0.0f : shared(options.heuristic, E / own);
    sink.splat(pixel, 1, alpha * E, weight(S, 0.0f));
}

/// Walks from an emitter: sends the light image to `sink` and leaves in `kept` what eye vertices can be
/// joined to. Returns how many entries it left: y_1, y_2, ...
template <Needs needs, Integrator integrator, class Sink>
HD int light_subpath(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                     const LightVertices& kept, Sink& sink)
{
    if (scene.cumulative.empty()) return 0;
    const SampledEmission emission = sample_emission(scene, uniforms(id, Event::emission_position),
                                                     uniforms(id, Event::emission_direction));
    show_emission(sink, emission);
    const Emitter emitter = scene.emitters[emission.emitter];
    const float own = pdf_emission_position<needs>(emitter);
    const bool infinite = at_infinity<needs>(emitter);
    const bool hittable = can_be_hit<needs>(emitter);
    if (hittable && infinite)
        light_image_of_infinity<needs, integrator>(scene, options, emission.towards, own,
                                                   emitter.emitted / own, sink);
    else if (hittable)
        light_image<needs, integrator>(scene, options, 1, emission.end, emission.end.normal, own, 1.0f,
                                       emitter.emitted / own, sink);

    const bool on_surface = is_surface<needs>(emitter);
    // What leaves an emitting surface has that surface's cosine; at infinity there is none.
    const float cosine = on_surface ? emission.pdf_direction * pi : 1.0f;
    const Leg leg{emission.ray, emission.end.position, infinite, emission.pdf_direction,
                  hittable ? cosine / own : 0.0f};
    int count = 0;
    const int most_vertices = integrator == Integrator::bdpt
                                  ? glm::min(options.max_edges, kept.capacity + 1)
                                  : options.max_edges;
    walk(
        scene, options, id, Transport::power, leg, hittable, emission.alpha, most_vertices,
        [&](const WalkVertex& y) {
            show_vertex(sink, Transport::power, y);
            if constexpr (integrator == Integrator::bdpt) ++count;
            if (!scatters(y.material)) {
                if constexpr (integrator == Integrator::bdpt) kept[y.n - 1].alpha = Rgb(0.0f);
                return;
            }
            const int s = y.n + 1;
            const Rgb alpha = y.alpha * y.material.color * inverse_pi;
            // The eye walk would come this way by the cosine towards y_{s-2}.
            const auto without_last_factor = [&](int t) {
                return y.sums.without_last_factor(y.previous_joinable, y.cosine * inverse_pi,
                                                  y.material.survival, t, options.heuristic);
            };
            light_image<needs, integrator>(scene, options, s, y.point, y.facing, y.own,
                                           without_last_factor(1), alpha, sink);
            const std::uint32_t contacts = scene.surfaces[y.point.primitive].contacts;
            const bool is_near = scene.surface_contacts[contacts].near_count > 0;
            if constexpr (integrator == Integrator::bdpt)
                kept[y.n - 1] = {y.point.position,
                                 is_near ? -y.point.clearance : y.point.clearance,
                                 y.facing,
                                 chance_of(y.material, y.n) * inverse_pi,
                                 alpha,
                                 y.own,
                                 {without_last_factor(2), without_last_factor(3), without_last_factor(4),
                                  without_last_factor(5)}};
        },
        [&](const Leg& last, int, const Rgb&, bool, const RunningSums&) {
            show_miss(sink, Transport::power, last);
        });
    return count;
}

/// An eye vertex z_{t-1} that can be joined.
struct EyeVertex {
    int t;
    SurfacePoint point;
    Vec3 facing;
    Rgb alpha;    // BSDF included
    float onward; // as in LightVertex
    float own;
    float sums[5]; // RunningSums::without_last_factor for s = 1, 2, 3, 4 and all above
};

/// s = 1: z_{t-1} is joined to a fresh point of an emitter.
template <Needs needs, Integrator integrator, class Sink>
HD void next_event(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                   const EyeVertex& z, Sink& sink)
{
    IncidentLight light{};
    const Uniforms u = uniforms(id, Event::next_event, static_cast<std::uint32_t>(z.t - 1));
    if (!sample_incident(scene, z.point.position, u, light)) return;
    const float cosine = glm::dot(z.facing, light.wi);
    const Rgb value = z.alpha * cosine * light.alpha;
    if (!(cosine > 0.0f) || is_black(value)) return;
    const Vec3 from = leave_to_side(z.point, z.facing);
    const Emitter& emitter = scene.emitters[light.emitter];
    if (is_surface<needs>(emitter)
            ? !sees_first(scene, light.end, -light.wi)
            : lies_on(scene, scene.lights[light.emitter].contacts, z.point.primitive))
        return;
    if (at_infinity<needs>(emitter)
            ? any_hit(scene.geometry, {from, std::numeric_limits<float>::infinity(), light.wi})
            : !visible(scene, from, light.target))
        return;
    const float E = can_be_hit<needs>(emitter) ? z.onward * cosine * light.geometry : 0.0f;
    if constexpr (integrator == Integrator::path) {
        sink.add(1, z.t, value, weight(E / light.pdf_position, 0.0f));
    } else {
        const float L = light.pdf_direction * light.spread * cosine;
        sink.add(1, z.t, value,
                 weight(shared(options.heuristic, E / light.pdf_position),
                        shared(options.heuristic, L / z.own) * z.sums[0]));
    }
}

/// s >= 2: z_{t-1} is joined to y_{s-1}.
template <Needs needs, class Sink>
HD void inner_connection(const SceneView<needs>& scene, const PathOptions& options, int s,
                         const LightVertex& y, const EyeVertex& z, Sink& sink)
{
    if (is_black(y.alpha)) return; // then nothing else of y was ever written
    const Vec3 d = y.position - z.point.position;
    const float distance2 = glm::dot(d, d);
    const float spread = 1.0f / distance2;
    const float to_unit = std::sqrt(spread);
    const float cosine_z = glm::dot(z.facing, d) * to_unit;
    const float cosine_y = -glm::dot(y.facing, d) * to_unit;
    if (!(cosine_z > 0.0f && cosine_y > 0.0f)) return;
    const float G = cosine_z * cosine_y * spread;
    const Rgb value = z.alpha * G * y.alpha;
    if (is_black(value)) return;
    const Vec3 from = leave_to_side(z.point, z.facing);
    if (y.clearance < 0.0f) {
        if (!visible_by_halves(scene, from, y.position - y.clearance * y.facing,
                               z.point.position + 0.5f * d))
            return;
    } else {
        const float clearance = y.clearance + clearance_per_length * distance2 * to_unit;
        if (!visible(scene, from, y.position + clearance * y.facing)) return;
    }
    const int by_t = glm::min(z.t, 5) - 2;
    const int by_s = glm::min(s, 5) - 1;
    sink.add(s, z.t, value,
             weight(shared(options.heuristic, z.onward * G / y.own) * y.sums[by_t],
                    shared(options.heuristic, y.onward * G / z.own) * z.sums[by_s]));
}

/// Walks from the eye and joins every vertex to what there is: `kept` holds `count` vertices of the
/// light walk.
template <Needs needs, Integrator integrator, class Sink>
HD void eye_subpath(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                    const LightVertices& kept, int count, Sink& sink)
{
    constexpr bool path = integrator == Integrator::path;
    const std::uint32_t column = id.pixel % scene.camera.width;
    const std::uint32_t row = id.pixel / scene.camera.width;
    const Uniforms u = uniforms(id, Event::camera);
    const Vec3 direction =
        scene.camera.direction(static_cast<float>(column) + u[0], static_cast<float>(row) + u[1]);
    const Leg leg{{leave_end(scene, scene.camera.eye, scene.eye_contacts, direction),
                   std::numeric_limits<float>::infinity(), direction},
                  scene.camera.eye,
                  false,
                  scene.camera.pdf_solid_angle(scene.camera.cosine(direction)),
                  0.0f};

    // s = 0, of a vertex on `emitter`; `own`, `other` as in mis_weight.h.
    const auto emission_hit = [&](const Emitter& emitter, int n, const Rgb& alpha, float own,
                                  float other, bool previous_joinable, const RunningSums& sums) {
        const float L = pdf_emission_position<needs>(emitter);
        float T = 0.0f;
        if constexpr (path)
            T = previous_joinable && n > 1 ? L / own : 0.0f;
        else
            T = shared(options.heuristic, L / own) *
                sums.without_last_factor(previous_joinable, other, 1.0f, 0, options.heuristic);
        sink.add(0, n + 1, alpha * emitter.emitted, weight(0.0f, T));
    };

    walk(
        scene, options, id, Transport::radiance, leg, false, Rgb(1.0f), options.max_edges + 1,
        [&](const WalkVertex& v) {
            show_vertex(sink, Transport::radiance, v);
            if (v.emitter != no_emitter && glm::dot(v.point.normal, v.wo) > 0.0f)
                emission_hit(scene.emitters[v.emitter], v.n, v.alpha, v.own, v.cosine * inverse_pi,
                             v.previous_joinable, v.sums);
            if (!scatters(v.material) || v.n == options.max_edges || scene.cumulative.empty()) return;
            EyeVertex z{v.n + 1,
                        v.point,
                        v.facing,
                        v.alpha * v.material.color * inverse_pi,
                        chance_of(v.material, v.n) * inverse_pi,
                        v.own,
                        {}};
            if constexpr (!path)
                for (int s = 1; s <= 5; ++s)
                    z.sums[s - 1] =
                        v.sums.without_last_factor(v.previous_joinable, v.cosine * inverse_pi,
                                                   v.material.survival, s, options.heuristic);
            next_event<needs, integrator>(scene, options, id, z, sink);
            if constexpr (!path)
                for (int s = 2; s <= count + 1 && s + v.n <= options.max_edges; ++s)
                    inner_connection(scene, options, s, kept[s - 2], z, sink);
        },
        [&](const Leg& last, int n, const Rgb& alpha, bool previous_joinable, const RunningSums& sums) {
            show_miss(sink, Transport::radiance, last);
            if (scene.has_environment)
                emission_hit(scene.emitters.back(), n, alpha, last.pdf, pdf_area_disc(scene),
                             previous_joinable, sums);
        });
}

/// One sample: everything that `id` contributes to any pixel.
template <Needs needs, Integrator integrator, class Sink>
HD void trace_sample(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                     const LightVertices& kept, Sink& sink)
{
    int count = 0;
    if constexpr (integrator != Integrator::path)
        count = light_subpath<needs, integrator>(scene, options, id, kept, sink);
    if constexpr (integrator != Integrator::light)
        eye_subpath<needs, integrator>(scene, options, id, kept, count, sink);
}

} // namespace gpu
