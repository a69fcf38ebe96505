// Bidirectional path tracing and light tracing compared with closed forms, per path length.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using ref::Contribution;
using ref::Rgb;
using ref::Vec3;
using std::numbers::pi;

// Paths from a point light in glass to a scattering plane. Next event is never possible, so a path
// tracer gives a black picture; only the light image finds these paths. With j reflections inside the
// ball E_j = (1-F) F^j I cos / d^2, F = 0.04, at 3 + j edges.
TEST(ClosedFormBothWays, PointInGlassIsSeenByLightWalksAlone)
{
    const scenes::Scene scene = transport_test::our_scene("point_in_glass");
    constexpr int width = 24;
    constexpr int height = 16;
    const ref::World world(scene, width, height);
    const auto& camera = *scene.camera;
    const Vec3 light = scene.point_lights[0].position;
    const Rgb albedo = std::get<scenes::Lambertian>(scene.materials[scene.triangles[0].material]).albedo;
    images::Image expected(width, height); // at 3 edges, green
    constexpr int steps = 16;
    const double pixel = 2.0 * std::tan(camera.fov / 2) / height;
    double beside_the_ball = 0.0;
    for (int y = 0; y < height * steps; ++y)
        for (int x = 0; x < width * steps; ++x) {
            const Vec3 d = -camera.backward + ((x + 0.5) / steps - width / 2.0) * pixel * camera.right -
                           ((y + 0.5) / steps - height / 2.0) * pixel * camera.up;
            const Vec3 p = camera.eye - camera.eye.z / d.z * d;
            const double past =
                glm::length(glm::cross(glm::normalize(d), scene.spheres[0].center - camera.eye));
            if (past < scene.spheres[0].radius) continue; // the plane is seen through the ball
            ++beside_the_ball;
            const double r = glm::length(light - p);
            expected.at(x / steps, y / steps) += 0.96 * scene.point_lights[0].intensity * albedo / pi *
                                                 light.z / (r * r * r) /
                                                 static_cast<double>(steps * steps);
        }
    ASSERT_GT(beside_the_ball, 1000.0);
    for (const auto integrator : {ref::trace_bidirectionally, ref::trace_light}) {
        const auto batches = transport_test::estimate(
            world, integrator, {.batches = 32, .batch_size = 64, .path = {.seed = 5, .max_edges = 4}}, 5,
            [](const Contribution& c) { return c.t == 1 ? edges(c) : -1; });
        for (int channel = 0; channel < 3; ++channel) {
            const double e = transport_test::mean_over(expected, {0, 0, width, height}, channel);
            transport_test::expect_mean(
                transport_test::measure(batches[3], {0, 0, width, height}, channel), e, 0.05);
            transport_test::expect_mean(
                transport_test::measure(batches[4], {0, 0, width, height}, channel), 0.04 * e, 0.3);
        }
    }
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 4096; ++i)
        trace_path(world, {.seed = 5, .max_edges = 6}, {5, i % (width * height), i}, out);
    EXPECT_TRUE(out.empty());
}

// The integrating sphere per path length, as for the path tracer: rho^(k-1) I / (pi R^2).
TEST(ClosedFormBothWays, IntegratingSphereByPathLength)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere");
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[scene.spheres[0].material]).albedo;
    const ref::World world(scene, 16, 16);
    constexpr int longest = 7;
    struct {
        ref::Integrator integrator;
        double specification;
    } const cases[] = {{ref::trace_bidirectionally, 0.01}, {ref::trace_light, 0.08}};
    for (const auto& [integrator, specification] : cases) {
        const auto batches = transport_test::estimate(
            world, integrator,
            {.batches = 32, .batch_size = 12, .path = {.seed = 6, .max_edges = longest}}, longest + 1,
            [](const Contribution& c) { return edges(c); });
        for (int k = 3; k <= longest; ++k)
            for (int channel = 0; channel < 3; ++channel) {
                const double expected =
                    std::pow(rho[channel], k - 1) * scene.point_lights[0].intensity[channel] / pi;
                const auto& b = batches[static_cast<std::size_t>(k)];
                transport_test::expect_mean(transport_test::measure(b, {0, 0, 16, 16}, channel),
                                            expected, k <= 6 ? specification : 3 * specification);
                transport_test::expect_mean(transport_test::measure(b, {3, 8, 16, 16}, channel),
                                            expected, 3 * specification);
            }
    }
}

