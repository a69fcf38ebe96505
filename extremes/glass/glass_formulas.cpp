// The formulas that are compared: those of both wings, and usual ones in both formats.

#include "extremes/glass/glass_case.h"

#include "cuda/launch/probes.h"
#include "ref/transport/bsdf.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <span>

namespace extremes {

namespace {

GlassAnswer glass_of_reference(const GlassInput& input)
{
    const scenes::Glass glass{scenes::Rgb(1.0), scenes::Rgb(1.0), input.ior};
    const bool outside = input.wo_local.z > 0;
    double cos_t = 0;
    GlassAnswer answer{ref::fresnel(std::abs(input.wo_local.z), outside ? 1.0 : input.ior,
                                    outside ? input.ior : 1.0, cos_t)};
    const ref::BsdfSample sample =
        ref::sample_bsdf(glass, input.wo_local, {0, 0, 1.0 - 0x1p-53, 0}, ref::Transport::radiance);
    answer.refracts = sample.wi_local.z * input.wo_local.z < 0;
    if (!answer.refracts) return answer;
    answer.transmitted = sample.pdf_fwd;
    answer.wi_local = sample.wi_local;
    answer.scale = sample.value.x;
    return answer;
}

GlassAnswer glass_of_fast_path(Wing wing, const GlassInput& input)
{
    const fast::GlassProbe probe{
        fast::material_of(scenes::Glass{scenes::Rgb(1.0), scenes::Rgb(1.0), input.ior}, false),
        fast::Vec3(input.wo_local)};
    const auto compute = wing == Wing::cuda ? fast::probe_glass_on_device : fast::probe_glass;
    const fast::ProbedGlass found = compute(std::span(&probe, 1)).front();
    const fast::BsdfSample& sample = found.sample;
    GlassAnswer answer{found.reflected};
    answer.refracts = sample.wi_local.z * probe.wo_local.z < 0;
    if (!answer.refracts) return answer;
    answer.transmitted = 1.0f - found.reflected;
    answer.wi_local = scenes::Vec3(sample.wi_local);
    answer.scale = sample.value.x;
    return answer;
}

/// A ray at glass in one format.
template <class F>
struct GlassRay {
    explicit GlassRay(const GlassInput& input)
        : wo(input.wo_local), cos_i(std::abs(wo.z)), ior(static_cast<F>(input.ior)),
          excess(static_cast<F>(input.excess)), outside(wo.z > 0), eta(outside ? 1 / ior : ior)
    {}
    glm::vec<3, F> wo;
    F cos_i, ior, excess;
    bool outside;
    F eta;
};

/// Fresnel's reflectance and the refracted ray, from cos_t^2.
template <class F>
GlassAnswer finished_glass(const GlassRay<F>& ray, F cos2_t)
{
    if (!(cos2_t > 0)) return {cos2_t <= 0 ? 1.0 : std::numeric_limits<double>::quiet_NaN()};
    const F cos_t = std::sqrt(cos2_t);
    const F parallel = (ray.cos_i - ray.eta * cos_t) / (ray.cos_i + ray.eta * cos_t);
    const F perpendicular = (ray.eta * ray.cos_i - cos_t) / (ray.eta * ray.cos_i + cos_t);
    const F reflected = (parallel * parallel + perpendicular * perpendicular) / 2;
    const glm::vec<3, F> wi(-ray.eta * ray.wo.x, -ray.eta * ray.wo.y, ray.outside ? -cos_t : cos_t);
    return {reflected, 1 - reflected, true, scenes::Vec3(glm::normalize(wi)), ray.eta * ray.eta};
}

/// The textbook's sin^2 = 1 - cos^2.
template <class F>
GlassAnswer with_squares(const GlassInput& input)
{
    const GlassRay<F> ray(input);
    return finished_glass<F>(ray, 1 - ray.eta * ray.eta * (1 - ray.cos_i * ray.cos_i));
}

/// sin^2 from the coordinates along the surface. They keep their digits near the normal, where those of
/// the cosine are lost.
template <class F>
GlassAnswer with_coordinates(const GlassInput& input)
{
    const GlassRay<F> ray(input);
    return finished_glass<F>(ray, 1 - ray.eta * ray.eta * (ray.wo.x * ray.wo.x + ray.wo.y * ray.wo.y));
}

/// cos_t^2 from n - 1, which is kept in place of n: where n is nearly 1, neither the index of refraction
/// nor the difference of two squares loses digits.
template <class F>
GlassAnswer with_excess(const GlassInput& input)
{
    const GlassRay<F> ray(input);
    const F more = ray.excess * (2 + ray.excess); // n^2 - 1
    const F cos2_i = ray.cos_i * ray.cos_i;
    return finished_glass<F>(ray, ray.outside ? (cos2_i + more) / (ray.ior * ray.ior)
                                              : ray.ior * ray.ior * cos2_i - more);
}

/// Snell's law with angles.
template <class F>
GlassAnswer with_angles(const GlassInput& input)
{
    const GlassRay<F> ray(input);
    const F sin_t = ray.eta * std::sin(std::acos(std::min(ray.cos_i, F(1))));
    if (sin_t >= 1) return {1.0};
    const F cos_t = std::cos(std::asin(sin_t));
    return finished_glass<F>(ray, cos_t * cos_t);
}

/// Schlick's approximation [1994] of the reflectance, with the angle on the rarer side.
template <class F>
GlassAnswer with_schlick(const GlassInput& input)
{
    const GlassRay<F> ray(input);
    const F cos2_t = 1 - ray.eta * ray.eta * (1 - ray.cos_i * ray.cos_i);
    GlassAnswer answer = finished_glass<F>(ray, cos2_t);
    if (!answer.refracts) return answer;
    const F r = (ray.ior - 1) / (ray.ior + 1);
    const F rest = 1 - (ray.eta > 1 ? std::sqrt(cos2_t) : ray.cos_i);
    const F reflected = r * r + (1 - r * r) * rest * rest * rest * rest * rest;
    answer.reflected = reflected;
    answer.transmitted = 1 - reflected;
    return answer;
}

} // namespace

GlassAnswer glass_by(Wing wing, const GlassInput& input)
{
    return wing == Wing::ref ? glass_of_reference(input) : glass_of_fast_path(wing, input);
}

std::vector<GlassTrick> glass_tricks()
{
    return {{"1 - cos^2 (float)", Format::binary32, with_squares<float>},
            {"sin from x and y (double)", Format::binary64, with_coordinates<double>},
            {"sin from x and y (float)", Format::binary32, with_coordinates<float>},
            {"n - 1 kept (double)", Format::binary64, with_excess<double>},
            {"n - 1 kept (float)", Format::binary32, with_excess<float>},
            {"arc sine (double)", Format::binary64, with_angles<double>},
            {"arc sine (float)", Format::binary32, with_angles<float>},
            {"Schlick (double)", Format::binary64, with_schlick<double>},
            {"Schlick (float)", Format::binary32, with_schlick<float>}};
}

} // namespace extremes
