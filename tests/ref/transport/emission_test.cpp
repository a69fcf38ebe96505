#include "ref/transport/emission.h"
#include "tests/ref/transport/chi_squared.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using ref::EmitterKind;
using ref::Rgb;
using ref::Vec3;
using std::numbers::pi;

/// All six kinds of emitters above a matte floor. The ball around the box [-1, 1]^3 has radius
/// sqrt(3).
scenes::Scene six_emitters()
{
    scenes::Scene scene;
    scene.name = "six emitters";
    scene.materials = {scenes::Lambertian{Rgb(0.5)}, scenes::Emission{Rgb(4.0, 3.0, 2.0)},
                       scenes::Emission{Rgb(1.0, 2.0, 3.0)}};
    scene.material_names = {"floor", "panel", "bulb"};
    scene.triangles = {{{Vec3(-1, -1, -1), Vec3(1, -1, -1), Vec3(1, 1, -1)}, 0},
                       {{Vec3(-1, -1, -1), Vec3(1, 1, -1), Vec3(-1, 1, 1)}, 0},
                       {{Vec3(0.1, 0.9, 0.2), Vec3(-0.7, 0.3, 0.4), Vec3(0.2, -0.1, 0.9)}, 1}};
    scene.spheres = {{Vec3(0.5, 0.4, 0.1), 0.3, 2}};
    scene.point_lights = {{Vec3(-0.3, 0.2, 0.5), Rgb(0.4, 0.5, 0.3)}};
    scene.spot_lights = {{Vec3(0.2, -0.5, 0.6), Vec3(-0.36, 0.48, -0.8), Rgb(2.0, 1.0, 3.0), 0.7, 5.0}};
    scene.directional_lights = {{Vec3(0.48, 0.64, -0.6), Rgb(0.9, 0.8, 0.4)}};
    scene.environment = Rgb(0.1, 0.2, 0.15);
    scene.camera = scenes::Camera{
        Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.0};
    return scene;
}

/// The flux of each emitter in closed form: pi A L, 4 pi I, I 2 pi (1 - c^(n+1)) / (n+1), E pi R^2, L
/// 4 pi pi R^2.
Rgb flux(const scenes::Scene& scene, EmitterKind kind)
{
    const double disc = pi * 3.0;
    switch (kind) {
    case EmitterKind::triangle: {
        const auto& v = scene.triangles[2].vertices;
        return pi * glm::length(glm::cross(v[1] - v[0], v[2] - v[0])) / 2.0 * Rgb(4.0, 3.0, 2.0);
    }
    case EmitterKind::sphere:
        return pi * 4.0 * pi * 0.09 * Rgb(1.0, 2.0, 3.0);
    case EmitterKind::point:
        return 4.0 * pi * scene.point_lights[0].intensity;
    case EmitterKind::spot:
        return scene.spot_lights[0].intensity * 2.0 * pi * (1.0 - std::pow(0.7, 6)) / 6.0;
    case EmitterKind::directional:
        return disc * scene.directional_lights[0].irradiance;
    case EmitterKind::environment:
        return 4.0 * pi * disc * *scene.environment;
    }
    return Rgb(0.0);
}

constexpr EmitterKind kinds[] = {EmitterKind::triangle,    EmitterKind::sphere,
                                 EmitterKind::point,       EmitterKind::spot,
                                 EmitterKind::directional, EmitterKind::environment};

/// The scene with all other emitters made black: the choice of the emitter is then certain.
scenes::Scene with_one_emitter(EmitterKind kind)
{
    scenes::Scene scene = six_emitters();
    if (kind != EmitterKind::triangle) scene.materials[1] = scenes::Lambertian{Rgb(0.5)};
    if (kind != EmitterKind::sphere) scene.materials[2] = scenes::Lambertian{Rgb(0.5)};
    if (kind != EmitterKind::point) scene.point_lights.clear();
    if (kind != EmitterKind::spot) scene.spot_lights.clear();
    if (kind != EmitterKind::directional) scene.directional_lights.clear();
    if (kind != EmitterKind::environment) scene.environment.reset();
    return scene;
}

