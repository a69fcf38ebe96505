// The notices for scenes that floats cannot represent.

#include "cuda/scene/float_notices.h"

#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using scenes::Vec3;

scenes::Scene ground()
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}, scenes::Lambertian{scenes::Rgb(0.5)}};
    scene.material_names = {"ground", "dust"};
    scene.triangles = {{{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0)}, 0}};
    return scene;
}

/// A triangle of that size at (0.5, 0.4, 0.25).
scenes::Triangle speck(double size)
{
    const Vec3 at(0.5, 0.4, 0.25);
    return {{at, at + Vec3(size, 0, size), at + Vec3(0, size, 0)}, 1};
}

TEST(FloatNotices, SayNothingOfTheScenesHere)
{
    for (const auto& file : transport_test::our_scene_files())
        EXPECT_TRUE(fast::float_notices(scenes::read_scene(file)).empty()) << file;
}

TEST(FloatNotices, NameWhatCollapses)
{
    scenes::Scene scene = ground();
    scene.triangles.push_back({{Vec3(0), Vec3(1, 0, 0), Vec3(1, 0, 0)}, 1}); // no area in double
    EXPECT_TRUE(fast::float_notices(scene).empty());
    scene.triangles.push_back(speck(1e-9));
    scene.triangles.push_back(speck(1e-9));
    ASSERT_EQ(fast::float_notices(scene).size(), 1u);
    EXPECT_EQ(
        fast::float_notices(scene)[0],
        "2 surface(s), first triangle 3 (material \"dust\"), collapse to a line or a point in single "
        "precision: no ray meets them");
}

TEST(FloatNotices, NameWhatIsTooSmallToLeave)
{
    scenes::Scene scene = ground();
    scene.triangles.push_back(speck(1e-5));
    scene.spheres.push_back({Vec3(0.5, 0.4, 0.25), 1e-5, 1});
    EXPECT_TRUE(fast::float_notices(scene).empty());
    scene.spheres.push_back({Vec3(0.5, 0.4, 0.25), 2e-7, 1});
    ASSERT_EQ(fast::float_notices(scene).size(), 1u);
    EXPECT_TRUE(fast::float_notices(scene)[0].starts_with(
        "1 surface(s), first sphere 2 (material \"dust\"), are so small"))
        << fast::float_notices(scene)[0];
    scene.triangles.push_back(speck(2e-7));
    EXPECT_TRUE(fast::float_notices(scene)[0].starts_with("2 surface(s), first triangle 3"))
        << fast::float_notices(scene)[0];
}

TEST(FloatNotices, NameEndsWhoseHeightFloatsCannotResolve)
{
    scenes::Scene scene = ground();
    const auto with_light_at = [&](double height) {
        scene.point_lights = {{Vec3(0.3, 0, height), scenes::Rgb(1.0)}};
        return fast::float_notices(scene);
    };
    EXPECT_TRUE(with_light_at(0.0).empty()); // decided by a rule
    EXPECT_TRUE(with_light_at(1e-5).empty());
    ASSERT_EQ(with_light_at(1e-8).size(), 1u);
    EXPECT_TRUE(
        with_light_at(1e-8)[0].starts_with("point light 1 is closer to a surface (material \"gr"))
        << with_light_at(1e-8)[0];
}

// A pane of glass over the ground, at a distance.
TEST(FloatNotices, NameGlassTooCloseToAnotherSurface)
{
    const auto notices = [](double gap) {
        scenes::Scene scene = ground();
        scene.materials[1] = scenes::Glass{scenes::Rgb(1.0), scenes::Rgb(1.0), 1.5};
        scene.triangles.push_back({{Vec3(0, -0.5, gap), Vec3(0.5, 0, gap), Vec3(0, 0, gap)}, 1});
        return fast::float_notices(scene);
    };
    EXPECT_TRUE(notices(0.0).empty()); // decided by a rule
    EXPECT_TRUE(notices(1e-5).empty());
    ASSERT_EQ(notices(1e-7).size(), 1u);
    EXPECT_TRUE(notices(1e-7)[0].starts_with(
        "1 surface(s), first triangle 2 (material \"dust\"), are of glass and closer to another"))
        << notices(1e-7)[0];
}

} // namespace