// A luminous sphere in an integrating sphere. On the wall the radiance is rho L q (rho (1 - q))^(k-2),
// q = 0.09. Pixels that see the lamp or its edge are left out.
TEST(ClosedFormBothWays, IntegratingSphereWithALampByPathLength)
{
    const scenes::Scene scene = transport_test::our_scene("integrating_sphere_lamp");
    const ref::World world(scene, 16, 16);
    std::uint32_t wall_material = 0;
    Rgb radiance(0.0);
    double q = 0.0;
    const scenes::Sphere* lamp = nullptr;
    for (const auto& sphere : scene.spheres)
        if (const auto* e = std::get_if<scenes::Emission>(&scene.materials[sphere.material])) {
            radiance = e->radiance;
            q = sphere.radius * sphere.radius;
            lamp = &sphere;
        } else {
            wall_material = sphere.material;
        }
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[wall_material]).albedo;
    std::vector<int> wall; // pixels whose corners are all well outside the lamp
    for (int i = 0; i < 256; ++i) {
        double nearest = 1.0;
        for (const glm::dvec2 c : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
            const Vec3 d = world.camera.ray({i % 16 + c.x, i / 16 + c.y}).direction;
            nearest = std::min(nearest, glm::length(glm::cross(d, lamp->center - world.camera.eye())));
        }
        if (nearest > 1.2 * lamp->radius) wall.push_back(i);
    }
    ASSERT_GT(wall.size(), 64u);
    constexpr int longest = 6;
    struct {
        ref::Integrator integrator;
        double specification;
    } const cases[] = {{ref::trace_bidirectionally, 0.07}, {ref::trace_light, 0.16}};
    for (const auto& [integrator, specification] : cases) {
        const auto batches = transport_test::estimate(
            world, integrator,
            {.batches = 32, .batch_size = 16, .path = {.seed = 8, .max_edges = longest}}, longest + 1,
            [](const Contribution& c) { return edges(c); });
        for (int k = 2; k <= longest; ++k)
            for (int channel = 0; channel < 3; ++channel) {
                const double expected =
                    rho[channel] * radiance[channel] * q * std::pow(rho[channel] * (1 - q), k - 2);
                std::vector<double> means;
                for (const auto& image : batches[static_cast<std::size_t>(k)]) {
                    double sum = 0.0;
                    for (const int i : wall) sum += image.pixels[static_cast<std::size_t>(i)][channel];
                    means.push_back(sum / static_cast<double>(wall.size()));
                }
                transport_test::expect_mean(transport_test::measure(means), expected, specification);
            }
    }
}

// Total reflection, Fresnel and eta^2 together: n^2 Le (1 - F^(edges - 1)), see the comment at the
// head of the scene. In bidirectional path tracing only the emission hit remains, with weight exactly
// 1.
TEST(ClosedFormBothWays, CameraInGlassSeesTheSkyByHittingItAlone)
{
    const scenes::Scene scene = transport_test::our_scene("camera_in_glass_furnace");
    const ref::World world(scene, 24, 16);
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 24 * 16 * 8; ++i)
        trace_bidirectionally(world, {.seed = 3, .max_edges = 3}, {3, i % (24 * 16), i}, out);
    ASSERT_GT(out.size(), 1000u);
    for (const Contribution& c : out) {
        EXPECT_EQ(c.s, 0);
        EXPECT_EQ(c.weight, 1.0);
        EXPECT_NEAR(c.value.x, 2.25 * scene.environment->x, 1e-14);
    }
}

} // namespace
