#pragma once

// Reflection and refraction at a surface. Directions are unit vectors of the local frame, z = geometric
// normal, and point away from the surface: wo to the previous vertex of the walk, wi to the next.

#include "ref/transport/random.h"
#include "ref/transport/sampling.h"
#include "scenes/scene.h"

#include <variant>

namespace ref {

/// The quantity that a walk transports: the eye walk radiance, the light walk power. Only refraction
/// treats them differently [Veach 1997, sec. 5.2].
enum class Transport { radiance, power };

/// The outcome of sampling a BSDF for `wi`.
struct BsdfSample {
    Vec3 wi_local;
    Rgb value;      // f |cos theta_i| / pdf: what the walk's throughput is multiplied with
    double pdf_fwd; // of wi given wo, per solid angle; of choosing the lobe if `delta`
    double pdf_rev; // of wo given wi, likewise
    bool delta;     // the direction was certain once the lobe was chosen
};

/// Whether the material scatters into single directions only, or not at all (an emitter's surface). Such
/// a vertex cannot be joined to another one.
inline bool is_delta(const scenes::Material& material)
{
    return !std::holds_alternative<scenes::Lambertian>(material);
}

/// Fraction of unpolarised light that a dielectric boundary reflects; `cos_i` >= 0 on the side with
/// index `eta_i`. Sets `cos_t` to the cosine of refraction, 0 under total reflection.
/// [Fresnel's equations; Born & Wolf 1999, sec. 1.5.2]
inline double fresnel(double cos_i, double eta_i, double eta_t, double& cos_t)
{
    const double sin_t = eta_i / eta_t * std::sqrt(std::max(0.0, 1.0 - cos_i * cos_i)); // Snell
    cos_t = 0.0;
    if (sin_t >= 1.0) return 1.0;
    cos_t = std::sqrt(1.0 - sin_t * sin_t);
    const double parallel = (eta_t * cos_i - eta_i * cos_t) / (eta_t * cos_i + eta_i * cos_t);
    const double perpendicular = (eta_i * cos_i - eta_t * cos_t) / (eta_i * cos_i + eta_t * cos_t);
    return (parallel * parallel + perpendicular * perpendicular) / 2.0; // map: fresnel
}

/// The BSDF f(wo, wi) in sr^-1, without its delta lobes.
inline Rgb evaluate_bsdf(const scenes::Material& material, const Vec3& wo_local, const Vec3& wi_local)
{
    const auto* lambertian = std::get_if<scenes::Lambertian>(&material);
    if (lambertian == nullptr || wo_local.z * wi_local.z <= 0.0) return Rgb(0.0);
    return lambertian->albedo * inverse_pi; // map: bsdf-lambertian
}

/// The density with which `sample_bsdf` picks `wi` given `wo`, per solid angle, without delta lobes.
inline double pdf_solid_angle_bsdf(const scenes::Material& material, const Vec3& wo_local,
                                   const Vec3& wi_local)
{
    if (is_delta(material) || wo_local.z * wi_local.z <= 0.0) return 0.0;
    return std::abs(wi_local.z) * inverse_pi;
}

/// A Lambertian surface: cosine-distributed on the side of wo. f cos / pdf is just the albedo.
inline BsdfSample sample_bsdf(const scenes::Lambertian& lambertian, const Vec3& wo, const Uniforms& u,
                              Transport /*carried*/)
{
    Vec3 wi = sample_cosine_hemisphere(u[0], u[1]);
    if (wo.z < 0.0) wi.z = -wi.z;
    return {wi, lambertian.albedo, std::abs(wi.z) * inverse_pi, std::abs(wo.z) * inverse_pi, false};
}

inline BsdfSample sample_bsdf(const scenes::Mirror& mirror, const Vec3& wo, const Uniforms& /*u*/,
                              Transport /*carried*/)
{
    return {Vec3(-wo.x, -wo.y, wo.z), mirror.reflectance, 1.0, 1.0, true}; // map: bsdf-mirror
}

/// Glass: reflects with the probability of Fresnel's reflectance, else refracts.
inline BsdfSample sample_bsdf(const scenes::Glass& glass, const Vec3& wo, const Uniforms& u,
                              Transport carried)
{
    const bool outside = wo.z > 0.0;
    const double eta_i = outside ? 1.0 : glass.ior;
    const double eta_t = outside ? glass.ior : 1.0;
    double cos_t = 0.0;
    const double reflected = fresnel(std::abs(wo.z), eta_i, eta_t, cos_t);
    if (u[2] < reflected) // map: bsdf-glass
        return {Vec3(-wo.x, -wo.y, wo.z), glass.reflectance, reflected, reflected, true};

    const double eta = eta_i / eta_t;
    const Vec3 wi(-eta * wo.x, -eta * wo.y, outside ? -cos_t : cos_t); // map: refraction
    // Radiance is squeezed into a smaller solid angle on the denser side; power is not.
    // map: eta-squared [Veach 1997, sec. 5.2]
    const double scale = carried == Transport::radiance ? eta * eta : 1.0;
    return {glm::normalize(wi), glass.transmittance * scale, 1.0 - reflected, 1.0 - reflected, true};
}

inline BsdfSample sample_bsdf(const scenes::Emission& /*emission*/, const Vec3& wo,
                              const Uniforms& /*u*/, Transport /*carried*/)
{
    return {wo, Rgb(0.0), 0.0, 0.0, true};
}

/// Draws wi given wo from the first three numbers of `u`. A value of zero means that the walk ends.
inline BsdfSample sample_bsdf(const scenes::Material& material, const Vec3& wo_local, const Uniforms& u,
                              Transport carried)
{
    return std::visit([&](const auto& m) { return sample_bsdf(m, wo_local, u, carried); }, material);
}

/// The factor of a delta lobe in the density of a path: the lobe's probability times eta^2 |cos| on the
/// side of wi. One of wo and wi must be the reflection or refraction of the other.
///
/// A delta lobe has no density per solid angle, but strategies that pass the vertex in opposite
/// directions can still be compared: walking one way turns a cone d omega_o into the cone d omega_i, and
/// eta^2 cos d omega is the same for both [Veach 1997, sec. 5.2; etendue]. Counting lobes per unit of
/// eta^2 cos d omega therefore makes densities of the two directions refer to the same set of paths.
/// Reflection has the same factor on both sides; refraction has not.
inline double density_of_delta_lobe(const scenes::Material& material, const Vec3& wo_local,
                                    const Vec3& wi_local)
{
    const auto* glass = std::get_if<scenes::Glass>(&material);
    if (glass == nullptr)
        return std::holds_alternative<scenes::Mirror>(material) ? std::abs(wi_local.z) : 0.0;
    const bool outside = wo_local.z > 0.0;
    const double eta_i = outside ? 1.0 : glass->ior;
    const double eta_t = outside ? glass->ior : 1.0;
    double cos_t = 0.0;
    const double reflected = fresnel(std::abs(wo_local.z), eta_i, eta_t, cos_t);
    const bool is_reflection = wo_local.z * wi_local.z > 0.0;
    return is_reflection ? reflected * eta_i * eta_i * std::abs(wi_local.z) // map: delta-lobe
                         : (1.0 - reflected) * eta_t * eta_t * std::abs(wi_local.z);
}

/// The probability that a walk goes on from its `bounce`-th bounce (the first is 1): 1 without roulette,
/// and before bounce number `roulette_from`. It depends on the vertex alone and not on the walk that led
/// there, so that the density of a path can be told without knowing from which end it was walked. It is
/// the albedo, so that the throughput stays what it is, and below 1 even on a perfect mirror: every walk
/// ends. Where the albedo is between 0.999 and 1, the throughput of a walk that meets nothing else
/// grows, with infinite variance from sqrt(0.999) on (docs/extremes.md, axis albedo). A surface that
/// absorbs nothing, as of clear glass, has 0.95: such walks end by leaving it, long before that shows.
inline double survival_probability(const scenes::Material& material, int bounce, bool roulette,
                                   int roulette_from)
{
    if (!roulette || bounce < roulette_from) return 1.0;
    struct {
        double operator()(const scenes::Lambertian& m) const { return max_component(m.albedo); }
        double operator()(const scenes::Mirror& m) const { return max_component(m.reflectance); }
        double operator()(const scenes::Glass& m) const
        {
            return std::max(max_component(m.reflectance), max_component(m.transmittance));
        }
        double operator()(const scenes::Emission& /*m*/) const { return 0.0; }
    } albedo;
    const double value = std::visit(albedo, material);
    return value < 1.0 ? std::min(0.999, value) : 0.95; // map: roulette
}

} // namespace ref
