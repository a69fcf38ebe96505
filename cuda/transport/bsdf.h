#pragma once

// Reflection and refraction at a surface. All code of the fast path that is for one kind of material is
// here. Directions are unit vectors of the local frame, z = geometric normal, and point away from the
// surface: wo to the previous vertex of the walk, wi to the next.

#include "cuda/transport/random.h"
#include "cuda/transport/sampling.h"
#include "scenes/scene.h"

#include <algorithm>
#include <variant>

namespace fast {

enum class MaterialKind : std::uint32_t { lambertian, mirror, glass, emission };

/// A scenes::Material as floats. All kinds have the same members, because kernels read them from one
/// array.
struct Material {
    MaterialKind kind;
    float ior;         // of glass
    float survival;    // probability that a walk goes on from here, after bounces_without_roulette
    Rgb color;         // albedo, reflectance, or emitted radiance
    Rgb transmittance; // of glass
};

/// On the host: the material as floats. Without `roulette` every walk goes on.
inline Material material_of(const scenes::Material& source, bool roulette)
{
    Material result{};
    double albedo = 0;
    const auto largest = [](const scenes::Rgb& c) { return std::max({c.x, c.y, c.z}); };
    if (const auto* lambertian = std::get_if<scenes::Lambertian>(&source)) {
        result.kind = MaterialKind::lambertian;
        result.color = Rgb(lambertian->albedo);
        albedo = largest(lambertian->albedo);
    } else if (const auto* mirror = std::get_if<scenes::Mirror>(&source)) {
        result.kind = MaterialKind::mirror;
        result.color = Rgb(mirror->reflectance);
        albedo = largest(mirror->reflectance);
    } else if (const auto* glass = std::get_if<scenes::Glass>(&source)) {
        result.kind = MaterialKind::glass;
        result.color = Rgb(glass->reflectance);
        result.transmittance = Rgb(glass->transmittance);
        result.ior = static_cast<float>(glass->ior);
        albedo = std::max(largest(glass->reflectance), largest(glass->transmittance));
    } else {
        result.kind = MaterialKind::emission;
        result.color = Rgb(std::get<scenes::Emission>(source).radiance);
    }
    // Below 1 even on a perfect mirror: every walk ends.
    result.survival = roulette ? static_cast<float>(std::min(0.95, albedo)) : 1.0f;
    return result;
}

/// The quantity that a walk transports: the eye walk radiance, the light walk power [Veach 1997,
/// sec. 5.2].
enum class Transport { radiance, power };

/// The outcome of sampling a BSDF for `wi`.
///
/// Densities of a Lambertian surface are per solid angle. Those of a delta lobe are its probability
/// times eta^2 |cos| on the side where it ends: per unit of eta^2 cos d omega, in which both directions
/// of a path through the lobe can be compared [Veach 1997, sec. 5.2; docs/bdpt.md].
struct BsdfSample {
    Vec3 wi_local;
    Rgb value;     // f |cos theta_i| / pdf: what the walk's throughput is multiplied with
    float pdf_fwd; // of wi given wo
    float pdf_rev; // of wo given wi
};

/// Whether the material scatters into a range of directions. Only such a vertex can be joined to one
/// that was sampled independently.
HD inline bool scatters(const Material& material)
{
    return material.kind == MaterialKind::lambertian;
}

/// Bounces up to this one are never ended by roulette.
constexpr int bounces_without_roulette = 4;

/// Fraction that a dielectric boundary reflects; `cos_i` >= 0 on the side with index eta_i, eta = eta_i
/// / eta_t. Sets `cos_t`, 0 under total reflection. [Fresnel's equations; Born & Wolf 1999, sec. 1.5.2]
HD inline float fresnel(float cos_i, float eta, float& cos_t)
{
    // 1 - sin_t^2, from cos_i^2 <= 1: near grazing incidence nothing cancels that Snell's law does not
    // cancel itself.
    const float sin2_t = eta * eta * glm::max(0.0f, (1.0f - cos_i) * (1.0f + cos_i));
    cos_t = 0.0f;
    if (sin2_t >= 1.0f) return 1.0f;
    cos_t = std::sqrt(1.0f - sin2_t);
    const float parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const float perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Glass reflects with the probability of Fresnel's reflectance, else refracts.
HD inline BsdfSample sample_glass(const Material& glass, const Vec3& wo, float u_lobe, Transport carried)
{
    const bool outside = wo.z > 0.0f;
    const float eta_i = outside ? 1.0f : glass.ior;
    const float eta_t = outside ? glass.ior : 1.0f;
    const float eta = eta_i / eta_t;
    float cos_t = 0.0f;
    const float reflected = fresnel(std::abs(wo.z), eta, cos_t);
    if (u_lobe < reflected) {
        const float density = reflected * eta_i * eta_i * std::abs(wo.z);
        return {Vec3(-wo.x, -wo.y, wo.z), glass.color, density, density};
    }
    // Radiance is squeezed into a smaller solid angle on the denser side; power is not.
    const float scale = carried == Transport::radiance ? eta * eta : 1.0f;
    const float refracted = 1.0f - reflected;
    return {glm::normalize(Vec3(-eta * wo.x, -eta * wo.y, outside ? -cos_t : cos_t)),
            scale * glass.transmittance, refracted * eta_t * eta_t * cos_t,
            refracted * eta_i * eta_i * std::abs(wo.z)};
}

/// Draws wi given wo from the first three numbers of `u`. A value of zero means that the walk ends.
/// `specular`: whether the scene has mirrors or glass at all.
template <bool specular>
HD BsdfSample sample_bsdf(const Material& material, const Vec3& wo, const Uniforms& u, Transport carried)
{
    if (material.kind == MaterialKind::lambertian) {
        Vec3 wi = sample_cosine_hemisphere(u[0], u[1]);
        if (wo.z < 0.0f) wi.z = -wi.z;
        return {wi, material.color, std::abs(wi.z) * inverse_pi, std::abs(wo.z) * inverse_pi};
    }
    if constexpr (specular) {
        if (material.kind == MaterialKind::mirror)
            return {Vec3(-wo.x, -wo.y, wo.z), material.color, std::abs(wo.z), std::abs(wo.z)};
        if (material.kind == MaterialKind::glass) return sample_glass(material, wo, u[2], carried);
    }
    return {wo, Rgb(0.0f), 0.0f, 0.0f};
}

} // namespace fast
