#pragma once

// The two walks of bidirectional path tracing [Veach 1997, sec. 10.2]: v_0, v_1, ... from an emitter
// or from the eye. They differ in how they start (light_subpath.h, eye_subpath.h) and in their
// weights. The bounces are one function, which passes every vertex to a visitor and stores none.

#include "cuda/transport/contacts.h"
#include "cuda/transport/mis_weight.h"
#include "cuda/transport/random.h"

namespace fast {

/// The options of an integrator.
struct PathOptions {
    std::uint64_t seed;
    std::int32_t max_edges; // of a path, the camera's included; at least 1
    Heuristic heuristic;    // of Integrator::bdpt; path tracing always uses the balance heuristic
};

/// The step from one vertex to the next.
template <class F>
struct LegOf {
    RayOf<F> ray;
    Vec3Of<F> from;          // the vertex that the ray leaves, unless at infinity
    MaskOf<F> from_infinity; // then the distance does not matter
    F pdf_direction;         // of the ray, roulette included: per solid angle (for a
                             // delta lobe as in BsdfSample); from infinity per area across the ray
    F cosine_over_pdf;       // cosine at the start vertex over pdf_fwd there (mis_weight.h); 0 if
                             // the other walk cannot reach that vertex
};
using Leg = LegOf<float>;

/// The surface that a leg leads to, seen from there.
template <class F>
struct MetSurfaceOf {
    SurfacePointOf<F> point;
    Vec3Of<F> wo;       // unit, against the ray
    Vec3Of<F> wo_local; // in the frame of the normal
    Vec3Of<F> facing;   // the normal on the side of wo
    F cosine;           // of wo and `facing`
    MaterialOf<F> material;
    WordOf<F> emitter; // or no_emitter
    F inverse_distance2;
    F pdf_area; // the density with which the walk samples the point; 0 in the plane of the surface
};

/// A vertex v_n of a walk on a surface.
template <class F>
struct WalkVertexOf {
    SurfacePointOf<F> point;
    Vec3Of<F> wo;     // unit, to v_{n-1}
    Vec3Of<F> facing; // the normal on the side of wo
    F cosine;         // of wo and `facing`
    MaterialOf<F> material;
    WordOf<F> emitter; // or no_emitter
    int n;
    Vec3Of<F> alpha;             // weight of the walk [Veach 1997, sec. 10.2]: f |cos| / p so far
    MaskOf<F> previous_joinable; // v_{n-1} allows a join to v_n
    F pdf_area;                  // of v_n in this walk, given v_{n-1} and v_{n-2}; > 0
    RunningSumsOf<F> sums;

