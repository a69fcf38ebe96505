// Scenes with radiance in closed form. If only the film point is random, every sample is compared;
// otherwise the means per path length. The formulas are in the comments at the heads of the scenes.

#include "ref/transport/path_tracer.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace {

using ref::Rgb;
using ref::Vec3;
using std::numbers::pi;

/// The point where the camera's ray through a film point (in pixels) meets the plane z = 0, computed
/// from the camera's data alone, without any code of ref/.
Vec3 point_on_plane(const scenes::Camera& camera, int width, int height, double x, double y)
{
    const double span = 2.0 * std::tan(camera.fov / 2.0);
    const double pixel = span / (camera.fov_axis == scenes::FovAxis::vertical ? height : width);
    const Vec3 d = -camera.backward + (x - 0.5 * width) * pixel * camera.right -
                   (y - 0.5 * height) * pixel * camera.up;
    return camera.eye - camera.eye.z / d.z * d;
}

Rgb albedo_of_plane(const scenes::Scene& scene)
{
    return std::get<scenes::Lambertian>(scene.materials[scene.triangles[0].material]).albedo;
}

/// Compares the radiance of every sample with the closed form at the point that the sample sees. There
/// is no noise, so the tolerance is rounding: 1e-11 relative, which is 1e5 unit roundoffs, for some
/// tens of operations and their conditioning (a distance from a difference of coordinates, a grazing
/// cosine).
void expect_every_sample(const scenes::Scene& scene, const std::function<Rgb(const Vec3&)>& closed_form,
                         const std::function<bool(const Vec3&)>& undecided)
{
    const ref::World world(scene, 60, 40);
    std::vector<ref::Contribution> contributions;
    int lit = 0;
    for (std::uint32_t pixel = 0; pixel < 60 * 40; ++pixel)
        for (std::uint32_t sample = 0; sample < 4; ++sample) {
            const ref::SampleId id{3, pixel, sample};
            const auto u = ref::uniforms(id, ref::Event::camera);
            const Vec3 p = point_on_plane(*scene.camera, 60, 40, pixel % 60 + u[0], pixel / 60 + u[1]);
            if (undecided(p)) continue;
            contributions.clear();
            ref::trace_path(world, {.seed = 3, .max_edges = 2}, id, contributions);
            Rgb sum(0.0);
            for (const auto& c : contributions) sum += c.weight * c.value;
            const Rgb expected = closed_form(p);
            lit += expected != Rgb(0.0) ? 1 : 0;
            for (int i = 0; i < 3; ++i)
                ASSERT_NEAR(sum[i], expected[i], 1e-11 * expected[i]) << "at " << p.x << ' ' << p.y;
        }
    EXPECT_GT(lit, 1000);
}

bool never(const Vec3& /*p*/)
{
    return false;
}

TEST(ClosedForm, PointLightOverPlane) // map: emission-point
{
    const scenes::Scene scene = transport_test::our_scene("point_over_plane");
    const auto& light = scene.point_lights.at(0);
    expect_every_sample(
        scene,
        [&](const Vec3& p) {
            const double d = glm::length(light.position - p);
            return albedo_of_plane(scene) / pi * light.intensity * light.position.z / (d * d * d);
        },
        never);
}

TEST(ClosedForm, DirectionalLightOverPlaneWithTheShadowOfABall) // map: emission-directional
{
    const scenes::Scene scene = transport_test::our_scene("directional_over_plane");
    const auto& light = scene.directional_lights.at(0);
    const auto& ball = scene.spheres.at(0);
    const auto distance_to_axis = [&](const Vec3& p) {
        return glm::length(glm::cross(p - ball.center, light.direction));
    };
    expect_every_sample(
        scene,
        [&](const Vec3& p) {
            if (distance_to_axis(p) < ball.radius) return Rgb(0.0);
            return albedo_of_plane(scene) / pi * light.irradiance * std::abs(light.direction.z);
        },
        [&](const Vec3& p) { return std::abs(distance_to_axis(p) - ball.radius) < 1e-9; });
}

enum class Blocked { no, yes, undecided };

/// Whether a card (any triangle except the two of the plane) is between two points [Moeller & Trumbore
/// 1997]; unknown within 1e-9 of an edge.
Blocked blocked_by_a_card(const scenes::Scene& scene, const Vec3& from, const Vec3& to)
{
    Blocked answer = Blocked::no;
    const std::uint32_t plane = scene.triangles[0].material;
    for (const auto& [v, material] : scene.triangles) {
        if (material == plane) continue;
        const Vec3 d = to - from;
        const Vec3 h = glm::cross(d, v[2] - v[0]);
        const double det = glm::dot(v[1] - v[0], h);
        const double b1 = glm::dot(from - v[0], h) / det;
        const Vec3 q = glm::cross(from - v[0], v[1] - v[0]);
        const double b2 = glm::dot(d, q) / det;
        const double t = glm::dot(v[2] - v[0], q) / det;
        const double inside = std::min({b1, b2, 1.0 - b1 - b2, t, 1.0 - t});
        if (inside > 1e-9) return Blocked::yes;
        if (inside > -1e-9) answer = Blocked::undecided;
    }
    return answer;
}

