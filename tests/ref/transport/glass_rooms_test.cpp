// Cameras and lights inside glass. Light that crosses a boundary once has a factor eta^2, which
// cancels where light goes in and out again. The formulas are in the comments at the heads of the
// scenes.

#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/known_light.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

namespace {

using ref::Contribution;
using ref::Rgb;
using ref::Vec3;
using transport_test::Line;

constexpr int width = 36;
constexpr int height = 24;

class GlassRooms : public transport_test::OfEveryIntegrator {};

INSTANTIATE_TEST_SUITE_P(Integrators, GlassRooms, transport_test::integrators(),
                         transport_test::name_of);

int by_edges(const Contribution& c)
{
    return edges(c);
}

double index_of(const scenes::Scene& scene)
{
    for (const auto& material : scene.materials)
        if (const auto* glass = std::get_if<scenes::Glass>(&material)) return glass->ior;
    throw std::logic_error("no glass in " + scene.name);
}

/// Sine of the angle between the line and the normal where it meets the sphere around `center`, from
/// inside or outside.
double sine_at(const Line& line, const Vec3& center, double radius)
{
    return glm::length(glm::cross(line.from - center, line.direction)) / radius;
}

// A ray inside a ball meets it at the same angle at every reflection. If it is totally reflected it
// never leaves; otherwise every single sample has n^2 times the radiance of the sky. Rays within 1e-9
// of the critical angle are left out.
TEST(GlassRoomsBySample, OutOfGlassTheSkyIsEtaSquaredBrighterOrNotThere) // map: eta-squared
{
    const scenes::Scene scene = transport_test::our_scene("camera_in_glass_furnace");
    const ref::World world(scene, width, height);
    const double n = index_of(scene);
    int lit = 0;
    int dark = 0;
    transport_test::for_every_sample(
        world, ref::trace_path, {.seed = 41, .max_edges = 200, .roulette = false}, 8,
        [&](const Line& line, const std::vector<Contribution>& all) {
            const double sine = sine_at(line, Vec3(0.0), 1.0);
            if (std::abs(n * sine - 1.0) < 1e-9) return;
            if (n * sine > 1.0) {
                ++dark;
                ASSERT_TRUE(all.empty());
                return;
            }
            ++lit;
            // Reflected 199 times: F^199, which is below 1e-9 except for n sine > 0.999.
            if (all.empty() && n * sine > 0.999) return;
            ASSERT_EQ(all.size(), 1u);
            for (int i = 0; i < 3; ++i)
                ASSERT_NEAR(all[0].value[i] * all[0].weight, n * n * (*scene.environment)[i], 1e-12);
        });
    EXPECT_GT(dark, 500);
    EXPECT_GT(lit, 2000);
}

// With k edges, the last of which leaves the glass: n^2 Le (1 - F) F^(k-2).
TEST_P(GlassRooms, TheSkyOutOfGlassAfterEachNumberOfReflections)
{
    const scenes::Scene scene = transport_test::our_scene("camera_in_glass_furnace");
    const ref::World world(scene, width, height);
    const double n = index_of(scene);
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(16), .path = {.seed = 42, .max_edges = 6}}, 4,
        by_edges);
    for (int k = 2; k <= 3; ++k) {
        const auto known = transport_test::known_picture(
            *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
                const double f = transport_test::reflectance(sine_at(line, Vec3(0.0), 1.0), n, 1.0);
                return n * n * *scene.environment * (1.0 - f) * std::pow(f, k - 2);
            });
        SCOPED_TRACE(std::to_string(k) + " edges");
        // Most samples have two edges, and 4 to 10 percent have three.
        transport_test::expect_picture(batches[static_cast<std::size_t>(k)], known,
                                       GetParam().bias(k == 2 ? 0.01 : 0.1));
    }
}

