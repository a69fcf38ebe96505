#include "ref/transport/bsdf.h"
#include "tests/ref/transport/chi_squared.h"
#include "tests/ref/transport/generators.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace {

using ref::evaluate_bsdf;
using ref::pdf_solid_angle_bsdf;
using ref::Rgb;
using ref::sample_bsdf;
using ref::survival_probability;
using ref::Transport;
using ref::Uniforms;
using ref::Vec3;
using transport_test::any_direction;
using transport_test::any_unit;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

double refracted(double cos_i, double eta_i, double eta_t, double& cos_t)
{
    return ref::fresnel(cos_i, eta_i, eta_t, cos_t);
}

TEST(Bsdf, LambertianSamplesFollowTheirDensityOnBothSides) // map: bsdf-lambertian
{
    const scenes::Material grey = scenes::Lambertian{Rgb(0.5)};
    for (const double side : {1.0, -1.0}) {
        const Vec3 wo = glm::normalize(Vec3(0.3, 0.4, 0.2 * side));
        const auto sample = [&](const Uniforms& u) {
            return sample_bsdf(grey, wo, u, Transport::radiance).wi_local;
        };
        const auto density = [&](const Vec3& wi) { return pdf_solid_angle_bsdf(grey, wo, wi); };
        transport_test::expect_directions_follow_density(sample, density, transport_test::coarse, 8);
        transport_test::expect_directions_follow_density(sample, density, transport_test::fine, 4);
    }
}

// map: bsdf-lambertian
RC_GTEST_PROP(Bsdf, LambertianIsReciprocalAndItsDensitiesAgreeWithTheSample, ())
{
    const scenes::Material material = scenes::Lambertian{Rgb(0.2, 0.5, 0.9)};
    const Vec3 wo = *any_direction();
    const auto s = sample_bsdf(material, wo, {*any_unit(), *any_unit(), 0.5, 0.5}, Transport::radiance);
    RC_ASSERT(evaluate_bsdf(material, wo, s.wi_local) == evaluate_bsdf(material, s.wi_local, wo));
    RC_ASSERT(s.pdf_fwd == pdf_solid_angle_bsdf(material, wo, s.wi_local));
    RC_ASSERT(s.pdf_rev == pdf_solid_angle_bsdf(material, s.wi_local, wo));
    RC_ASSERT(!s.delta);
    const Rgb value = evaluate_bsdf(material, wo, s.wi_local) * std::abs(s.wi_local.z) / s.pdf_fwd;
    for (int i = 0; i < 3; ++i) RC_ASSERT(std::abs(value[i] - s.value[i]) <= 4 * epsilon * s.value[i]);
}

// docs/derivations.md, section 1: what leaves again of the light from the whole hemisphere is the
// albedo. In the cosine the integrand is linear, for which the midpoint rule is exact.
TEST(Bsdf, LambertianReflectsItsAlbedo)
{
    const scenes::Material material = scenes::Lambertian{Rgb(0.2, 0.5, 0.9)};
    constexpr int steps = 100;
    Rgb reflected(0.0);
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps;
        const Vec3 wi(std::sqrt(1.0 - z * z), 0.0, z);
        reflected += evaluate_bsdf(material, Vec3(0.6, 0.0, 0.8), wi) * z * (2.0 * ref::pi / steps);
    }
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(reflected[i], Rgb(0.2, 0.5, 0.9)[i], steps * epsilon) << i;
}

// Opaque: no light may pass to the other side.
RC_GTEST_PROP(Bsdf, LambertianDoesNotTransmit, ())
{
    const scenes::Material material = scenes::Lambertian{Rgb(1.0)};
    const Vec3 wo = *any_direction();
    const Vec3 wi = *any_direction();
    RC_PRE(wo.z * wi.z < 0.0);
    RC_ASSERT(evaluate_bsdf(material, wo, wi) == Rgb(0.0));
    RC_ASSERT(pdf_solid_angle_bsdf(material, wo, wi) == 0.0);
}

RC_GTEST_PROP(Bsdf, MirrorReflectsAboutTheNormal, ()) // map: bsdf-mirror
{
    const Vec3 wo = *any_direction();
    const auto s = sample_bsdf(scenes::Material(scenes::Mirror{Rgb(0.7)}), wo, {}, Transport::radiance);
    RC_ASSERT(s.delta && s.value == Rgb(0.7));
    RC_ASSERT(s.wi_local == Vec3(-wo.x, -wo.y, wo.z));
}

