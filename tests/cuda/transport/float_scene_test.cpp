#include "tests/cuda/transport/float_scene.h"

#include "cuda/scene/scene_arrays.h"
#include "scenes/read_scene.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace {

scenes::Scene all_emitters()
{
    return scenes::read_scene(std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "scenes/all_emitters.dae");
}

/// The scene in which paths are compared is the original one: all places seen from the eye are the
/// same, at another scale, up to the grid.
TEST(FloatScene, KeepsEveryPlace)
{
    const scenes::Scene scene = all_emitters();
    const scenes::Scene moved = fast_transport_test::float_scene(scene);
    const auto from_eye = [](const scenes::Scene& s) {
        std::vector<scenes::Vec3> places;
        const auto add = [&](const scenes::Vec3& x) { places.push_back(x - s.camera->eye); };
        for (const auto& triangle : s.triangles)
            for (const scenes::Vec3& v : triangle.vertices) add(v);
        for (const auto& sphere : s.spheres) add(sphere.center), add(sphere.center + sphere.radius);
        for (const auto& light : s.point_lights) add(light.position);
        for (const auto& light : s.spot_lights) add(light.position);
        return places;
    };
    const auto before = from_eye(scene);
    const auto after = from_eye(moved);
    ASSERT_EQ(before.size(), after.size());
    const double scale =
        std::exp2(std::round(std::log2(glm::length(after[0]) / glm::length(before[0]))));
    const double grid = 0x1p-20; // of a diagonal between 1 and 2; the eye is at a similar distance
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_LE(glm::length(after[i] - scale * before[i]), grid) << i;
    ASSERT_FALSE(scene.point_lights.empty() || scene.spot_lights.empty());
    const double square = scale * scale;
    EXPECT_NEAR(moved.point_lights[0].intensity.x / scene.point_lights[0].intensity.x, square,
                1e-6 * square);
    EXPECT_NEAR(moved.spot_lights[0].intensity.x / scene.spot_lights[0].intensity.x, square,
                1e-6 * square);
}

TEST(FloatScene, IsLeftWhereItIs)
{
    const scenes::Scene scene = fast_transport_test::float_scene(all_emitters());
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    EXPECT_EQ(arrays.place.origin, scenes::Vec3(0));
    EXPECT_EQ(arrays.place.scale, 1);
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(scenes::Vec3(arrays.triangles[i].vertices[k]), scene.triangles[i].vertices[k]);
}

bool is_float(double x)
{
    return static_cast<double>(static_cast<float>(x)) == x;
}

bool is_float(const scenes::Vec3& v)
{
    return is_float(v.x) && is_float(v.y) && is_float(v.z);
}

TEST(FloatScene, HasNothingButFloats)
{
    const scenes::Scene scene = fast_transport_test::float_scene(all_emitters());
    EXPECT_TRUE(is_float(scene.camera->eye) && is_float(scene.camera->right) &&
                is_float(scene.camera->up) && is_float(scene.camera->backward));
    for (const auto& triangle : scene.triangles)
        for (const auto& v : triangle.vertices) EXPECT_TRUE(is_float(v));
    for (const auto& sphere : scene.spheres)
        EXPECT_TRUE(is_float(sphere.center) && is_float(sphere.radius));
    for (const auto& material : scene.materials)
        if (const auto* lambertian = std::get_if<scenes::Lambertian>(&material)) {
            EXPECT_TRUE(is_float(lambertian->albedo));
        }
    for (const auto& light : scene.point_lights)
        EXPECT_TRUE(is_float(light.position) && is_float(light.intensity));
    for (const auto& light : scene.directional_lights)
        EXPECT_TRUE(is_float(light.direction) && is_float(light.irradiance));
    ASSERT_FALSE(scene.spot_lights.empty());
    for (const auto& light : scene.spot_lights)
        EXPECT_TRUE(is_float(light.position) && is_float(light.direction) && is_float(light.intensity) &&
                    is_float(1 - light.cos_cutoff) && is_float(light.exponent));
}

} // namespace
