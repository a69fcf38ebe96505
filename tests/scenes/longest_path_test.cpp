#include "scenes/longest_path.h"

#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

namespace {

using scenes::Scene;
using scenes::Vec3;

/// A camera, a point light, and triangles of these materials: 0 in the plane z = 0, 1 in z = 1, 2
/// upright.
Scene three_triangles(const scenes::Material& low, const scenes::Material& high,
                      const scenes::Material& upright)
{
    Scene scene;
    scene.materials = {low, high, upright};
    scene.material_names.resize(3);
    scene.triangles = {{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, 0},
                       {{Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(2, 1, 0)}, 0},
                       {{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)}, 1},
                       {{Vec3(0, 0, 0), Vec3(1, 0, 1), Vec3(0, 1, 0)}, 2}};
    scene.camera = scenes::Camera{};
    scene.point_lights = {{Vec3(0.0), scenes::Rgb(1.0)}};
    return scene;
}

const scenes::Lambertian grey_wall = {scenes::Rgb(0.5)};
const scenes::Lambertian black_wall = {scenes::Rgb(0.0)};
const scenes::Mirror mirror_wall = {scenes::Rgb(0.5)};
const scenes::Emission lamp_wall = {scenes::Rgb(1.0)};

TEST(LongestPath, IsBoundedOnlyWhereAProofIsKnown)
{
    EXPECT_EQ(longest_path(three_triangles(black_wall, lamp_wall, black_wall)), 1);
    EXPECT_EQ(longest_path(three_triangles(grey_wall, black_wall, lamp_wall)), 2);
    EXPECT_EQ(longest_path(three_triangles(mirror_wall, black_wall, lamp_wall)), 2);
    EXPECT_EQ(longest_path(three_triangles(grey_wall, grey_wall, black_wall)), std::nullopt);
    EXPECT_EQ(longest_path(three_triangles(grey_wall, black_wall, grey_wall)), std::nullopt);
    // In one plane, but across no axis: not recognised.
    EXPECT_EQ(longest_path(three_triangles(black_wall, black_wall, grey_wall)), std::nullopt);
}

TEST(LongestPath, OfASceneWithoutLightOrCameraIsZero)
{
    Scene scene = three_triangles(grey_wall, grey_wall, grey_wall);
    scene.point_lights.clear();
    EXPECT_EQ(longest_path(scene), 0);
    scene = three_triangles(grey_wall, grey_wall, lamp_wall);
    scene.camera.reset();
    EXPECT_EQ(longest_path(scene), 0);
}

TEST(LongestPath, OfASphereThatScattersIsNotBounded)
{
    Scene scene = three_triangles(grey_wall, black_wall, black_wall);
    scene.spheres = {{Vec3(0.0), 1.0, 1}};
    EXPECT_EQ(longest_path(scene), 2);
    scene.spheres = {{Vec3(0.0), 1.0, 0}};
    EXPECT_EQ(longest_path(scene), std::nullopt);
}

TEST(LongestPath, OfOurScenes)
{
    const auto of = [](const char* name) { return longest_path(transport_test::our_scene(name)); };
    for (const char* name : {"point_over_plane", "spot_over_plane", "directional_over_plane",
                             "area_light_over_plane", "sphere_over_plane"})
        EXPECT_EQ(of(name), 2) << name;
    for (const char* name : {"cornell_diffuse", "cornell_glass", "integrating_sphere", "mesh_knot"})
        EXPECT_EQ(of(name), std::nullopt) << name;
}

} // namespace