double probability_of(const scenes::Scene& scene, EmitterKind kind)
{
    const ref::Geometry geometry(scene); // tested in emitter_choice_test.cpp
    const ref::Emitters emitters(geometry);
    for (const ref::Emitter& emitter : emitters.all())
        if (emitter.kind == kind) return emitter.probability;
    return 0.0;
}

/// The first number for which sample_emission chooses `kind`, found by search.
double number_that_chooses(const ref::World& world, EmitterKind kind)
{
    for (int i = 0; i < 1000; ++i) {
        const double u = (i + 0.5) / 1000;
        if (world.emitters.choose(u)->kind == kind) return u;
    }
    return 0.5;
}

class Emission : public testing::TestWithParam<EmitterKind> {
protected:
    scenes::Scene scene = six_emitters();
    ref::World world{scene, 4, 4};
    double chooses = number_that_chooses(world, GetParam());
};

std::string kind_name(EmitterKind kind)
{
    constexpr const char* names[] = {"triangle",    "sphere", "point",
                                     "directional", "spot",   "environment"};
    return names[static_cast<int>(kind)];
}

INSTANTIATE_TEST_SUITE_P(Kinds, Emission, testing::ValuesIn(kinds),
                         [](const auto& name) { return kind_name(name.param); });

/// A vertex one unit along the ray that faces y0, so that a density per area there is one per solid
/// angle.
ref::Vertex facing_vertex(const ref::Vertex& y0, const Vec3& w)
{
    ref::SurfacePoint point{};
    point.position = y0.point.position + w;
    point.normal = -w;
    return {ref::Vertex::Kind::surface, point, Vec3(0.0), nullptr, Rgb(1.0)};
}

// For a finite emitter the direction is tested by chi-squared; for an emitter at infinity the position
// on the disc, which must cover the ball around the scene.
// map: emission-surface, emission-point, emission-spot
TEST_P(Emission, DirectionsFollowTheirDensity)
{
    const auto y0 = [&](const ref::Uniforms& u) {
        return *sample_emission(world, {chooses, 0.3, 0.6, 0.5}, u);
    };
    const bool infinite = y0({0.5, 0.5, 0.5, 0.5}).y0.kind == ref::Vertex::Kind::infinity;
    if (infinite) {
        const Vec3 w = y0({0.5, 0.5, 0.5, 0.5}).ray.direction;
        const ref::Frame frame(w);
        const double r = std::sqrt(3.0);
        const auto sample = [&](const ref::Uniforms& u) {
            const auto start = y0(u);
            EXPECT_NEAR(glm::length(start.ray.direction - w), 0.0, 1e-15);
            // outside all geometry, on the side from which the light comes
            EXPECT_LE(glm::dot(start.ray.origin, w), -r);
            const Vec3 p = start.ray.origin;
            return std::optional(
                glm::dvec2(glm::dot(p, frame.x) / (2 * r) + 0.5, glm::dot(p, frame.y) / (2 * r) + 0.5));
        };
        const auto density = [&](const glm::dvec2& p) {
            const glm::dvec2 q = 2.0 * p - 1.0;
            if (q.x * q.x + q.y * q.y >= 1.0) return 0.0;
            const auto first = y0({0.5, 0.5, 0.5, 0.5});
            const double pdf_area =
                pdf_area_emission_direction(world, first.y0, facing_vertex(first.y0, w));
            return pdf_area * 4.0 * 3.0; // the square is (2 r)^2
        };
        transport_test::expect_samples_follow_density(sample, density, transport_test::coarse, 64);
        transport_test::expect_samples_follow_density(sample, density, transport_test::fine, 24);
        return;
    }
    const auto sample = [&](const ref::Uniforms& u) { return std::optional(y0(u).ray.direction); };
    const ref::Vertex start = y0({0.5, 0.5, 0.5, 0.5}).y0;
    const auto density = [&](const Vec3& w) { // distance 1, facing: per area is per solid angle
        return pdf_area_emission_direction(world, start, facing_vertex(start, w));
    };
    transport_test::expect_directions_follow_density(sample, density, transport_test::coarse, 100);
    transport_test::expect_directions_follow_density(sample, density, transport_test::fine, 20);
}

