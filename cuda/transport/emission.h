#pragma once

// How light walks begin: an emitter, its vertex y_0, and the ray that leaves it.

#include "cuda/transport/emitter.h"

namespace fast {

/// The beginning of a light walk.
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
        emission.end = sample_surface(scene, emitter, position[1], position[2]);
        const Vec3 w_local = sample_cosine_hemisphere(direction[0], direction[1]);
        const Vec3 w = glm::normalize(Frame(emission.end.normal).to_world(w_local));
        emission.ray = {leave_surface(emission.end, w), infinity, w};
        emission.pdf_direction = glm::max(0.0f, glm::dot(emission.end.normal, w)) * inverse_pi;
        // L cos / (p_A cos / pi); none where another emitter covers this one
        if (sees_first(scene, emission.end, w))
            emission.alpha = emitter.emitted * (pi * emitter.area / emitter.probability);
        return emission;
    }
    if constexpr (needs.other_lights) {
        const Light& light = scene.lights[emission.emitter];
        if (at_infinity<needs>(emitter)) {
            const bool everywhere = emitter.kind == EmitterKind::environment;
            emission.towards = everywhere ? sample_sphere(position[1], position[2]) : -light.direction;
            const Frame frame(emission.towards);
            Vec3 disc(0.0f, 0.0f, 2.0f);
            on_circle(std::sqrt(direction[0]), direction[1], disc.x, disc.y);
            emission.ray = {scene.radius * frame.to_world(disc), infinity, -emission.towards};
            emission.pdf_direction = pdf_area_disc(scene);
        } else {
            Vec3 w = sample_sphere(direction[0], direction[1]);
            emission.pdf_direction = pdf_solid_angle_sphere;
            emission.alpha = emitter.emitted;
            if (emitter.kind == EmitterKind::spot) {
                const float off_axis = direction[0] * light.versine_cutoff; // 1 - cos(theta)
                Vec3 w_local(0.0f, 0.0f, 1.0f - off_axis);
                on_circle(std::sqrt(off_axis * (2.0f - off_axis)), direction[1], w_local.x, w_local.y);
                w = glm::normalize(Frame(light.direction).to_world(w_local));
                emission.pdf_direction = pdf_solid_angle_cone(light);
                // Of the angle as drawn: what w rounds to may lie outside of the cone, and none of the
                // power may be lost by it.
                emission.alpha *= spot_falloff(light, off_axis);
            }
            emission.end.position = light.position;
            emission.ray = {leave_end(scene, light.position, light.contacts, w), infinity, w};
        }
        emission.alpha = (at_infinity<needs>(emitter) ? emitter.emitted : emission.alpha) /
                         (pdf_emission_position<needs>(emitter) * emission.pdf_direction);
    }
    return emission;
}

} // namespace fast
