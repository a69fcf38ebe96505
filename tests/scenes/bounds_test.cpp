#include "scenes/bounds.h"
#include "scenes/frame.h"
#include "scenes/read_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace {

using scenes::Scene;
using scenes::Vec3;

/// Whole numbers and their sums, differences and halves are exact.
rc::Gen<Vec3> whole_point()
{
    const auto whole =
        rc::gen::map(rc::gen::inRange(-1000, 1000), [](int i) { return static_cast<double>(i); });
    return rc::gen::construct<Vec3>(whole, whole, whole);
}

Scene random_geometry()
{
    Scene scene;
    const int triangles = *rc::gen::inRange(0, 4);
    const int spheres = *rc::gen::inRange(triangles == 0 ? 1 : 0, 4);
    for (int i = 0; i < triangles; ++i)
        scene.triangles.push_back({{*whole_point(), *whole_point(), *whole_point()}, 0});
    for (int i = 0; i < spheres; ++i)
        scene.spheres.push_back({*whole_point(), static_cast<double>(*rc::gen::inRange(1, 100)), 0});
    scene.camera =
        scenes::Camera{Vec3(7, 8, 9),          Vec3(0.8, 0.6, 0),           Vec3(-0.36, 0.48, 0.8),
                       Vec3(0.48, -0.64, 0.6), scenes::FovAxis::horizontal, 1.0};
    return scene;
}

TEST(Bounds, ASceneWithoutGeometryHasNone)
{
    EXPECT_FALSE(scenes::bounds(Scene()).has_value());
}

RC_GTEST_PROP(Bounds, EverythingIsInsideAndEverySideIsTouched, ())
{
    const Scene scene = random_geometry();
    const scenes::Bounds box = *scenes::bounds(scene);
    for (int axis = 0; axis < 3; ++axis) {
        bool low = false;
        bool high = false;
        const auto look = [&](double from, double to) {
            RC_ASSERT(box.min[axis] <= from && to <= box.max[axis]);
            low = low || from == box.min[axis];
            high = high || to == box.max[axis];
        };
        for (const auto& triangle : scene.triangles)
            for (const Vec3& vertex : triangle.vertices) look(vertex[axis], vertex[axis]);
        for (const auto& sphere : scene.spheres)
            look(sphere.center[axis] - sphere.radius, sphere.center[axis] + sphere.radius);
        RC_ASSERT(low && high);
    }
}

RC_GTEST_PROP(FrameCamera, TheEyeStandsOneAndAHalfDiagonalsBeforeTheCentreAndNothingElseChanges, ())
{
    Scene scene = random_geometry();
    const scenes::Camera before = *scene.camera;
    scenes::frame_camera(scene);
    const scenes::Camera& after = *scene.camera;
    RC_ASSERT(after.right == before.right && after.up == before.up && after.backward == before.backward);
    RC_ASSERT(after.fov == before.fov && after.fov_axis == before.fov_axis);

    const scenes::Bounds box = *scenes::bounds(scene);
    const Vec3 center = (box.min + box.max) / 2.0;
    const double diagonal = glm::distance(box.min, box.max);
    // Rounding: about ten operations on numbers up to 6000 (coordinates, diagonal): 10 * 6000 * 2^-53 <
    // 1e-11.
    RC_ASSERT(glm::length(after.eye - (center + 1.5 * diagonal * before.backward)) < 1e-11);
}

RC_GTEST_PROP(FrameCamera, WhereTheCameraStoodDoesNotMatter, ())
{
    Scene scene = random_geometry();
    Scene moved = scene;
    moved.camera->eye = *whole_point();
    scenes::frame_camera(scene);
    scenes::frame_camera(moved);
    RC_ASSERT(scene.camera->eye == moved.camera->eye);
    scenes::frame_camera(moved);
    RC_ASSERT(scene.camera->eye == moved.camera->eye); // a second call changes nothing
}

TEST(FrameCamera, WithoutACameraOrGeometryThereIsAnError)
{
    Scene no_geometry;
    no_geometry.camera = scenes::Camera{};
    EXPECT_THROW(scenes::frame_camera(no_geometry), scenes::SceneError);

    Scene no_camera;
    no_camera.spheres.push_back({Vec3(0.0), 1.0, 0});
    EXPECT_THROW(scenes::frame_camera(no_camera), scenes::SceneError);

    Scene too_large = no_camera;
    too_large.camera = scenes::Camera{};
    too_large.spheres[0].radius = std::numeric_limits<double>::max();
    EXPECT_THROW(scenes::frame_camera(too_large), scenes::SceneError);
    EXPECT_EQ(too_large.camera->eye, Vec3(0.0)); // unchanged
}

// The numbers are those of scenes/frame.h: along (-1, 2, -1) with z up, at 45 degrees horizontally.
RC_GTEST_PROP(AddCamera, SeesTheSceneFromTheFrontRightAndAbove, ())
{
    Scene scene = random_geometry();
    scene.camera.reset();
    scenes::add_camera(scene);
    const scenes::Camera& camera = *scene.camera;
    const double eps = 1e-15; // three operations on numbers up to 1
    RC_ASSERT(glm::distance(camera.backward, Vec3(1, -2, 1) / std::sqrt(6.0)) < eps);
    RC_ASSERT(std::abs(camera.right.z) < eps && camera.right.x > 0 && camera.up.z > 0);
    RC_ASSERT(std::abs(glm::length(camera.right) - 1) < eps &&
              std::abs(glm::length(camera.up) - 1) < eps);
    RC_ASSERT(glm::distance(glm::cross(camera.right, camera.up), camera.backward) < eps);
    RC_ASSERT(camera.fov_axis == scenes::FovAxis::horizontal);
    RC_ASSERT(std::abs(camera.fov - std::acos(-1.0) / 4) < eps);

    const Vec3 eye = camera.eye;
    scenes::frame_camera(scene);
    RC_ASSERT(scene.camera->eye == eye);
    RC_ASSERT(scene.notices.size() == 1u);
}

TEST(AddCamera, WithoutGeometryThereIsAnError)
{
    Scene nothing;
    EXPECT_THROW(scenes::add_camera(nothing), scenes::SceneError);
}

} // namespace