// The density of y1 per area is the density per solid angle times cosine over squared distance: at
// three times the distance and 60 degrees tilt it is an eighteenth; from infinity a half.
TEST_P(Emission, DensityAtTheNextVertexIsPerArea) // map: area-conversion, density-y1
{
    const auto start = *sample_emission(world, {chooses, 0.3, 0.6, 0.5}, {0.4, 0.7, 0.5, 0.5});
    const Vec3 w = start.ray.direction;
    ref::Vertex near = facing_vertex(start.y0, w);
    ref::Vertex far = near;
    far.point.position = start.y0.point.position + 3.0 * w;
    const ref::Frame frame(w);
    far.point.normal = 0.5 * frame.z + std::sqrt(0.75) * frame.x;
    const bool infinite = start.y0.kind == ref::Vertex::Kind::infinity;
    const double expected = pdf_area_emission_direction(world, start.y0, near) / (infinite ? 2.0 : 18.0);
    EXPECT_GT(expected, 0.0);
    EXPECT_NEAR(pdf_area_emission_direction(world, start.y0, far), expected, 1e-13 * expected);
}

// Positions are uniform on a surface, with density P / A. Directions of the environment are uniform,
// with P / 4 pi. Each of the other emitters has one position, with probability P.
TEST_P(Emission, PositionsFollowTheirDensity) // map: density-y0
{
    const EmitterKind kind = GetParam();
    const double probability = probability_of(scene, kind);
    const auto y0 = [&](const ref::Uniforms& u) {
        return sample_emission(world, {chooses, u[0], u[1], 0.5}, {0.5, 0.5, 0.5, 0.5})->y0;
    };
    const double pdf = pdf_emission_position(y0({0.3, 0.3, 0.5, 0.5}));
    double measure = 1.0;
    if (kind == EmitterKind::triangle) {
        const auto& v = scene.triangles[2].vertices;
        measure = glm::length(glm::cross(v[1] - v[0], v[2] - v[0])) / 2.0;
        const auto sample = [&](const ref::Uniforms& u) {
            const Vec3 p = y0(u).point.position - v[0]; // = b (v1 - v0) + c (v2 - v0), by Gram's rule
            const Vec3 e = v[1] - v[0];
            const Vec3 f = v[2] - v[0];
            const Vec3 n = glm::cross(e, f);
            EXPECT_NEAR(glm::dot(p, n), 0.0, 1e-15);
            return std::optional(glm::dvec2(glm::dot(glm::cross(p, f), n) / glm::dot(n, n),
                                            glm::dot(glm::cross(e, p), n) / glm::dot(n, n)));
        };
        const auto density = [](const glm::dvec2& b) { return b.x + b.y < 1.0 ? 2.0 : 0.0; };
        transport_test::expect_samples_follow_density(sample, density, transport_test::coarse, 64);
        transport_test::expect_samples_follow_density(sample, density, transport_test::fine, 64);
    } else if (kind == EmitterKind::sphere || kind == EmitterKind::environment) {
        measure = kind == EmitterKind::sphere ? 4 * pi * 0.09 : 4 * pi;
        const auto sample = [&](const ref::Uniforms& u) {
            const auto y = y0(u);
            return std::optional(kind == EmitterKind::environment
                                     ? y.towards
                                     : (y.point.position - scene.spheres[0].center) / 0.3);
        };
        const auto uniform = [](const Vec3&) { return 1.0 / (4 * pi); };
        transport_test::expect_directions_follow_density(sample, uniform, transport_test::coarse, 1);
        transport_test::expect_directions_follow_density(sample, uniform, transport_test::fine, 1);
    } else {
        const ref::Vertex a = y0({0.2, 0.9, 0.5, 0.5});
        const ref::Vertex b = y0({0.7, 0.1, 0.5, 0.5});
        EXPECT_EQ(a.point.position, b.point.position);
        EXPECT_EQ(a.towards, b.towards);
    }
    EXPECT_NEAR(pdf, probability / measure, 1e-14 * pdf);
}