TEST(ClosedForm, SpotLightOverPlaneWithTheShadowsOfTwoCards) // map: emission-spot
{
    const scenes::Scene scene = transport_test::our_scene("spot_over_plane");
    const auto& light = scene.spot_lights.at(0);
    const auto cosine = [&](const Vec3& p) {
        return glm::dot(glm::normalize(p - light.position), light.direction);
    };
    int in_shadow = 0;
    expect_every_sample(
        scene,
        [&](const Vec3& p) {
            const double d = glm::length(light.position - p);
            if (cosine(p) < light.cos_cutoff) return Rgb(0.0);
            if (blocked_by_a_card(scene, p, light.position) == Blocked::yes) {
                ++in_shadow;
                return Rgb(0.0);
            }
            return albedo_of_plane(scene) / pi * light.intensity * std::pow(cosine(p), light.exponent) *
                   light.position.z / (d * d * d);
        },
        [&](const Vec3& p) {
            return std::abs(cosine(p) - light.cos_cutoff) < 1e-9 ||
                   blocked_by_a_card(scene, p, light.position) == Blocked::undecided ||
                   blocked_by_a_card(scene, p, scene.camera->eye) !=
                       Blocked::no; // the card itself is visible
        });
    EXPECT_GT(in_shadow, 100);
}

// A sphere wholly above the horizon lights a plane with E = pi L (r/d)^2 cos, for any size of the
// sphere. The whole picture and its quarters are compared with the closed form, integrated over each
// pixel with 16 x 16 points.
TEST(ClosedForm, LuminousSphereOverPlane) // map: weight-of-hit, weight-of-event
{
    const scenes::Scene scene = transport_test::our_scene("sphere_over_plane");
    const auto& ball = scene.spheres.at(0);
    const Rgb radiance = std::get<scenes::Emission>(scene.materials[ball.material]).radiance;
    constexpr int width = 48;
    constexpr int height = 32;
    images::Image expected(width, height);
    constexpr int steps = 16;
    for (int y = 0; y < height * steps; ++y)
        for (int x = 0; x < width * steps; ++x) {
            const Vec3 p =
                point_on_plane(*scene.camera, width, height, (x + 0.5) / steps, (y + 0.5) / steps);
            const Vec3 eye = scene.camera->eye;
            const double past_ball = glm::length(glm::cross(glm::normalize(p - eye), ball.center - eye));
            if (past_ball < ball.radius) continue; // the ball is in front of the plane
            const double d = glm::length(ball.center - p);
            expected.pixels[static_cast<std::size_t>(y / steps * width + x / steps)] +=
                albedo_of_plane(scene) * radiance * std::pow(ball.radius / d, 2) * ball.center.z / d /
                static_cast<double>(steps * steps);
        }

    const ref::World world(scene, width, height);
    const auto batches = transport_test::estimate(
        world, ref::trace_path, {.batches = 32, .batch_size = 64, .path = {.max_edges = 2}}, 2,
        [](const ref::Contribution& c) { return edges(c) - 1; });
    for (const transport_test::Region& region : {transport_test::Region{0, 0, 48, 32},
                                                 {0, 0, 24, 16},
                                                 {24, 0, 48, 16},
                                                 {0, 16, 24, 32},
                                                 {24, 16, 48, 32}})
        for (int channel = 0; channel < 3; ++channel)
            transport_test::expect_mean(transport_test::measure(batches[1], region, channel),
                                        transport_test::mean_over(expected, region, channel), 0.04);
    EXPECT_EQ(batches[0][0].pixels[12 * width + 24].x == 0.0, expected.pixels[12 * width + 24].x != 0.0);
}

