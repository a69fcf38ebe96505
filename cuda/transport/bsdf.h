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
template <class F>
struct MaterialOf {
    KindOf<F, MaterialKind> kind;
    F ior;                   // of glass
    F survival;              // probability that a walk goes on from here, after bounces_without_roulette
    Vec3Of<F> color;         // albedo, reflectance, or emitted radiance
    Vec3Of<F> transmittance; // of glass
};
using Material = MaterialOf<float>;

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
    // Below 1 even on a perfect mirror: every walk ends. Up to 0.999 the throughput does not grow. A
    // surface that absorbs nothing has less, because the longest walk takes memory
    // (most_light_vertices).
    const double survival = albedo < 1.0 ? std::min(0.999, albedo) : 0.95; // map: roulette
    result.survival = roulette ? static_cast<float>(survival) : 1.0f;
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
template <class F>
struct BsdfSampleOf {
    Vec3Of<F> wi_local;
    Vec3Of<F> value; // f |cos theta_i| / pdf: what the walk's throughput is multiplied with
    F pdf_fwd;       // of wi given wo
    F pdf_rev;       // of wo given wi
};
using BsdfSample = BsdfSampleOf<float>;

/// Whether the material scatters into a range of directions. Only such a vertex can be joined to one
/// that was sampled independently.
template <class F>
HD MaskOf<F> scatters(const MaterialOf<F>& material)
{
    return material.kind == MaterialKind::lambertian;
}

/// Bounces up to this one are never ended by roulette.
constexpr int bounces_without_roulette = 4;

/// Fraction that a dielectric boundary reflects; `cos_i` >= 0 on the side with index eta_i, eta = eta_i
/// / eta_t. Sets `cos_t`, 0 under total reflection. [Fresnel's equations; Born & Wolf 1999, sec. 1.5.2]
template <class F>
HD F fresnel(const F& cos_i, const F& eta, F& cos_t)
{
    // 1 - sin_t^2, from cos_i^2 <= 1: near grazing incidence nothing cancels that Snell's law does not
    // cancel itself.
    const F sin2_t = eta * eta * greater(F(0.0f), (1.0f - cos_i) * (1.0f + cos_i));
    const MaskOf<F> total = sin2_t >= 1.0f;
    cos_t = select(total, F(0.0f), square_root(1.0f - sin2_t));
    const F parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    const F perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    // map: fresnel
    return select(total, F(1.0f), 0.5f * (parallel * parallel + perpendicular * perpendicular));
}

/// Glass reflects with the probability of Fresnel's reflectance, else refracts.
template <class F>
HD BsdfSampleOf<F> sample_glass(const MaterialOf<F>& glass, const Vec3Of<F>& wo, const F& u_lobe,
                                Transport carried)
{
    const MaskOf<F> outside = wo.z > 0.0f;
    const F eta_i = select(outside, F(1.0f), glass.ior);
    const F eta_t = select(outside, glass.ior, F(1.0f));
    const F eta = eta_i / eta_t;
    F cos_t = 0.0f;
    const F reflected = fresnel(magnitude_of(wo.z), eta, cos_t);
    const F density = reflected * eta_i * eta_i * magnitude_of(wo.z);
    // Radiance is squeezed into a smaller solid angle on the denser side; power is not.
    const F scale = carried == Transport::radiance ? eta * eta : F(1.0f); // map: eta-squared
    const F refracted = 1.0f - reflected;
    return select(u_lobe < reflected, // map: bsdf-glass
                  BsdfSampleOf<F>{Vec3Of<F>(-wo.x, -wo.y, wo.z), glass.color, density, density},
                  BsdfSampleOf<F>{glm::normalize(Vec3Of<F>(-eta * wo.x, -eta * wo.y, // map: refraction
                                                           select(outside, -cos_t, cos_t))),
                                  // map: delta-lobe
                                  scale * glass.transmittance, refracted * eta_t * eta_t * cos_t,
                                  refracted * eta_i * eta_i * magnitude_of(wo.z)});
}

/// Draws wi given wo from the first three numbers of `u`. A value of zero means that the walk ends.
/// `specular`: whether the scene has mirrors or glass at all.
template <bool specular, class F>
HD BsdfSampleOf<F> sample_bsdf(const MaterialOf<F>& material, const Vec3Of<F>& wo,
                               const UniformsOf<F>& u, Transport carried)
{
    BsdfSampleOf<F> sample{wo, Vec3Of<F>(0.0f), F(0.0f), F(0.0f)};
    if (const MaskOf<F> here = material.kind == MaterialKind::lambertian; any(here)) {
        Vec3Of<F> wi = sample_cosine_hemisphere(u[0], u[1]);
        wi.z = select(wo.z < 0.0f, -wi.z, wi.z);
        sample = select(here,
                        BsdfSampleOf<F>{wi, material.color, magnitude_of(wi.z) * inverse_pi,
                                        magnitude_of(wo.z) * inverse_pi},
                        sample);
    }
    if constexpr (specular) {
        if (const MaskOf<F> here = material.kind == MaterialKind::mirror; any(here))
            sample = select(here,
                            // map: bsdf-mirror
                            BsdfSampleOf<F>{Vec3Of<F>(-wo.x, -wo.y, wo.z), material.color,
                                            magnitude_of(wo.z), magnitude_of(wo.z)},
                            sample);
        if (const MaskOf<F> here = material.kind == MaterialKind::glass; any(here))
            sample = select(here, sample_glass(material, wo, u[2], carried), sample);
    }
    return sample;
}

} // namespace fast
