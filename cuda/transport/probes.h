#pragma once

// Kernels that compute single formulas of transport. plumbline extremes compares their results with
// exact arithmetic.

#include "cuda/transport/bsdf.h"
#include "cuda/transport/camera.h"
#include "cuda/transport/contacts.h"
#include "cuda/transport/emitter.h"

namespace fast {

/// A direction (local frame) towards which a ray leaves the surface of glass backward.
struct GlassProbe {
    Material glass;
    Vec3 wo_local;
};
/// The share that is reflected, and the sample that refracts if one can.
struct ProbedGlass {
    float reflected;
    BsdfSample sample;
};

struct ProbeGlass {
    std::span<const GlassProbe> probes;
    std::span<ProbedGlass> found;

    HD void operator()(std::uint32_t i) const
    {
        const auto& [glass, wo] = probes[i];
        const bool outside = wo.z > 0.0f;
        float cos_t = 0.0f;
        const float reflected =
            fresnel(magnitude_of(wo.z), outside ? 1.0f / glass.ior : glass.ior, cos_t);
        // The largest number below 1 chooses refraction wherever there is any.
        found[i] = {reflected, sample_bsdf<true, float>(glass, wo, {{0.0f, 0.0f, 1.0f - 0x1p-24f, 0.0f}},
                                                        Transport::radiance)};
    }
};

/// A film point, in pixels from the top left corner, and a unit direction from the eye.
struct CameraProbe {
    Camera camera;
    float x, y;
    Vec3 w;
};
/// The direction through the film point; the pixel that shows w, if one does; and the density of w.
struct ProbedCamera {
    Vec3 direction;
    bool shown;
    std::uint32_t pixel;
    float pdf_solid_angle;
};

struct ProbeCamera {
    std::span<const CameraProbe> probes;
    std::span<ProbedCamera> found;

    HD void operator()(std::uint32_t i) const
    {
        const CameraProbe& probe = probes[i];
        ProbedCamera& result = found[i];
        result.direction = probe.camera.direction(probe.x, probe.y);
        result.pixel = 0;
        result.shown = probe.camera.project<float>(probe.w, result.pixel);
        result.pdf_solid_angle = probe.camera.pdf_solid_angle(probe.camera.cosine<float>(probe.w));
    }
};

/// A point of a triangle, by two of its barycentric coordinates.
struct PointProbe {
    std::uint32_t triangle;
    float b1, b2;
};

/// The red irradiance at each point from the one light of a scene, 0 in shadow: as next_event
/// (connect.h) computes it.
template <Needs needs>
struct ProbeIrradiance {
    SceneView<needs> scene;
    std::span<const PointProbe> probes;
    std::span<float> found;

    HD void operator()(std::uint32_t i) const
    {
        const PointProbe& probe = probes[i];
        const auto point = triangle_point<needs, float>(scene, probe.triangle, probe.b1, probe.b2);
        const auto light =
            sample_incident<needs, float>(scene, point.position, {{0.5f, 0.5f, 0.5f, 0.5f}}, true);
        const Vec3 origin = leave_to_side(point, point.normal);
        const bool lit = !occluded(scene.geometry, {origin, 1.0f, light.target - origin});
        found[i] = lit ? light.alpha.x * glm::dot(point.normal, light.wi) : 0.0f;
    }
};

} // namespace fast