// A point of a sphere of radius r is chosen uniformly: at a distance of d >= 10 r its density is at
// least d^2 / (4 pi r^2) >= 25 / pi per solid angle. A bounce has the density cos / pi. So a hit weighs
// at most 1 / 26. A next event weighs 1 / (1 + q) with the quotient q of its two densities, and has the
// value albedo / pi cos L over its own density, which is albedo L q: every weight is known to a few
// roundings. Weights that favour the worse strategy add up to 1 as well; only the noise would show them.
TEST(ClosedForm, ASmallSphereIsLeftToNextEvent) // map: weight-of-hit, weight-of-event
{
    scenes::Scene scene = transport_test::our_scene("sphere_over_plane");
    auto& ball = scene.spheres.at(0);
    ball.radius = 0.05;
    ASSERT_GT(ball.center.z - ball.radius, 10.0 * ball.radius);
    const Rgb radiance = std::get<scenes::Emission>(scene.materials[ball.material]).radiance;
    const Rgb albedo = albedo_of_plane(scene);
    const ref::World world(scene, 48, 32);
    std::vector<ref::Contribution> contributions;
    for (std::uint32_t i = 0; i < 48 * 32 * 64; ++i)
        ref::trace_path(world, {.seed = 4, .max_edges = 2}, {4, i % (48 * 32), i}, contributions);
    int hits = 0;
    int events = 0;
    for (const ref::Contribution& c : contributions) {
        if (edges(c) == 1) continue;
        if (c.s == 0) {
            ++hits;
            EXPECT_LE(c.weight, 1.0 / 26.0);
        } else {
            ++events;
            for (int channel = 0; channel < 3; ++channel) {
                const double q = c.value[channel] / (albedo[channel] * radiance[channel]);
                ASSERT_NEAR(c.weight, 1.0 / (1.0 + q), 1e-14);
            }
        }
    }
    EXPECT_GT(hits, 20);
    EXPECT_GT(events, 1000);
}

// The integrating sphere, with albedo rho and radius R, and a point light of intensity I inside.
// Direct light varies as I cos / d^2. After one bounce, light is the same everywhere: rho^(k-1) I /
// (pi R^2) over paths of k edges.
TEST(ClosedForm, IntegratingSphere)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere");
    const auto& wall = scene.spheres.at(0);
    const auto& light = scene.point_lights.at(0);
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[wall.material]).albedo;
    constexpr int longest = 8;
    const ref::World world(scene, 32, 32);
    const auto batches = transport_test::estimate(
        world, ref::trace_path, {.batches = 32, .batch_size = 16, .path = {.seed = 5}}, longest + 1,
        [](const ref::Contribution& c) { return edges(c); });
    for (int k = 3; k <= longest; ++k)
        for (int channel = 0; channel < 3; ++channel) {
            const double expected = std::pow(rho[channel], k - 1) * light.intensity[channel] /
                                    (pi * wall.radius * wall.radius);
            const auto& b = batches[static_cast<std::size_t>(k)];
            // Roulette begins with the fifth bounce: fewer and fewer paths are as long as that.
            const double specification = k <= 6 ? 0.01 : 0.05;
            transport_test::expect_mean(transport_test::measure(b, {0, 0, 32, 32}, channel), expected,
                                        specification);
            transport_test::expect_mean(transport_test::measure(b, {0, 0, 16, 32}, channel), expected,
                                        2 * specification);
            transport_test::expect_mean(transport_test::measure(b, {8, 16, 32, 32}, channel), expected,
                                        2 * specification);
        }

    // The direct light, sample by sample.
    std::vector<ref::Contribution> contributions;
    for (std::uint32_t pixel = 0; pixel < 32 * 32; ++pixel) {
        const ref::SampleId id{7, pixel, 0};
        contributions.clear();
        ref::trace_path(world, {.seed = 7, .max_edges = 2}, id, contributions);
        ASSERT_EQ(contributions.size(), 1u);
        const auto u = ref::uniforms(id, ref::Event::camera);
        const Vec3 d = world.camera.ray({pixel % 32 + u[0], pixel / 32 + u[1]}).direction;
        const Vec3 f = scene.camera->eye - wall.center;
        const double b = glm::dot(f, d);
        const Vec3 p = f + (-b + std::sqrt(b * b - glm::dot(f, f) + wall.radius * wall.radius)) *
                               d; // from the centre
        const Vec3 l = light.position - wall.center - p;
        const double cosine = glm::dot(-p / wall.radius, glm::normalize(l));
        for (int i = 0; i < 3; ++i) {
            const double expected = rho[i] / pi * light.intensity[i] * cosine / glm::dot(l, l);
            ASSERT_NEAR(contributions[0].value[i], expected, 1e-11 * expected);
        }
    }
}

// Roulette must not change the expectation (possible bugs: not compensated, or divided twice).
TEST(ClosedForm, RouletteChangesNothingInTheMean)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere");
    const ref::World world(scene, 16, 16);
    const auto sum_of_long_paths = [&](bool roulette, std::uint64_t seed) {
        const auto batches = transport_test::estimate(
            world, ref::trace_path,
            {.batches = 64,
             .batch_size = 16,
             .path = {.seed = seed, .max_edges = 10, .roulette = roulette}},
            1, [](const ref::Contribution& c) { return edges(c) >= 6 ? 0 : -1; });
        return transport_test::measure(batches[0], {0, 0, 16, 16}, 0);
    };
    transport_test::expect_equal_means(sum_of_long_paths(true, 1), sum_of_long_paths(false, 2), 0.05);
}

} // namespace
