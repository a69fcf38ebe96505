#pragma once

// The start of a light walk: an emitter, its vertex y_0, and the ray that leaves it.

#include "cuda/transport/emitter.h"

namespace fast {

/// The start of a light walk.
template <class F>
struct SampledEmissionOf {
    WordOf<F> emitter;
    RayOf<F> ray;          // from y_0, or from far outside, into the scene
    Vec3Of<F> alpha;       // weight of the vertex that the ray will find
    F pdf_direction;       // of the ray, in the measure of the emitter (emitter.h)
    SurfacePointOf<F> end; // y_0, of a surface; of a point or spot light the position alone
    Vec3Of<F> towards;     // of one at infinity: the unit direction from the scene to it
};
using SampledEmission = SampledEmissionOf<float>;

/// Sets the members of `emission` for an emitter that is a surface.
template <Needs needs, class F>
HD void emission_of_surface(const SceneView<needs>& scene, const EmitterOf<F>& emitter,
                            const UniformsOf<F>& position, const UniformsOf<F>& direction,
                            const MaskOf<F>& active, SampledEmissionOf<F>& emission)
{
    emission.end = sample_surface(scene, emitter, position[1], position[2], active);
    const Vec3Of<F> w_local = sample_cosine_hemisphere(direction[0], direction[1]);
    const Vec3Of<F> w = glm::normalize(FrameOf<F>(emission.end.normal).to_world(w_local));
    emission.ray = {leave_surface(emission.end, w), F(std::numeric_limits<float>::infinity()), w};
    // map: density-y1
    emission.pdf_direction = greater(F(0.0f), glm::dot(emission.end.normal, w)) * inverse_pi;
    // L cos / (p_A cos / pi); none where another emitter covers this one
    emission.alpha =
        select(sees_first(scene, emission.end, w, active),
               // map: emission-surface
               emitter.emitted * (pi * emitter.area / emitter.probability), Vec3Of<F>(0.0f));
}

/// The same for another one.
template <Needs needs>
HD void emission_of_others(const SceneView<needs>& scene, const Emitter& emitter,
                           const Uniforms& position, const Uniforms& direction,
                           SampledEmission& emission)
{
    const Light& light = scene.lights[emission.emitter];
    if (at_infinity<needs>(emitter)) {
        emission.towards = sample_towards(emitter, light, position[1], position[2]);
        const Frame frame(emission.towards);
        Vec3 disc(0.0f, 0.0f, 2.0f);
        on_circle(std::sqrt(direction[0]), direction[1], disc.x, disc.y);
        emission.ray = {scene.radius * frame.to_world(disc), std::numeric_limits<float>::infinity(),
                        -emission.towards};
        emission.pdf_direction = pdf_area_disc(scene);
    } else {
        SourceDirection drawn{};
        const Vec3 w = sample_source_direction(emitter, light, direction[0], direction[1], drawn);
        emission.pdf_direction = drawn.pdf_solid_angle;
        emission.alpha = emitter.emitted * drawn.falloff;
        emission.end.position = light.position;
        emission.ray = {leave_end(scene, light.position, light.contacts, w),
                        std::numeric_limits<float>::infinity(), w};
    }
    emission.alpha = (at_infinity<needs>(emitter) ? emitter.emitted : emission.alpha) /
                     (pdf_emission_position<needs>(emitter) * emission.pdf_direction);
}

/// Draws an emitter and a point of it by the first three numbers of `position`, a direction by the first
/// two of `direction`. An emitter at infinity first draws its direction, then a point of a disc that
/// covers the scene.
template <Needs needs, class F>
HD SampledEmissionOf<F> sample_emission(const SceneView<needs>& scene, const UniformsOf<F>& position,
                                        const UniformsOf<F>& direction, const MaskOf<F>& active)
{
    SampledEmissionOf<F> emission{};
    emission.emitter = choose_emitter(scene, position[0]);
    const EmitterOf<F>& emitter = at(scene.emitters, emission.emitter);
    const MaskOf<F> surface = active && is_surface<needs>(emitter);
    if (any(surface)) emission_of_surface(scene, emitter, position, direction, surface, emission);
    if constexpr (needs.other_lights)
        one_by_one(active && !surface, [&](auto lane) {
            SampledEmission one = lane_of(emission, lane);
            emission_of_others(scene, lane_of(emitter, lane), lane_of(position, lane),
                               lane_of(direction, lane), one);
            put_lane(emission, lane, one);
        });
    return emission;
}

} // namespace fast