TEST(Fresnel, AtNormalIncidenceIsTheTextbookValue)
{
    double cos_t = 0.0;
    EXPECT_NEAR(refracted(1.0, 1.0, 1.5, cos_t), 0.04, 4 * epsilon);
    EXPECT_EQ(cos_t, 1.0);
}

// At Brewster's angle, tan(theta) = n, unpolarised reflectance is half of the perpendicular component,
// ((1 - n^2) / (1 + n^2))^2 / 2, because the parallel component is 0.
TEST(Fresnel, AtBrewstersAngleOnlyThePerpendicularPartIsLeft) // map: fresnel
{
    const double n = 1.45;
    double cos_t = 0.0;
    const double r = (1 - n * n) / (1 + n * n);
    EXPECT_NEAR(refracted(std::cos(std::atan(n)), 1.0, n, cos_t), r * r / 2, 8 * epsilon);
}

TEST(Fresnel, BeyondTheCriticalAngleAllIsReflected)
{
    const double critical = std::asin(1.0 / 1.45);
    double cos_t = 0.0;
    EXPECT_EQ(refracted(std::cos(critical + 1e-6), 1.45, 1.0, cos_t), 1.0);
    EXPECT_LT(refracted(std::cos(critical - 1e-3), 1.45, 1.0, cos_t), 1.0);
    EXPECT_NEAR(refracted(1e-9, 1.0, 1.45, cos_t), 1.0, 1e-8); // grazing: 1 - O(cos)
}

// Reflectance is the same from both sides along one light path, since 1 - F is the transmittance in
// both directions. Tolerance: both sides are smooth in cos_i, except that sqrt(1 - sin^2) loses digits
// near the critical angle. With cos_t > 1e-3 the relative error is at most epsilon / cos_t^2.
RC_GTEST_PROP(Fresnel, IsTheSameFromBothSides, ())
{
    const double cos_i = *any_unit();
    const double n = 1.0 + *any_unit();
    double cos_t = 0.0;
    const double from_outside = refracted(cos_i, 1.0, n, cos_t);
    RC_PRE(cos_i > 1e-3);
    double back = 0.0;
    const double from_inside = refracted(cos_t, n, 1.0, back);
    RC_ASSERT(std::abs(from_outside - from_inside) < 1e-9);
    RC_ASSERT(std::abs(back - cos_i) < 1e-9);
}

// docs/derivations.md, section 8. The fields in the other medium, from the continuity of the fields
// along the boundary: t = 1 + r for the electric field perpendicular to the plane of incidence, eta_t t
// = eta_i (1 + r) for the one in it, where r = (1 - s) / (1 + s) and s is the quotient of the other two
// parts. The power that crosses a piece of the boundary is eta |E|^2 cos. Tolerance: s is at least 0.05
// and at most 20 here, so no digits are lost but those of cos_t, as above: epsilon / cos_t^2.
RC_GTEST_PROP(Fresnel, LeavesToTheOtherSideWhatTheFieldsCarry, ())
{
    const double eta_i = 1.0 + *any_unit();
    const double eta_t = 1.0 + *any_unit();
    const double cos_i = *any_unit();
    double cos_t = 0.0;
    const double reflected = refracted(cos_i, eta_i, eta_t, cos_t);
    RC_PRE(cos_i > 0.1 && cos_t > 0.1);
    double passed = 0.0;
    for (const double s : {eta_t * cos_t / (eta_i * cos_i), eta_i * cos_t / (eta_t * cos_i)}) {
        const bool perpendicular = passed == 0.0;
        const double r = (1.0 - s) / (1.0 + s);
        const double field = perpendicular ? 1.0 + r : eta_i / eta_t * (1.0 + r);
        passed += field * field * eta_t * cos_t / (eta_i * cos_i) / 2.0;
    }
    RC_ASSERT(std::abs(1.0 - reflected - passed) < 1e-12);
}

