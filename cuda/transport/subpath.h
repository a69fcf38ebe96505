#pragma once

// The two walks of bidirectional path tracing [Veach 1997, sec. 10.2]: v_0, v_1, ... from an emitter or
// from the eye. They differ in how they start and in what they carry; the walking is one function, which
// shows every vertex to a visitor and keeps none.

#include "cuda/transport/emitter.h"
#include "cuda/transport/mis_weight.h"
#include "cuda/transport/random.h"

namespace gpu {

/// How paths are made.
struct PathOptions {
    std::uint64_t seed;
    std::int32_t max_edges; // of a path, the camera's included; at least 1
    Heuristic heuristic;    // of Integrator::bdpt; path tracing always balances
};

/// From one vertex to the next.
struct Leg {
    Ray ray;
    Vec3 from;             // the vertex it leaves, unless at infinity
    bool from_infinity;    // where distance does not count
    float pdf;             // of the ray, with the chance of having gone on: per solid angle; per area
                           // across it from infinity
    float cosine_over_own; // cosine at the vertex left over the density with which it was found; 0 if
                           // the other walk cannot come there
};

/// A surface that a walk has come to: its v_n.
struct WalkVertex {
    SurfacePoint point;
    Vec3 wo;      // unit, to v_{n-1}
    Vec3 facing;  // the normal on the side of wo
    float cosine; // of wo and `facing`
    Material material;
    std::uint32_t emitter; // or no_emitter
    int n;
    Rgb alpha;              // weight of the walk [Veach 1997, sec. 10.2]: f |cos| / p so far
    bool previous_joinable; // v_{n-1} can be joined, if this can
    float own;              // density of the walk at v_n, per area
    RunningSums sums;
};

/// Follows `leg` and what its bounces make of it, to v_{most_vertices - 1} at the farthest, and calls
/// on_surface(vertex) for every v_n, n >= 1. An eye walk that leaves the scene calls
/// on_miss(leg, n, alpha, previous_joinable, sums) for the v_n that it finds at infinity. `alpha` is the
/// weight of v_1. `other_can_start`: whether the other walk could come to v_0.
template <Needs needs, class OnSurface, class OnMiss>
HD void walk(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
             Transport carried, Leg leg, bool other_can_start, Rgb alpha, int most_vertices,
             const OnSurface& on_surface, const OnMiss& on_miss)
{
    const Event event = carried == Transport::radiance ? Event::eye_bounce : Event::light_bounce;
    bool previous_joinable = true; // the eye; and y_0 to what it shines on
    bool joinable = other_can_start;
    float other = 0.0f;
    float survival = 1.0f;
    RunningSums sums(false, 0.0f, 0.0f);
    for (int n = 1; n < most_vertices && !is_black(alpha); ++n) {
        const auto carry_sums = [&](float back, float own) {
            if (n == 1)
                sums = RunningSums(joinable, back, own);
            else
                sums.advance(joinable, other, survival, back, own, options.heuristic);
        };
        Hit hit = closest_hit(scene.geometry, leg.ray);
        if (hit.primitive == no_primitive) {
            carry_sums(leg.cosine_over_own, leg.pdf);
            on_miss(leg, n, alpha, previous_joinable, sums);
            return;
        }
        hit = first_of_coincident(scene, leg.ray, hit);
        const SurfacePoint point = surface_point(scene, leg.ray, hit);
        const Surface surface = scene.surfaces[point.primitive];
        const Material material = scene.materials[surface.material];
        const Frame frame(point.normal);
        const Vec3 wo = -leg.ray.direction;
        const Vec3 wo_local = frame.to_local(wo);
        const float cosine = std::abs(wo_local.z);

        // [Veach 1997, eq. 8.10]
        const Vec3 d = point.position - leg.from;
        const float spread = leg.from_infinity ? 1.0f : 1.0f / glm::dot(d, d);
        const float own = leg.pdf * cosine * spread;
        if (!(own > 0.0f)) return; // in the very plane of the surface: no path of any density
        carry_sums(leg.cosine_over_own * spread, own);
        on_surface(WalkVertex{point, wo, wo_local.z < 0.0f ? -point.normal : point.normal, cosine,
                              material, surface.emitter, n, alpha, previous_joinable, own, sums});
        if (n + 1 == most_vertices) return;

        const Uniforms u = uniforms(id, event, static_cast<std::uint32_t>(n));
        const BsdfSample sample = sample_bsdf<needs.specular>(material, wo_local, u, carried);
        survival = material.survival;
        const float chance = n > bounces_without_roulette ? survival : 1.0f;
        if (u[3] >= chance) return;
        const Vec3 wi = glm::normalize(frame.to_world(sample.wi_local));
        constexpr float infinity = std::numeric_limits<float>::infinity();
        leg = {{leave_surface(point, wi), infinity, wi},
               point.position,
               false,
               sample.pdf_fwd * chance,
               std::abs(sample.wi_local.z) / own};
        alpha *= sample.value / chance;
        joinable = previous_joinable && scatters(material);
        previous_joinable = scatters(material);
        other = sample.pdf_rev;
    }
}

} // namespace gpu
