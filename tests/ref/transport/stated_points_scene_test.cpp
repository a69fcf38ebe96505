// The radiance that the comment at the head of a scene states for some point.

#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/known_light.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

namespace {

using ref::Rgb;
using ref::Vec3;

struct Stated {
    const char* scene;
    Vec3 point;
    int max_edges;
    Rgb radiance;
    double specification; // the relative bias that must be detectable; 0 where nothing is random
    int samples = 65536;
};

// Specifications follow the noise: next event from a small luminaire hardly varies; a sphere in glass
// is found only by emission hits.
const std::vector<Stated> stated = {
    {"point_over_plane", {0.3, 0.2, 0.0}, 2, {0.54117832, 0.24052370, 0.06013092}, 0.0},
    {"point_over_plane", {-0.5, 0.8, 0.0}, 2, {1.19366207, 0.53051648, 0.13262912}, 0.0},
    {"point_over_plane", {1.5, -0.7, 0.0}, 9, {0.09672431, 0.04298858, 0.01074715}, 0.0},
    {"directional_over_plane", {0.3, 0.2, 0.0}, 2, {0.30557749, 0.15278875, 0.05092958}, 0.0},
    {"directional_over_plane", {0.38, -0.51, 0.0}, 2, {0.30557749, 0.15278875, 0.05092958}, 0.0},
    {"directional_over_plane", {0.1, -0.3, 0.0}, 2, {0.0, 0.0, 0.0}, 0.0},
    {"directional_over_plane", {0.31, -0.02, 0.0}, 2, {0.0, 0.0, 0.0}, 0.0},
    {"spot_over_plane", {0.3, 0.2, 0.0}, 2, {0.48892399, 0.24446199, 0.08148733}, 0.0},
    {"spot_over_plane", {-0.4, 0.0, 0.0}, 2, {0.25232686, 0.12616343, 0.04205448}, 0.0},
    {"spot_over_plane", {0.1, 0.9, 0.0}, 2, {0.42099431, 0.21049716, 0.07016572}, 0.0},
    {"spot_over_plane", {0.6, 0.0, 0.0}, 2, {0.0, 0.0, 0.0}, 0.0},
    {"spot_over_plane", {-0.15, 0.285, 0.0}, 2, {0.0, 0.0, 0.0}, 0.0},
    {"spot_over_plane", {1.2, 0.5, 0.0}, 2, {0.0, 0.0, 0.0}, 0.0},
    {"integrating_sphere",
     {-0.630960978, 0.474614637, -0.613701222},
     2,
     {0.32145382, 0.25716306, 0.19287229},
     0.0},
    {"integrating_sphere",
     {-0.630960978, 0.474614637, -0.613701222},
     ref::unlimited_edges,
     {0.44877778, 0.66459971, 0.21197089},
     0.015},
    {"sphere_over_plane", {0.3, 0.2, 0.0}, 2, {0.39902700, 0.19951350, 0.06650450}, 0.08},
    {"sphere_over_plane", {1.2, 0.4, 0.0}, 2, {0.08637485, 0.04318743, 0.01439581}, 0.08},
    {"sphere_over_plane", {0.9, -1.0, 0.0}, 2, {0.04497462, 0.02248731, 0.00749577}, 0.08},
    {"area_light_over_plane", {0.3, 0.2, 0.0}, 2, {0.07394154, 0.03943549, 0.01478831}, 0.03},
    {"area_light_over_plane", {-0.5, 1.1, 0.0}, 2, {0.32815184, 0.17501432, 0.06563037}, 0.03},
    {"area_light_over_plane", {0.5, 1.2, 0.0}, 2, {0.11907258, 0.06350538, 0.02381452}, 0.03},
    {"area_light_over_plane", {0.6, -0.5, 0.0}, 2, {0.0, 0.0, 0.0}, 0.0},
    {"flush_lights", {0.3, 0.2, 0.0}, 2, {0.28125007, 0.21660123, 0.05149279}, 0.05},
    {"flush_lights", {-0.5, -0.9, 0.0}, 2, {0.12295222, 0.09858120, 0.02223282}, 0.05},
    {"flush_lights", {1.2, 0.6, 0.0}, 2, {0.11649049, 0.09363935, 0.02104731}, 0.05},
    {"flush_lights", {-0.6, 1.15, 0.92}, 2, {10.0, 8.0, 6.0}, 0.0},
    {"near_occluder", {1.3, 0.3, 0.0}, 2, {0.02465740, 0.01278532, 0.00456619}, 0.005},
    {"near_occluder", {1.5, -1.2, 0.0}, 2, {0.00541048, 0.00280544, 0.00100194}, 0.005},
    {"mirror_image", {0.3, 0.2, 0.0}, 4, {0.35665962, 0.17994951, 0.07565383}, 0.1},
    {"mirror_image", {0.7, 1.2, 0.0}, 4, {0.13619606, 0.07387099, 0.03318498}, 0.15},
    {"mirror_image", {0.9, -1.0, 0.0}, 4, {0.02209557, 0.01143292, 0.00492419}, 0.25},
    {"light_in_glass", {0.3, 0.2, 0.0}, 3, {0.28696887, 0.15942715, 0.06377086}, 0.15},
    {"camera_in_glass_furnace", {-0.2, 0.2, -0.7}, ref::unlimited_edges, {1.8, 1.35, 0.9}, 0.01},
    {"ceiling_lamp", {0.4, 0.4, 2.5}, 2, {3.5979148, 3.0222484, 2.3026655}, 0.02, 20000},
    {"ceiling_lamp", {0.9, 0.0, 2.5}, 2, {1.8410999, 1.5465239, 1.1783040}, 0.02, 20000},
    {"integrating_sphere_lamp",
     {-0.6, 0.0, -0.8},
     ref::unlimited_edges,
     {0.41284404, 0.79411765, 0.08801956},
     0.08},
};

void PrintTo(const Stated& s, std::ostream* out)
{
    *out << s.scene << " at " << s.point.x << ' ' << s.point.y << ' ' << s.point.z;
}

class StatedPoint : public testing::TestWithParam<Stated> {};

INSTANTIATE_TEST_SUITE_P(Scenes, StatedPoint, testing::ValuesIn(stated), [](const auto& point) {
    return std::string(point.param.scene) + "_" + std::to_string(point.index);
});

/// Turns a camera to look at `point` through a field of view so narrow that the radiance is constant
/// in it: it varies by 1e-9 times a slope of radiance over distance of about 1.
void look_at(scenes::Camera& camera, const Vec3& point)
{
    camera.backward = glm::normalize(camera.eye - point);
    camera.right = glm::normalize(glm::cross(Vec3(0.0, 0.0, 1.0), camera.backward));
    camera.up = glm::cross(camera.backward, camera.right);
    camera.fov = 1e-10;
}

TEST_P(StatedPoint, IsAsBrightAsTheSceneSays)
{
    const Stated& s = GetParam();
    scenes::Scene scene = transport_test::our_scene(s.scene);
    look_at(*scene.camera, s.point);
    const ref::World world(scene, 1, 1);
    const ref::PathOptions path{.seed = 61, .max_edges = s.max_edges};
    if (s.specification > 0.0) {
        const auto batches = transport_test::estimate(
            world, ref::trace_path, {.batches = 32, .batch_size = s.samples / 32, .path = path});
        for (int channel = 0; channel < 3; ++channel)
            transport_test::expect_mean(transport_test::measure(batches, {0, 0, 1, 1}, channel),
                                        s.radiance[channel], s.specification);
        return;
    }
    // The scene states eight decimals.
    const auto batches =
        transport_test::estimate(world, ref::trace_path, {.batches = 1, .batch_size = 16, .path = path});
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(batches[0].pixels[0][channel], s.radiance[channel], 0.6e-8);
}

} // namespace