// docs/derivations.md, section 7. Directions of refraction for a small parallelogram of directions
// around wo: solid angles are lengths of cross products, and eta^2 cos times them is the same on both
// sides. Central differences of width 2 h have a relative error of h^2 times the third derivative (at
// most some 1 / cos^4 with cosines above 0.3: 1e-10 * 123), and rounding gives epsilon / h = 2e-11 times
// the same.
RC_GTEST_PROP(Glass, RefractionKeepsEtaSquaredCosineTimesSolidAngle, ())
{
    const double ior = 1.2 + *any_unit();
    const scenes::Material glass = scenes::Glass{Rgb(1.0), Rgb(1.0), ior};
    const Vec3 wo = *any_direction();
    const auto refract = [&](const Vec3& w) {
        return sample_bsdf(glass, glm::normalize(w), {0.5, 0.5, 1.0 - 0x1p-33, 0.5}, Transport::power)
            .wi_local;
    };
    const Vec3 wi = refract(wo);
    RC_PRE(wo.z * wi.z < 0.0 && std::abs(wo.z) > 0.3 && std::abs(wi.z) > 0.3);
    constexpr double h = 1e-5;
    const ref::Frame frame(wo);
    const Vec3 du = (refract(wo + h * frame.x) - refract(wo - h * frame.x)) / (2.0 * h);
    const Vec3 dv = (refract(wo + h * frame.y) - refract(wo - h * frame.y)) / (2.0 * h);
    const double solid_angle = glm::length(glm::cross(du, dv)); // of one steradian on the side of wo
    const double eta_o = wo.z > 0.0 ? 1.0 : ior;
    const double eta_i = wo.z > 0.0 ? ior : 1.0;
    const double kept = eta_i * eta_i * std::abs(wi.z) * solid_angle / (eta_o * eta_o * std::abs(wo.z));
    RC_ASSERT(std::abs(kept - 1.0) < 1e-7);
}

// Snell's law, written independently of the code: eta_i sin_i = eta_t sin_t, in one plane, to the
// other side.
RC_GTEST_PROP(Glass, RefractsBySnellsLaw, ()) // map: refraction
{
    const scenes::Material glass = scenes::Glass{Rgb(1.0), Rgb(1.0), 1.45};
    const Vec3 wo = *any_direction();
    const auto s = sample_bsdf(glass, wo, {0.5, 0.5, 1.0 - 0x1p-33, 0.5}, Transport::radiance);
    RC_PRE(wo.z * s.wi_local.z < 0.0); // otherwise total reflection
    const double eta_i = wo.z > 0.0 ? 1.0 : 1.45;
    const double eta_t = wo.z > 0.0 ? 1.45 : 1.0;
    RC_ASSERT(glm::length(eta_i * glm::dvec2(wo) + eta_t * glm::dvec2(s.wi_local)) < 1e-12);
    RC_ASSERT(std::abs(glm::length(s.wi_local) - 1.0) < 4 * epsilon);
}

// The value of a delta lobe is its colour, times (eta_i / eta_t)^2 where radiance is refracted: the
// Fresnel factor and the probability of the lobe cancel.
RC_GTEST_PROP(Glass, RadianceIsSqueezedAndPowerIsNot, ()) // map: eta-squared
{
    const scenes::Material glass = scenes::Glass{Rgb(0.9), Rgb(0.8), 1.5};
    const Vec3 wo = *any_direction();
    const Uniforms u = {0.5, 0.5, *any_unit(), 0.5};
    const auto radiance = sample_bsdf(glass, wo, u, Transport::radiance);
    const auto power = sample_bsdf(glass, wo, u, Transport::power);
    RC_ASSERT(radiance.wi_local == power.wi_local && radiance.pdf_fwd == power.pdf_fwd);
    if (wo.z * radiance.wi_local.z > 0.0) {
        RC_ASSERT(radiance.value == Rgb(0.9) && power.value == Rgb(0.9));
    } else {
        const double squeeze = wo.z > 0.0 ? 1.0 / 2.25 : 2.25;
        RC_ASSERT(power.value == Rgb(0.8));
        RC_ASSERT(std::abs(radiance.value.x - 0.8 * squeeze) < 8 * epsilon);
    }
}

