// A scene moved near the origin and scaled to about one unit: what changes, what does not, what fails.

#include "scenes/bounds.h"
#include "scenes/placed.h"
#include "scenes/read_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace {

using scenes::Rgb;
using scenes::Scene;
using scenes::Vec3;

/// A triangle, a sphere, both kinds of lights that have a position, and a camera.
Scene small_scene()
{
    Scene scene;
    scene.name = "small";
    scene.materials = {scenes::Lambertian{Rgb(0.5)}, scenes::Emission{Rgb(3.0)}};
    scene.material_names = {"wall", "lamp"};
    scene.triangles.push_back({{Vec3(0.1, 0.2, 0.3), Vec3(1.7, 0.4, 0.2), Vec3(0.3, 1.9, 0.6)}, 0});
    scene.spheres.push_back({Vec3(0.7, 0.3, 1.1), 0.4, 1});
    scene.point_lights.push_back({Vec3(0.2, 0.9, 2.0), Rgb(1.0, 2.0, 3.0)});
    scene.spot_lights.push_back({Vec3(0.3, 0.1, 1.0), Vec3(0, 0, -1), Rgb(4.0, 5.0, 6.0), 0.5, 2.0});
    scene.camera = scenes::Camera{Vec3(0.5, -3.0, 0.7),
                                  Vec3(1, 0, 0),
                                  Vec3(0, 0, 1),
                                  Vec3(0, -1, 0),
                                  scenes::FovAxis::horizontal,
                                  1.0};
    return scene;
}

/// Multiplies every length by 2^exponent and every intensity by the square of that.
Scene times_power(Scene scene, int exponent)
{
    const auto scale = [&](double x) { return std::ldexp(x, exponent); };
    const auto scale_point = [&](Vec3& v) { v = Vec3(scale(v.x), scale(v.y), scale(v.z)); };
    for (auto& triangle : scene.triangles)
        for (Vec3& v : triangle.vertices) scale_point(v);
    for (auto& sphere : scene.spheres) scale_point(sphere.center), sphere.radius = scale(sphere.radius);
    const auto scale_light = [&](auto& light) {
        scale_point(light.position);
        for (int i = 0; i < 3; ++i) light.intensity[i] = std::ldexp(light.intensity[i], 2 * exponent);
    };
    for (auto& light : scene.point_lights) scale_light(light);
    for (auto& light : scene.spot_lights) scale_light(light);
    scale_point(scene.camera->eye);
    return scene;
}

double diagonal(const Scene& scene)
{
    const scenes::Bounds box = *scenes::bounds(scene);
    return glm::length(box.max - box.min);
}

void expect_same(const Scene& a, const Scene& b)
{
    ASSERT_EQ(a.triangles.size(), b.triangles.size());
    for (std::size_t i = 0; i < a.triangles.size(); ++i)
        EXPECT_EQ(a.triangles[i].vertices, b.triangles[i].vertices);
    for (std::size_t i = 0; i < a.spheres.size(); ++i) {
        EXPECT_EQ(a.spheres[i].center, b.spheres[i].center);
        EXPECT_EQ(a.spheres[i].radius, b.spheres[i].radius);
    }
    EXPECT_EQ(a.point_lights[0].position, b.point_lights[0].position);
    EXPECT_EQ(a.point_lights[0].intensity, b.point_lights[0].intensity);
    EXPECT_EQ(a.spot_lights[0].position, b.spot_lights[0].position);
    EXPECT_EQ(a.spot_lights[0].intensity, b.spot_lights[0].intensity);
    EXPECT_EQ(a.camera->eye, b.camera->eye);
}

RC_GTEST_PROP(Placed, NoPowerOfTwoChangesABit, ())
{
    // Intensities scale with the square: beyond 2^500 they would leave the range of doubles.
    const int exponent = *rc::gen::inRange(-500, 501);
    const Scene once = scenes::placed(small_scene());
    RC_ASSERT(diagonal(once) >= 1.0);
    RC_ASSERT(diagonal(once) < 2.0);
    expect_same(scenes::placed(times_power(small_scene(), exponent)), once);
    expect_same(scenes::placed(once), once);
}

TEST(Placed, RemembersTheUnitOfTheFile)
{
    const Scene scene = small_scene();
    for (const int exponent : {-20, -1, 0, 3}) {
        const Scene here = placed(times_power(scene, exponent));
        EXPECT_EQ(here.unit, here.spheres[0].radius / times_power(scene, exponent).spheres[0].radius);
        EXPECT_EQ(placed(here).unit, here.unit); // once placed, it stays
    }
}

TEST(Placed, TheLargestAndTheSmallestScenesAreHeld)
{
    Scene scene = small_scene();
    scene.point_lights.clear();
    scene.spot_lights.clear();
    for (const int exponent : {1021, 600, -600, -1000}) {
        const Scene here = scenes::placed(times_power(scene, exponent));
        EXPECT_GE(diagonal(here), 1.0) << exponent;
        EXPECT_LT(diagonal(here), 2.0) << exponent;
    }
}

TEST(Placed, ASceneNearTheOriginKeepsItsDigits)
{
    // Its diagonal is between 2 and 4: the scale is 1/2, and nothing moves.
    expect_same(scenes::placed(small_scene()), times_power(small_scene(), -1));
}

