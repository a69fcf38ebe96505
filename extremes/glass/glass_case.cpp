// The truth: Snell's law and Fresnel's equations [Born & Wolf 1999, sec. 1.5.2].

#include "extremes/glass/glass_case.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace extremes {

namespace {

GlassCase without_angle(const Exact& excess, bool outside, Random& random)
{
    GlassCase glass;
    glass.excess = excess;
    glass.outside = outside;
    glass.eta = outside ? 1 / (1 + excess) : 1 + excess;
    const double phi = 2.0 * std::numbers::pi * random.uniform();
    glass.azimuth_x = std::cos(phi);
    glass.azimuth_y = std::sin(phi);
    return glass;
}

struct GlassTruth {
    Exact cos_i, sin_i, cos_t; // cos_t: 0 under total reflection
    Exact transmitted;
};

GlassTruth truth_of(const GlassCase& glass)
{
    GlassTruth truth{sqrt(glass.cos2_i), sqrt(1 - glass.cos2_i), 0, 0};
    if (glass.cos2_t <= 0) return truth;
    truth.cos_t = sqrt(glass.cos2_t);
    // 1 - r^2 for either polarisation: 1 - ((a - b) / (a + b))^2 = 4 a b / (a + b)^2. The mean of two
    // such fractions with the denominators p^2 and s^2 has the denominator (p s)^2.
    const Exact parallel = truth.cos_i + glass.eta * truth.cos_t;
    const Exact perpendicular = glass.eta * truth.cos_i + truth.cos_t;
    const Exact both = parallel * perpendicular;
    truth.transmitted = 2 * glass.eta * truth.cos_i * truth.cos_t *
                        (parallel * parallel + perpendicular * perpendicular) / (both * both);
    return truth;
}

GlassInput input_of(const GlassCase& glass, const GlassTruth& truth)
{
    const double sin_i = truth.sin_i.to_double();
    const double cos_i = truth.cos_i.to_double();
    return {{sin_i * glass.azimuth_x, sin_i * glass.azimuth_y, glass.outside ? cos_i : -cos_i},
            (1 + glass.excess).to_double(),
            glass.excess.to_double()};
}

double error_against(const GlassCase& glass, const GlassTruth& truth, const GlassAnswer& answer)
{
    double error = abs(Exact(answer.reflected) - (1 - truth.transmitted)).to_double();
    if (!answer.refracts || glass.cos2_t <= 0) return error;
    const double sin_t = (glass.eta * truth.sin_i).to_double();
    const double cos_t = truth.cos_t.to_double();
    const scenes::Vec3 wi(-sin_t * glass.azimuth_x, -sin_t * glass.azimuth_y,
                          glass.outside ? -cos_t : cos_t);
    // Comparisons that are false for NaN keep it.
    const double angle = glm::length(answer.wi_local - wi);
    if (!(angle <= error)) error = angle;
    const double scale = relative_error(answer.scale, glass.eta * glass.eta);
    if (!(scale <= error)) error = scale;
    return error;
}

bool is_finite_answer(const GlassAnswer& answer)
{
    const double sum = answer.reflected + answer.transmitted + answer.scale + answer.wi_local.x +
                       answer.wi_local.y + answer.wi_local.z;
    return std::isfinite(sum);
}

Method method_of(std::string name, Format format, const GlassFunction& compute, const GlassDraw& draw)
{
    return {std::move(name), format,
            [compute, draw](double parameter, Random& random, int cases, Tally& tally) {
                for (int i = 0; i < cases; ++i) {
                    const GlassCase glass = draw(parameter, random);
                    const GlassTruth truth = truth_of(glass);
                    const GlassAnswer answer = compute(input_of(glass, truth));
                    if (!is_finite_answer(answer))
                        tally.add(Failure::not_finite);
                    else
                        tally.add(error_against(glass, truth, answer));
                }
            }};
}

} // namespace

GlassCase incident(const Exact& excess, bool outside, double cos_i, Random& random)
{
    GlassCase glass = without_angle(excess, outside, random);
    glass.cos2_i = Exact(cos_i) * cos_i;
    glass.cos2_t = 1 - glass.eta * glass.eta * (1 - glass.cos2_i);
    return glass;
}