// Roulette on long walks through glass: the sum over all lengths is n^2 Le again.
TEST_P(GlassRooms, AllTheSkyComesOutOfGlassInTheEnd)
{
    const scenes::Scene scene = transport_test::our_scene("camera_in_glass_furnace");
    const ref::World world(scene, width, height);
    const double n = index_of(scene);
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(8), .path = {.seed = 43}});
    const auto known = transport_test::known_picture(*scene.camera, width, height,
                                                     [&](const Line& line) -> std::optional<Rgb> {
                                                         if (n * sine_at(line, Vec3(0.0), 1.0) > 1.0)
                                                             return Rgb(0.0);
                                                         return n * n * *scene.environment;
                                                     });
    // The pixels that contain the critical angle are known only to the accuracy of 8 x 8 points: a
    // thousandth of the whole picture.
    transport_test::expect_picture(batches, known, GetParam().bias(0.01), 1);
}

TEST_P(GlassRooms, TheSpherePictureSeenOutOfGlass)
{
    const scenes::Scene scene = transport_test::our_scene("camera_in_glass");
    const ref::World world(scene, width, height);
    const double n = index_of(scene);
    const auto& lamp = scene.spheres.at(0);
    const Rgb radiance = std::get<scenes::Emission>(scene.materials[lamp.material]).radiance;
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(16), .path = {.seed = 44, .max_edges = 4}}, 5,
        by_edges);
    for (int k = 2; k <= 3; ++k) {
        const auto known = transport_test::known_picture(
            *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
                const auto boundary = transport_test::first_seen(scene, line);
                const double cosine = std::abs(glm::dot(line.direction, boundary->normal));
                const double f = transport_test::reflectance(std::sqrt(1.0 - cosine * cosine), n, 1.0);
                const auto seen = transport_test::first_seen(
                    scene, transport_test::refracted(line, *boundary, n, 1.0));
                const double through = n * n * (1.0 - f);
                if (transport_test::is<scenes::Emission>(scene, seen))
                    return k == 2 ? through * radiance : Rgb(0.0);
                if (k == 2 || !seen) return Rgb(0.0);
                return through * transport_test::albedo_at(scene, *seen) / transport_test::pi *
                       radiance *
                       transport_test::sphere_irradiance(seen->point, {0.0, 0.0, 1.0}, lamp.center,
                                                         lamp.radius);
            });
        SCOPED_TRACE(std::to_string(k) + " edges");
        transport_test::expect_picture(batches[static_cast<std::size_t>(k)], known,
                                       GetParam().bias(0.05), k == 2 ? 1 : 4);
    }
    for (const auto& batch : batches[1]) EXPECT_EQ(batch, images::Image(width, height));
}

TEST_P(GlassRooms, ASphereInsideGlassLightsThePlaneLikeAPoint)
{
    const scenes::Scene scene = transport_test::our_scene("light_in_glass");
    const ref::World world(scene, width, height);
    const double n = index_of(scene);
    const auto is_glass = [&](const scenes::Sphere& sphere) {
        return std::holds_alternative<scenes::Glass>(scene.materials[sphere.material]);
    };
    const auto& ball = *std::find_if(scene.spheres.begin(), scene.spheres.end(), is_glass);
    const auto& lamp = *std::find_if_not(scene.spheres.begin(), scene.spheres.end(), is_glass);
    const Rgb radiance = std::get<scenes::Emission>(scene.materials[lamp.material]).radiance;
    const double apparent_radius = n * lamp.radius;
    // I / L by the midpoint rule over s^2; the integrand is smooth, so the error is of order 1e-8.
    double intensity = 0.0;
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
        const double s = apparent_radius * std::sqrt((i + 0.5) / steps);
        intensity += transport_test::pi / (n * n) *
                     (1.0 - transport_test::reflectance(s / ball.radius, 1.0, n)) * apparent_radius *
                     apparent_radius / steps;
    }
    EXPECT_NEAR(intensity, 0.1204983530, 1e-8); // as in the comment at the head of the scene

    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(32), .path = {.seed = 45, .max_edges = 3}}, 4,
        by_edges);
    for (int k = 2; k <= 3; ++k) {
        const auto known = transport_test::known_picture(
            *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
                const auto seen = transport_test::first_seen(scene, line);
                if (transport_test::is<scenes::Glass>(scene, seen)) {
                    const double s = sine_at(line, ball.center, 1.0);
                    if (k == 3 || s > apparent_radius) return Rgb(0.0);
                    return (1.0 - transport_test::reflectance(s / ball.radius, 1.0, n)) * radiance /
                           (n * n);
                }
                if (k == 2) return Rgb(0.0);
                const Vec3 to_lamp = ball.center - seen->point;
                const double d = glm::length(to_lamp);
                return transport_test::albedo_at(scene, *seen) / transport_test::pi * intensity *
                       radiance * to_lamp.z / (d * d * d);
            });
        SCOPED_TRACE(std::to_string(k) + " edges");
        // A few percent of the walks from the plane find the sphere in the ball.
        transport_test::expect_picture(batches[static_cast<std::size_t>(k)], known,
                                       GetParam().bias(k == 2 ? 0.03 : 0.18), k == 2 ? 1 : 2);
    }
    for (const auto& batch : batches[1]) EXPECT_EQ(batch, images::Image(width, height));
}

