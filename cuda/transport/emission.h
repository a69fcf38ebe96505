#pragma once

// The start of a light walk: an emitter, its vertex y_0, and the ray that leaves it.

#include "cuda/transport/emitter.h"

namespace fast {

/// The start of a light walk.
struct SampledEmission {
    std::uint32_t emitter;
    Ray ray;             // from y_0, or from far outside, into the scene
    Rgb alpha;           // weight of the vertex that the ray will find
    float pdf_direction; // of the ray, in the measure of the emitter (emitter.h)
    SurfacePoint end;    // y_0, of a surface; of a point or spot light the position alone
    Vec3 towards;        // of one at infinity: the unit direction from the scene to it
};

/// Draws an emitter and a point of it by the first three numbers of `position`, a direction by the first
/// two of `direction`. An emitter at infinity first draws its direction, then a point of a disc that
/// covers the scene.
template <Needs needs>
HD SampledEmission sample_emission(const SceneView<needs>& scene, const Uniforms& position,
                                   const Uniforms& direction)
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    SampledEmission emission{};
    emission.emitter = choose_emitter(scene, position[0]);
    const Emitter& emitter = scene.emitters[emission.emitter];
    if (is_surface<needs>(emitter)) {
        emission.end = sample_surface(scene, emitter, position[1], position[2], true);
        const Vec3 w_local = sample_cosine_hemisphere(direction[0], direction[1]);
        const Vec3 w = glm::normalize(Frame(emission.end.normal).to_world(w_local));
        emission.ray = {leave_surface(emission.end, w), infinity, w};
        emission.pdf_direction = glm::max(0.0f, glm::dot(emission.end.normal, w)) * inverse_pi;
        // L cos / (p_A cos / pi); none where another emitter covers this one
        if (sees_first(scene, emission.end, w, true))
            emission.alpha = emitter.emitted * (pi * emitter.area / emitter.probability);
        return emission;
    }
    if constexpr (needs.other_lights) {
        const Light& light = scene.lights[emission.emitter];
        if (at_infinity<needs>(emitter)) {
            emission.towards = sample_towards(emitter, light, position[1], position[2]);
            const Frame frame(emission.towards);
            Vec3 disc(0.0f, 0.0f, 2.0f);
            on_circle(std::sqrt(direction[0]), direction[1], disc.x, disc.y);
            emission.ray = {scene.radius * frame.to_world(disc), infinity, -emission.towards};
            emission.pdf_direction = pdf_area_disc(scene);
        } else {
            SourceDirection drawn{};
            const Vec3 w = sample_source_direction(emitter, light, direction[0], direction[1], drawn);
            emission.pdf_direction = drawn.pdf_solid_angle;
            emission.alpha = emitter.emitted * drawn.falloff;
            emission.end.position = light.position;
            emission.ray = {leave_end(scene, light.position, light.contacts, w), infinity, w};
        }
        emission.alpha = (at_infinity<needs>(emitter) ? emitter.emitted : emission.alpha) /
                         (pdf_emission_position<needs>(emitter) * emission.pdf_direction);
    }
    return emission;
}

} // namespace fast