TEST(Placed, AFarSceneMovesExactly)
{
    // The moved coordinates are whole multiples of 2^-20: moving there and back loses no digit.
    Scene scene = small_scene();
    const auto rounded = [](Vec3& v) { v = glm::round(v * 0x1p20) / 0x1p20; };
    for (auto& v : scene.triangles[0].vertices) rounded(v);
    rounded(scene.spheres[0].center);
    rounded(scene.point_lights[0].position);
    rounded(scene.spot_lights[0].position);
    rounded(scene.camera->eye);
    const Vec3 far(0x1p30, -0x1p31, 0x1p30);
    Scene moved = scene;
    for (auto& v : moved.triangles[0].vertices) v += far;
    moved.spheres[0].center += far;
    moved.point_lights[0].position += far;
    moved.spot_lights[0].position += far;
    moved.camera->eye += far;
    expect_same(scenes::placed(moved), scenes::placed(scene));
    EXPECT_TRUE(scenes::placed(moved).notices.empty());
}

TEST(Placed, CoordinatesTooFarFromTheOriginAreNoticedAndThenRefused)
{
    const auto moved_by = [](double distance) {
        Scene scene;
        scene.name = "far";
        scene.triangles.push_back({{Vec3(distance), Vec3(distance) + Vec3(1, 0, 0) * distance * 1e-10,
                                    Vec3(distance) + Vec3(0, 1, 0) * distance * 1e-10},
                                   0});
        return scene;
    };
    // Diagonal 1.4e-10 of the distance: doubles are 1.6e-6 diagonals apart.
    EXPECT_EQ(scenes::placed(moved_by(1e5)).notices.size(), 1u);
    Scene scene = small_scene();
    for (auto& v : scene.triangles[0].vertices) v += Vec3(1e15);
    scene.spheres[0].center += Vec3(1e15);
    try {
        scenes::placed(scene);
        FAIL() << "nothing thrown";
    } catch (const scenes::SceneError& error) {
        EXPECT_NE(std::string(error.what()).find("move it to the origin"), std::string::npos)
            << error.what();
    }
}

TEST(Placed, WhatIsNotFiniteIsRefused)
{
    Scene scene = small_scene();
    scene.triangles[0].vertices[1].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(scenes::placed(scene), scenes::SceneError);
    scene = small_scene();
    scene.spheres[0].radius = std::numeric_limits<double>::max();
    scene.spheres[0].center.x = std::numeric_limits<double>::max();
    EXPECT_THROW(scenes::placed(scene), scenes::SceneError);
    scene = small_scene();
    scene.camera->eye.x = std::numeric_limits<double>::infinity();
    EXPECT_THROW(scenes::placed(scene), scenes::SceneError);
}

TEST(Placed, LightThatNoPictureCanHoldIsRefusedByName)
{
    const auto message = [](const Scene& scene) -> std::string {
        try {
            scenes::placed(scene);
        } catch (const scenes::SceneError& error) {
            return error.what();
        }
        return "";
    };
    Scene scene = small_scene();
    scene.materials[1] = scenes::Emission{Rgb(1.0, 1e308, 1.0)};
    EXPECT_NE(message(scene).find("material \"lamp\": a radiance of 1e+308"), std::string::npos)
        << message(scene);
    scene = small_scene();
    scene.point_lights[0].intensity = Rgb(1e308);
    EXPECT_NE(message(scene).find("point light 1"), std::string::npos) << message(scene);
    // The same intensity in a scene of that size is moderate: 1e8 W m^-2 at the distance of a diagonal.
    Scene large = times_power(small_scene(), 498); // 2^498 = 8.2e149
    large.point_lights[0].intensity = Rgb(1e308);
    large.spot_lights.clear();
    EXPECT_EQ(message(large), "");
    scene = small_scene();
    scene.environment = Rgb(std::numeric_limits<double>::infinity());
    EXPECT_NE(message(scene).find("the environment"), std::string::npos) << message(scene);
}

TEST(Placed, LightTooDimForAPictureIsRefused)
{
    const auto message = [](const Scene& scene) -> std::string {
        try {
            scenes::placed(scene);
        } catch (const scenes::SceneError& error) {
            return error.what();
        }
        return "";
    };
    // All light together: a dim light beside a bright one changes nothing, and no light at all is legal.
    const auto lit_by = [](double radiance, double intensity, double sky) {
        Scene scene = small_scene();
        scene.materials[1] = scenes::Emission{Rgb(radiance)};
        scene.point_lights[0].intensity = Rgb(intensity);
        scene.spot_lights.clear();
        scene.environment = Rgb(sky);
        return scene;
    };
    EXPECT_EQ(message(lit_by(0, 0, 0)), "");
    EXPECT_EQ(message(lit_by(1e-31, 1e-300, 1)), "");
    EXPECT_EQ(message(lit_by(1.1e-30, 0, 0)), "");
    EXPECT_EQ(message(lit_by(0, 1e-28, 0)), "");
    for (const Scene& dim : {lit_by(9e-31, 0, 0), lit_by(0, 1e-31, 0), lit_by(0, 0, 9e-31)})
        EXPECT_NE(message(dim).find("is less than the 1e-30 that a picture can hold"), std::string::npos)
            << message(dim);
    // The intensity is that at the new scale: 1e-31 W/sr in a room of 1e-9 m is a bright lamp.
    Scene small = times_power(lit_by(0, 0, 0), -30);
    small.point_lights[0].intensity = Rgb(1e-31);
    EXPECT_EQ(message(small), "");
}

TEST(Placed, NothingToScaleByStaysAsItIs)
{
    Scene scene = small_scene();
    scene.triangles.clear();
    scene.spheres.clear();
    EXPECT_EQ(scenes::placed(scene).point_lights[0].position, small_scene().point_lights[0].position);
    scene.triangles.push_back({{Vec3(1), Vec3(1), Vec3(1)}, 0}); // a point
    EXPECT_EQ(scenes::placed(scene).triangles[0].vertices[0], Vec3(1));
}

} // namespace