    /// B_n of docs/cuda-bdpt.md, equation (4), where this vertex is joined to a walk of
    /// `other_vertices`. Only for Lambertian surfaces.
    [[nodiscard]] HD F bracket(int other_vertices, Heuristic heuristic) const
    {
        return sums.bracket(previous_joinable, pdf_rev_solid_angle(), material.survival, other_vertices,
                            heuristic);
    }
    /// The density with which a walk from the other end goes on along wo, without roulette: for the
    /// reflection of a Lambertian surface, and for emission.
    [[nodiscard]] HD F pdf_rev_solid_angle() const { return cosine * inverse_pi; }
};
using WalkVertex = WalkVertexOf<float>;

/// The probability that a walk goes on from its n-th bounce.
template <class F>
HD F chance_of(const MaterialOf<F>& material, int n)
{
    return n > bounces_without_roulette ? material.survival : F(1.0f);
}

/// The surface at `hit` of the leg's ray, where `active`. Elsewhere the hit must name some primitive.
template <Needs needs, class F>
HD MetSurfaceOf<F> meet_surface(const SceneView<needs>& scene, const LegOf<F>& leg, HitOf<F> hit,
                                const MaskOf<F>& active)
{
    MetSurfaceOf<F> met;
    hit = first_of_coincident<needs, F>(scene, leg.ray, hit, active);
    met.point = surface_point<needs, F>(scene, leg.ray, hit);
    const SurfaceOf<F>& surface = at(scene.surfaces, met.point.primitive);
    met.emitter = surface.emitter;
    met.material = at(scene.materials, surface.material);
    met.wo = -leg.ray.direction;
    met.wo_local = FrameOf<F>(met.point.normal).to_local(met.wo);
    met.facing = select(met.wo_local.z < 0.0f, -met.point.normal, met.point.normal);
    met.cosine = magnitude_of(met.wo_local.z);
    const Vec3Of<F> d = met.point.position - leg.from;
    met.inverse_distance2 = select(leg.from_infinity, F(1.0f), 1.0f / glm::dot(d, d));
    // map: density-light, density-eye
    met.pdf_area = to_area(leg.pdf_direction, met.cosine, met.inverse_distance2);
    return met;
}

/// The n-th bounce of a walk, at `met`: draws the next leg by `u`. `pdf_rev`: see BsdfSample. Returns
/// where roulette lets the walk go on. Sets `leg`, and multiplies `alpha`.
template <Needs needs, class F>
HD MaskOf<F> bounce(const MetSurfaceOf<F>& met, int n, const UniformsOf<F>& u, Transport carried,
                    LegOf<F>& leg, Vec3Of<F>& alpha, F& pdf_rev)
{
    const BsdfSampleOf<F> sample = sample_bsdf<needs.specular>(met.material, met.wo_local, u, carried);
    const F chance = chance_of(met.material, n);
    const Vec3Of<F> wi = glm::normalize(FrameOf<F>(met.point.normal).to_world(sample.wi_local));
    leg = {{leave_surface(met.point, wi), F(std::numeric_limits<float>::infinity()), wi},
           met.point.position,
           false,
           sample.pdf_fwd * chance,
           magnitude_of(sample.wi_local.z) / met.pdf_area};
    alpha *= sample.value / chance; // map: throughput
    pdf_rev = sample.pdf_rev;
    return u[3] < chance;
}

/// The data of v_{n-1} that the sums at v_n need: the arguments of RunningSums::advance.
template <class F>
struct LastBounceOf {
    MaskOf<F> joinable; // of the first leg: whether the other walk can reach v_0
    F pdf_rev;
    F survival;
};

/// Takes `sums` from v_{n-1} to v_n; `geometry_over_pdf` is that of v_{n-1}.
template <class F>
HD void carry_sums(RunningSumsOf<F>& sums, int n, const LastBounceOf<F>& last,
                   const F& geometry_over_pdf, Heuristic heuristic)
{
    if (n == 1)
        sums = RunningSumsOf<F>(last.joinable, geometry_over_pdf);
    else
        sums.advance(last.joinable, last.pdf_rev, last.survival, geometry_over_pdf, heuristic);
}

/// Follows `leg` and its bounces, at most to v_{most_vertices - 1}, and calls on_surface(vertex) for
/// every v_n, n >= 1. If an eye walk leaves the scene, calls on_miss(leg, n, alpha, previous_joinable,
/// sums) for the v_n at infinity. `alpha` is the weight of v_1. `start_can_be_hit`: whether the other
/// walk can reach v_0.
template <Needs needs, class OnSurface, class OnMiss>
HD void walk(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
             Transport carried, Leg leg, bool start_can_be_hit, Rgb alpha, int most_vertices,
             const OnSurface& on_surface, const OnMiss& on_miss)
{
    const Event event = carried == Transport::radiance ? Event::eye_bounce : Event::light_bounce;
    bool previous_joinable = true; // true for the eye, and for y_0 and the surface that it lights
    LastBounceOf<float> last{start_can_be_hit, 0.0f, 1.0f};
    RunningSums sums(false, 0.0f);
    for (int n = 1; n < most_vertices && !is_black(alpha); ++n) {
        const Hit hit = intersect(scene.geometry, leg.ray);
        if (hit.primitive == no_primitive) {
            carry_sums(sums, n, last, leg.cosine_over_pdf, options.heuristic);
            on_miss(leg, n, alpha, previous_joinable, sums);
            return;
        }
        const MetSurfaceOf<float> met = meet_surface<needs, float>(scene, leg, hit, true);
        if (!(met.pdf_area > 0.0f)) return; // in the plane of the surface: the density is 0
        carry_sums(sums, n, last, leg.cosine_over_pdf * met.inverse_distance2, options.heuristic);
        on_surface(WalkVertex{met.point, met.wo, met.facing, met.cosine, met.material, met.emitter, n,
                              alpha, previous_joinable, met.pdf_area, sums});
        if (n + 1 == most_vertices) return;

        const Uniforms u = uniforms(id, event, static_cast<std::uint32_t>(n));
        if (!bounce<needs, float>(met, n, u, carried, leg, alpha, last.pdf_rev)) return;
        last.joinable = previous_joinable && scatters(met.material);
        previous_joinable = scatters(met.material);
        last.survival = met.material.survival;
    }
}

} // namespace fast
