#include "ref/transport/sampling.h"
#include "tests/ref/transport/chi_squared.h"
#include "tests/ref/transport/generators.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace {

using ref::Uniforms;
using ref::Vec3;

double cosine_density(const glm::dvec3& w)
{
    return ref::pdf_solid_angle_cosine_hemisphere(w);
}

TEST(Sampling, CosineHemisphereFollowsItsDensity) // map: cosine-sampling
{
    const auto sample = [](const Uniforms& u) { return ref::sample_cosine_hemisphere(u[0], u[1]); };
    transport_test::expect_directions_follow_density(sample, cosine_density, transport_test::coarse, 8);
    transport_test::expect_directions_follow_density(sample, cosine_density, transport_test::fine, 4);
}

TEST(Sampling, SphereFollowsItsDensity)
{
    const auto sample = [](const Uniforms& u) { return ref::sample_sphere(u[0], u[1]); };
    const auto density = [](const glm::dvec3&) { return ref::pdf_solid_angle_sphere; };
    transport_test::expect_directions_follow_density(sample, density, transport_test::coarse, 1);
    transport_test::expect_directions_follow_density(sample, density, transport_test::fine, 1);
}

// The triangle is half of the unit square, so a uniform point has density 2 there. The midpoint rule
// is exact except for the cells on the diagonal, where 64 x 64 points leave an error of at most 1/64
// of a cell.
TEST(Sampling, TriangleFollowsItsDensity) // map: emission-triangle
{
    const auto sample = [](const Uniforms& u) {
        const Vec3 b = ref::sample_triangle(u[0], u[1]);
        return glm::dvec2(b.y, b.z);
    };
    const auto density = [](const glm::dvec2& p) { return p.x + p.y < 1.0 ? 2.0 : 0.0; };
    transport_test::expect_samples_follow_density(sample, density, transport_test::coarse, 64);
    transport_test::expect_samples_follow_density(sample, density, transport_test::fine, 64);
}

TEST(Sampling, DiscFollowsItsDensity)
{
    const auto sample = [](const Uniforms& u) { return (ref::sample_disc(u[0], u[1]) + 1.0) / 2.0; };
    const auto density = [](const glm::dvec2& p) {
        const glm::dvec2 q = 2.0 * p - 1.0;
        return q.x * q.x + q.y * q.y < 1.0 ? 4.0 * ref::inverse_pi : 0.0;
    };
    transport_test::expect_samples_follow_density(sample, density, transport_test::coarse, 64);
}

TEST(Sampling, DensitiesIntegrateToOne)
{
    const auto integral = [](auto density) {
        double sum = 0.0;
        for (const double cell : transport_test::integrate_cells(
                 [&](const glm::dvec2& p) {
                     const double z = 2.0 * p.x - 1.0;
                     return 4.0 * ref::pi * density(Vec3(std::sqrt(1.0 - z * z), 0.0, z));
                 },
                 {1, 1}, 1000))
            sum += cell;
        return sum;
    };
    EXPECT_NEAR(integral(cosine_density), 1.0, 1e-4);
    EXPECT_NEAR(integral([](const Vec3&) { return ref::pdf_solid_angle_sphere; }), 1.0, 1e-12);
}

/// The mean of f(u1, u2) over the unit square, by the midpoint rule.
template <class Function>
double mean_over_square(const Function& f)
{
    constexpr int steps = 200;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) sum += f((i + 0.5) / steps, (k + 0.5) / steps);
    return sum / (steps * steps);
}

// docs/derivations.md, sections 2 to 4. The midpoint rule has an error of the order of 1 / steps^2 where
// the integrand is smooth, and of 1 / steps^1.5 = 3.5e-4 where it is a square root of u or of 1 - u,
// which are 0 at an end: the error of the first cell is a share of its integral, steps^-1.5.
TEST(Sampling, MeansAreThoseOfTheDensities)
{
    const auto cosine = [](double u1, double u2) { return ref::sample_cosine_hemisphere(u1, u2).z; };
    EXPECT_NEAR(mean_over_square(cosine), 2.0 / 3.0, 3.5e-4); // integral of cos^2 / pi
    for (int corner = 0; corner < 3; ++corner) {
        const auto weight = [&](double u1, double u2) { return ref::sample_triangle(u1, u2)[corner]; };
        EXPECT_NEAR(mean_over_square(weight), 1.0 / 3.0, 3.5e-4) << corner;
        const auto square = [&](double u1, double u2) { return weight(u1, u2) * weight(u1, u2); };
        EXPECT_NEAR(mean_over_square(square), 1.0 / 6.0, 7e-4) << corner; // twice: slope of the square
    }
    for (int axis = 0; axis < 3; ++axis) {
        const auto square = [&](double u1, double u2) {
            const double x = ref::sample_sphere(u1, u2)[axis];
            return x * x;
        };
        EXPECT_NEAR(mean_over_square(square), 1.0 / 3.0, 1.0 / (200 * 200)) << axis;
    }
}

RC_GTEST_PROP(Sampling, FrameIsOrthonormalRightHandedAndUndoesItself, ())
{
    const Vec3 z = *transport_test::any_direction();
    const ref::Frame frame(z);
    // A few roundings each, magnified where the construction divides by 1 + |z| >= 1.
    constexpr double tolerance = 16 * std::numeric_limits<double>::epsilon();
    RC_ASSERT(std::abs(glm::dot(frame.x, frame.y)) < tolerance);
    RC_ASSERT(glm::length(glm::cross(frame.x, frame.y) - frame.z) < tolerance);
    RC_ASSERT(std::abs(glm::length(frame.x) - 1.0) < tolerance);
    const Vec3 v(0.3, -0.5, 0.7);
    RC_ASSERT(glm::length(frame.to_world(frame.to_local(v)) - v) < tolerance);
}

TEST(Sampling, FrameHoldsAtBothPoles)
{
    for (const double z : {1.0, -1.0}) {
        const ref::Frame frame(Vec3(0.0, 0.0, z));
        EXPECT_EQ(glm::cross(frame.x, frame.y), frame.z);
    }
}

} // namespace