// The mean of the initial weights of light walks is the flux of all emitters; the mean over the walks
// from one kind is the flux of that kind. These numbers are exact: for all kinds except the spot every
// walk has the same weight, so that one walk is enough; the weight of the spot is a smooth function of
// one number, integrated by midpoints (1e-6: second order in 1 / 4096).
// map: emission-surface, emission-point, emission-spot, emission-directional, emission-environment
TEST_P(Emission, WalksCarryTheFluxOfTheirEmitter)
{
    const EmitterKind kind = GetParam();
    const double probability = probability_of(scene, kind);
    constexpr int steps = 4096;
    Rgb mean(0.0);
    for (int i = 0; i < steps; ++i)
        mean +=
            sample_emission(world, {chooses, 0.3, 0.6, 0.5}, {(i + 0.5) / steps, 0.4, 0.5, 0.5})->alpha /
            static_cast<double>(steps);
    for (int channel = 0; channel < 3; ++channel) {
        const double expected = flux(scene, kind)[channel] / probability;
        EXPECT_NEAR(mean[channel], expected, 1e-6 * expected);
    }
    // The alpha of y0 is 1 / the density of its position.
    const auto start = sample_emission(world, {chooses, 0.3, 0.6, 0.5}, {0.4, 0.4, 0.5, 0.5});
    EXPECT_NEAR(start->y0.alpha.x * pdf_emission_position(start->y0), 1.0, 1e-14);
}

// alpha is the emission, times the cosine on a surface, over both densities.
TEST_P(Emission, WeightIsEmissionOverDensity)
{
    for (int i = 0; i < 100; ++i) {
        const auto start =
            *sample_emission(world, {chooses, 0.3, 0.6, 0.5}, {(i + 0.5) / 100, 0.37, 0.5, 0.5});
        const Vec3 w = start.ray.direction;
        const ref::Vertex y1 = facing_vertex(start.y0, w);
        const double density =
            pdf_emission_position(start.y0) * pdf_area_emission_direction(world, start.y0, y1);
        const Rgb expected = emitted(world, start.y0, y1) * cosine(start.y0, w) / density;
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(start.alpha[channel], expected[channel], 1e-12 * expected[channel]);
    }
}

// Without an emitter there is no walk; a black emitter is never chosen.
TEST(EmissionOfNothing, StartsNoWalk)
{
    scenes::Scene dark = with_one_emitter(EmitterKind::point);
    dark.point_lights[0].intensity = Rgb(0.0);
    const ref::World world(dark, 4, 4);
    EXPECT_FALSE(sample_emission(world, {0.5, 0.5, 0.5, 0.5}, {0.5, 0.5, 0.5, 0.5}).has_value());
}

// The walks of a single emitter carry exactly its flux, since the choice is certain.
TEST(EmissionOfOne, CarriesItsFluxAlone)
{
    for (const EmitterKind kind : kinds) {
        const scenes::Scene scene = with_one_emitter(kind);
        const ref::World world(scene, 4, 4);
        constexpr int steps = 4096;
        Rgb mean(0.0);
        for (int i = 0; i < steps; ++i)
            mean +=
                sample_emission(world, {0.5, 0.3, 0.6, 0.5}, {(i + 0.5) / steps, 0.4, 0.5, 0.5})->alpha /
                static_cast<double>(steps);
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(mean[channel], flux(scene, kind)[channel], 1e-6 * mean[channel]);
    }
}

// Nothing in the scene may lie behind the start of a walk from infinity: it would get no light, and
// would cast no shadow.
TEST(EmissionFromInfinity, StartsBeforeTheBallAroundTheScene)
{
    for (const EmitterKind kind : {EmitterKind::directional, EmitterKind::environment}) {
        const scenes::Scene scene = with_one_emitter(kind);
        const ref::World world(scene, 4, 4);
        for (int i = 0; i < 100; ++i) {
            const auto start =
                *sample_emission(world, {0.5, 0.3, 0.6, 0.5}, {(i + 0.5) / 100, 0.37, 0.5, 0.5});
            EXPECT_LT(glm::dot(start.ray.origin, start.ray.direction), -std::sqrt(3.0));
        }
    }
}

} // namespace