// The probability of the lobe times eta^2 |cos| on the side of wi, from both sides of the surface.
RC_GTEST_PROP(Glass, ADeltaLobeHasItsProbabilityPerProjectedSolidAngleTimesEtaSquared, ())
{
    const scenes::Material glass = scenes::Glass{Rgb(0.9), Rgb(0.8), 1.5};
    const Vec3 wo = *any_direction();
    const auto s = sample_bsdf(glass, wo, {0.5, 0.5, *any_unit(), 0.5}, Transport::radiance);
    const double eta = s.wi_local.z > 0.0 ? 1.0 : 1.5;
    const double expected = s.pdf_fwd * eta * eta * std::abs(s.wi_local.z);
    RC_ASSERT(std::abs(ref::density_of_delta_lobe(glass, wo, s.wi_local) - expected) <=
              16 * epsilon * expected);
}

// In through one face and out through a parallel one: the radiance is unchanged, and so is the
// direction.
RC_GTEST_PROP(Glass, ARoundTripInAndOutIsLossless, ())
{
    const scenes::Material glass = scenes::Glass{Rgb(1.0), Rgb(1.0), 1.45};
    const Uniforms through = {0.5, 0.5, 1.0 - 0x1p-33, 0.5};
    const Vec3 wo = *any_direction();
    RC_PRE(wo.z > 1e-4); // close to grazing, the last digits of the direction matter too much
    const auto in = sample_bsdf(glass, wo, through, Transport::radiance);
    RC_PRE(in.wi_local.z < 0.0);
    // At the far face the outside is on the other side: mirror z before and after.
    const Vec3 mirrored(-in.wi_local.x, -in.wi_local.y, in.wi_local.z);
    const auto out = sample_bsdf(glass, mirrored, through, Transport::radiance);
    const Vec3 leaving(out.wi_local.x, out.wi_local.y, -out.wi_local.z);
    const Rgb total = in.value * out.value;
    RC_ASSERT(std::abs(total.x - 1.0) < 4 * epsilon);
    RC_ASSERT(glm::length(leaving + wo) < 1e-10);
    RC_ASSERT(std::abs(in.pdf_fwd - out.pdf_fwd) < 1e-10 && in.pdf_fwd == in.pdf_rev);
}

// The reflected and transmitted fractions add up to 1: tests the frequencies of the lobes against
// Fresnel's equations, and, for power, that the total equals the incident power.
TEST(Glass, ConservesPower) // map: bsdf-glass
{
    const scenes::Material glass = scenes::Glass{Rgb(1.0), Rgb(1.0), 1.45};
    for (const double z : {0.9, 0.3, -0.9, -0.3}) {
        const Vec3 wo(std::sqrt(1.0 - z * z), 0.0, z);
        double cos_t = 0.0;
        const double reflected = refracted(std::abs(z), z > 0 ? 1.0 : 1.45, z > 0 ? 1.45 : 1.0, cos_t);
        constexpr int count = 100'000;
        int reflections = 0;
        for (int i = 0; i < count; ++i) {
            const auto s = sample_bsdf(glass, wo, {0.5, 0.5, (i + 0.5) / count, 0.5}, Transport::power);
            ASSERT_EQ(s.value, Rgb(1.0));
            if (s.wi_local.z * z > 0.0) ++reflections;
        }
        EXPECT_NEAR(reflections / static_cast<double>(count), reflected, 1.0 / count); // stratified u
    }
}

TEST(Roulette, StartsAfterTheFourthBounceAndNeverKeepsAWalkForCertain) // map: roulette
{
    const scenes::Material white = scenes::Mirror{Rgb(1.0)};
    const scenes::Material red = scenes::Lambertian{Rgb(0.6, 0.1, 0.1)};
    for (int bounce = 1; bounce <= 4; ++bounce)
        EXPECT_EQ(survival_probability(red, bounce, true, 5), 1.0);
    EXPECT_EQ(survival_probability(red, 5, true, 5), 0.6);
    EXPECT_LT(survival_probability(white, 5, true, 5), 1.0);
    EXPECT_EQ(survival_probability(red, 5, false, 5), 1.0);
    EXPECT_EQ(survival_probability(red, 1, true, 1), 0.6);
    EXPECT_EQ(survival_probability(red, 7, true, 8), 1.0);
    EXPECT_EQ(survival_probability(red, 8, true, 8), 0.6);
}

} // namespace
