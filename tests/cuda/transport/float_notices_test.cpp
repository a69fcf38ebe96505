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
TEST(FloatNotices, NameEmittersTooSmallToBePlaced)
{
    scenes::Scene scene = ground();
    scene.materials[1] = scenes::Emission{scenes::Rgb(1.0)};
    scene.triangles.push_back(speck(1e-3));
    EXPECT_TRUE(fast::float_notices(scene).empty());
    scene.triangles.push_back(speck(1e-5));
    ASSERT_EQ(fast::float_notices(scene).size(), 1u);
    EXPECT_TRUE(fast::float_notices(scene)[0].starts_with(
        "1 surface(s), first triangle 3 (material \"dust\"), emit and are so small"));
}

TEST(FloatNotices, NameAnEyeTooFarAway)
{
    scenes::Scene scene = ground();
    scenes::Camera camera{
        Vec3(0, 0, 2e4), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.0};
    scene.camera = camera; // the diagonal is 2.8
    EXPECT_TRUE(fast::float_notices(scene).empty());
    scene.camera->eye = Vec3(0, 0, 2e5);
    ASSERT_EQ(fast::float_notices(scene).size(), 1u);
    EXPECT_TRUE(fast::float_notices(scene)[0].starts_with("the eye is 7.07e+04 diagonals away"))
        << fast::float_notices(scene)[0];
}

TEST(FloatNotices, NameFieldsOfViewBeyondTheLimits)
{
    scenes::Scene scene = ground();
    scene.camera = scenes::Camera{
        Vec3(0, 0, 2), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.0};
    for (const double degrees : {0.2, 90.0, 179.5}) {
        scene.camera->fov = degrees * 3.14159265358979 / 180;
        EXPECT_TRUE(fast::float_notices(scene).empty()) << degrees;
    }
    for (const double degrees : {0.1, 179.7}) {
        scene.camera->fov = degrees * 3.14159265358979 / 180;
        ASSERT_EQ(fast::float_notices(scene).size(), 1u) << degrees;
        EXPECT_TRUE(fast::float_notices(scene)[0].starts_with("a field of view of"));
    }
}

TEST(FloatNotices, NameGlassBeyondTheLimits)
{
    scenes::Scene scene = ground();
    const auto notices_for = [&](double ior) {
        scene.materials[1] = scenes::Glass{scenes::Rgb(1.0), scenes::Rgb(1.0), ior};
        return fast::float_notices(scene);
    };
    for (const double ior : {1.0, 1.0001, 1.5, 0.5, 200.0, 0.005})
        EXPECT_TRUE(notices_for(ior).empty()) << ior;
    for (const double ior : {1.00001, 0.99999, 300.0, 0.003}) {
        ASSERT_EQ(notices_for(ior).size(), 1u) << ior;
        EXPECT_TRUE(notices_for(ior)[0].starts_with("material \"dust\": an index of refraction of"));
    }
}

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
