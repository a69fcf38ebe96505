// Glass that is nearly air: an index of refraction of 1 + 10^-k.

#include "extremes/axes/axes.h"
#include "extremes/exact.h"

#include "cuda/transport/bsdf.h"
#include "ref/transport/bsdf.h"

#include <cmath>

namespace extremes {

namespace {

/// Fresnel's reflectance for light from air [Born & Wolf 1999, sec. 1.5.2].
Exact exact_reflectance(const Exact& cos_i, const Exact& ior)
{
    const Exact cos_t = sqrt(1 - (1 - cos_i * cos_i) / (ior * ior));
    const Exact parallel = (ior * cos_i - cos_t) / (ior * cos_i + cos_t);
    const Exact perpendicular = (cos_i - ior * cos_t) / (cos_i + ior * cos_t);
    return (parallel * parallel + perpendicular * perpendicular) / 2;
}

/// Calls reflectance(cos_i, ior) for random angles and compares with the truth: the error is relative to
/// 1, the light that arrives.
template <class Reflectance>
auto compared(const Reflectance& reflectance)
{
    return [reflectance](double parameter, Random& random, int cases, Tally& tally) {
        for (int i = 0; i < cases; ++i) {
            const double cos_i = random.uniform();
            const double ior = 1.0 + parameter;
            const Exact truth = exact_reflectance(Exact(cos_i), Exact(ior));
            tally.add(abs(Exact(reflectance(cos_i, ior)) - truth).template convert_to<double>());
        }
    };
}

} // namespace

Axis ior_axis()
{
    Axis axis;
    axis.number = 8;
    axis.name = "ior";
    axis.title = "Glass that is nearly air";
    axis.parameter = "index of refraction, less 1";
    axis.about = "";
    axis.ordinary = 1.0;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-18, 0, 1);
    axis.methods = {{"ref", Format::binary64, compared([](double cos_i, double ior) {
                         double cos_t = 0;
                         return ref::fresnel(cos_i, 1.0, ior, cos_t);
                     })},
                    {"host", Format::binary32, compared([](double cos_i, double ior) {
                         float cos_t = 0;
                         return static_cast<double>(fast::fresnel(
                             static_cast<float>(cos_i), 1.0f / static_cast<float>(ior), cos_t));
                     })}};
    axis.limits = {};
    return axis;
}

} // namespace extremes