// Seen through the boundary, the sphere inside has radiance L / n^2 in every sample that is not
// reflected. A line that passes the centre at more than n a does not see it.
TEST(GlassRoomsBySample, ASphereInsideGlassIsSeenMagnifiedAndDimmed)
{
    const scenes::Scene scene = transport_test::our_scene("light_in_glass");
    const ref::World world(scene, width, height);
    const double n = index_of(scene);
    const Vec3 center = scene.spheres.at(0).center;
    const double a = std::min(scene.spheres[0].radius, scene.spheres.at(1).radius);
    int seen_samples = 0;
    transport_test::for_every_sample(world, ref::trace_path, {.seed = 46, .max_edges = 2}, 16,
                                     [&](const Line& line, const std::vector<Contribution>& all) {
                                         const double s = sine_at(line, center, 1.0);
                                         if (all.empty() || std::abs(s - n * a) < 1e-9) return;
                                         ASSERT_LT(s, n * a);
                                         ASSERT_EQ(all.size(), 1u);
                                         ASSERT_NEAR(all[0].value.x * all[0].weight, 12.0 / (n * n),
                                                     1e-11);
                                         ++seen_samples;
                                     });
    EXPECT_GT(seen_samples, 100);
}

// Only the light image finds a point light in glass; an integrator without it must give a black
// picture. With it, the plane at 3 and 4 edges is lit by (1 - F) I and (1 - F) F I: light that leaves
// at once, and after one reflection.
TEST_P(GlassRooms, APointInsideGlassLightsThePlaneForTheLightImageAlone)
{
    const scenes::Scene scene = transport_test::our_scene("point_in_glass");
    const ref::World world(scene, width, height);
    const double n = index_of(scene);
    const auto& light = scene.point_lights.at(0);
    const double f = std::pow((n - 1.0) / (n + 1.0), 2);
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = 8, .path = {.seed = 47, .max_edges = 4}}, 5, by_edges);
    if (!GetParam().light_image) {
        for (const auto& part : batches)
            for (const auto& batch : part) EXPECT_EQ(batch, images::Image(width, height));
        return;
    }
    for (int k = 3; k <= 4; ++k) {
        const auto known = transport_test::known_picture(
            *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
                const auto seen = transport_test::first_seen(scene, line);
                if (!transport_test::is<scenes::Lambertian>(scene, seen)) return std::nullopt;
                const Vec3 d = light.position - seen->point;
                return transport_test::albedo_at(scene, *seen) / transport_test::pi * (1.0 - f) *
                       std::pow(f, k - 3) * light.intensity * d.z / std::pow(glm::length(d), 3);
            });
        SCOPED_TRACE(std::to_string(k) + " edges");
        transport_test::expect_picture(batches[static_cast<std::size_t>(k)], known, k == 3 ? 0.2 : 0.5);
    }
}

} // namespace