GlassCase refracted(const Exact& excess, bool outside, const Exact& cos2_t, Random& random)
{
    GlassCase glass = without_angle(excess, outside, random);
    glass.cos2_t = cos2_t;
    glass.cos2_i = 1 - (1 - cos2_t) / (glass.eta * glass.eta);
    return glass;
}

double error_of(const GlassCase& glass, const GlassAnswer& answer)
{
    return error_against(glass, truth_of(glass), answer);
}

std::vector<Method> glass_methods(const GlassDraw& draw)
{
    std::vector<Method> methods;
    for (const Wing wing : wings())
        methods.push_back(method_of(
            name_of(wing), format_of(wing),
            [wing](const GlassInput& input) { return glass_by(wing, input); }, draw));
    for (const GlassTrick& trick : glass_tricks())
        methods.push_back(method_of(trick.name, trick.format, trick.compute, draw));
    return methods;
}

Method transmission_method(std::string name, Format format, const GlassFunction& compute,
                           const GlassDraw& draw)
{
    return {std::move(name), format,
            [compute, draw](double parameter, Random& random, int cases, Tally& tally) {
                for (int i = 0; i < cases; ++i) {
                    const GlassCase glass = draw(parameter, random);
                    const GlassTruth truth = truth_of(glass);
                    const GlassAnswer answer = compute(input_of(glass, truth));
                    if (glass.cos2_t > 0)
                        tally.add(relative_error(answer.transmitted, truth.transmitted));
                    else if (answer.transmitted != 0)
                        tally.add(Failure::leaked);
                    else
                        tally.add(0.0);
                }
            }};
}

// How far off is the computed square of the cosine of refraction, C = 1 - S with S = eta^2 sin_i^2?
//
// u is the unit roundoff. To first order in u, with S <= 1:
// 1. The cosine of incidence is rounded, an error of u relative to itself. It moves C by 2 u eta^2
//    cos_i^2, which is 2 u (eta^2 - S).
// 2. The reference computes sin_t = eta sqrt(1 - cos_i^2). The square of the cosine has one rounding, of
//    at most u eta^2 cos_i^2 in S. The difference has one rounding, the root halves it and adds one, eta
//    has one, and the product has one: 3.5 u in sin_t. The square of it has 7 u + u.
// 3. The fast path computes eta^2 (1 - cos_i)(1 + cos_i). The two sums and their product have one
//    rounding each, the quotient eta has one, eta^2 has 2 u + u from it, and the last product has one:
//    7 u S.
// 4. The index of refraction was rounded to the format: 2 u S.
// 5. The last difference has a rounding of u C.
//
// Reference: 2 u (eta^2 - S) + u (eta^2 - S) + 8 u S + 2 u S + u C <= 10 u + 3 u (eta^2 - 1) if
// eta >= 1, and less than 10 u if not. Fast path: 2 u (eta^2 - S) + 7 u S + 2 u S + u C
// <= 9 u + 2 u (eta^2 - 1), and less than 9 u. Under total reflection, where S > 1, all terms in S grow
// in proportion to it.
double error_of_cos2_t(Format format, double eta)
{
    const double more = std::max(0.0, eta * eta - 1.0);
    return format == Format::binary64 ? (10.0 + 3.0 * more) * 0x1p-53 : (9.0 + 2.0 * more) * 0x1p-24;
}

// The share itself: let r = (a - b) / (a + b) with products a and b. Where it was not rounded above,
// an input of a product brings at most u / 2 relative to a + b (a b / (a + b)^2 <= 1/4, twice), and so
// do cos_i (u), cos_t (its root, u), eta (u, and the rounding of the index, u) and the two products (u
// each): 6 roundings, 3 u. The difference, the sum and the quotient have one rounding each, relative to
// r: 3 u. The square has 12 u + u, the mean of two squares one more: 14 u. The transmitted share has
// another u.
//
// The scale eta^2 has two roundings in eta, twice, and one in the product: 5 u; and the normalised
// direction has less than 8 u: two in each of eta and the products with the coordinates, which are
// rounded once themselves, and one each in the root and the quotient.
double error_of_shares(Format format)
{
    return format == Format::binary64 ? 15 * 0x1p-53 : 15 * 0x1p-24;
}

} // namespace extremes
