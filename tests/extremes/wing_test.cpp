// The methods of an axis that are our own wings, on the host and on a GPU.

#include "extremes/axes/axes.h"
#include "extremes/far/met_points.h"
#include "extremes/glass/glass_case.h"
#include "extremes/grey_scene.h"
#include "extremes/light/small_render.h"
#include "extremes/trees/tree_builds.h"
#include "extremes/trees/tree_rays.h"
#include "extremes/wing.h"

#include "cuda/launch/probes.h"
#include "scenes/placed.h"
#include "tests/cuda/parallel/on_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace {

using namespace extremes;

const auto nothing = [](double, Random&, int, Tally&) {};

Axis axis_with(const std::vector<std::string>& methods)
{
    Axis axis;
    for (const std::string& name : methods) axis.methods.push_back({name, Format::binary32, nothing});
    for (const char* name : {"ref", "host, path", "host"})
        axis.limits.push_back({name, 1.0, [](double) { return 0.5; }, 2.0, Failure::missed, "because"});
    return axis;
}

TEST(WingsOfAxes, TheLimitsOfTheHostHoldOnADevice)
{
    Axis axis = axis_with({"ref", "host, path", "cuda, path", "cuda"});
    add_limits_of_device(axis);
    ASSERT_EQ(axis.limits.size(), 5u);
    EXPECT_EQ(axis.limits[3].method, "cuda, path");
    EXPECT_EQ(axis.limits[4].method, "cuda");
    EXPECT_EQ(axis.limits[4].safe, 1.0);
    EXPECT_EQ(axis.limits[4].bound(1.0), 0.5);
    EXPECT_EQ(axis.limits[4].failure, Failure::missed);
}

TEST(WingsOfAxes, WithoutADeviceNoLimitIsAdded)
{
    Axis axis = axis_with({"ref", "host, path", "host", "cudanoid"});
    add_limits_of_device(axis);
    EXPECT_EQ(axis.limits.size(), 3u);
}

TEST(WingsOfAxes, AreTheReferenceAndTheHostAndWhatIsThere)
{
    const std::vector<Wing> found = wings();
    ASSERT_GE(found.size(), 2u);
    EXPECT_EQ(found[0], Wing::ref);
    EXPECT_EQ(found[1], Wing::host);
    EXPECT_EQ(found.size() == 3u, parallel_test::found_device().usable);
    EXPECT_EQ(format_of(Wing::ref), Format::binary64);
    EXPECT_EQ(format_of(Wing::cuda), Format::binary32);
}

class AxesOnDevice : public parallel_test::OnDevice {};

/// A grey square under a point light, seen from above.
scenes::Scene lit_square()
{
    scenes::Scene scene = grey_scene();
    const scenes::Vec3 a(-0.5, -0.5, 0);
    const scenes::Vec3 b(0.5, -0.5, 0);
    const scenes::Vec3 c(0.5, 0.5, 0);
    const scenes::Vec3 d(-0.5, 0.5, 0);
    scene.triangles = {{{a, b, c}, 0}, {{a, c, d}, 0}};
    scene.point_lights = {{scenes::Vec3(0.1, 0.2, 0.7), scenes::Rgb(1.0)}};
    scene.camera =
        scenes::Camera{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, scenes::FovAxis::horizontal, 0.6};
    return scenes::placed(scene);
}

TEST_F(AxesOnDevice, EachMethodOfTheHostHasATwin)
{
    for (const Axis& axis : all_axes()) {
        if (axis.name.ends_with("samples")) continue; // batches are summed on the host
        for (const Method& method : axis.methods) {
            if (!method.name.starts_with("host")) continue;
            const std::string twin = "cuda" + method.name.substr(4);
            EXPECT_TRUE(std::ranges::any_of(axis.methods,
                                            [&](const Method& other) { return other.name == twin; }))
                << axis.name << ": " << method.name;
        }
    }
}

TEST_F(AxesOnDevice, APictureIsThatOfTheHost)
{
    images::RenderOptions options;
    options.max_edges = 3;
    options.batch_size = 16;
    const auto host = small_render(Wing::host, lit_square(), 8, options);
    const auto device = small_render(Wing::cuda, lit_square(), 8, options);
    for (std::size_t i = 0; i < host.pixels.size(); ++i)
        EXPECT_NEAR(device.pixels[i].r, host.pixels[i].r, 1e-5 * host.pixels[i].r);
}

TEST_F(AxesOnDevice, RaysMeetWhatTheyMeetOnTheHost)
{
    const std::vector<scenes::Vec3> towards = {{0, 0, -1}, {0, 0, 1}, {0.28, 0, -0.96}};
    const MetPoints host = met_by(Wing::host, lit_square(), towards);
    EXPECT_TRUE(host[0] && !host[1] && host[2]);
    EXPECT_EQ(met_by(Wing::cuda, lit_square(), towards), host);
}

TEST_F(AxesOnDevice, TreesAreThoseOfTheHost)
{
    Random random(7);
    std::vector<fast::Aabb> boxes(1000);
    for (fast::Aabb& box : boxes)
        for (int axis = 0; axis < 3; ++axis) {
            box.lower[axis] = static_cast<float>(random.uniform());
            box.upper[axis] = box.lower[axis] + 0.01f;
        }
    for (const auto builder : {fast::TreeBuilder::morton30, fast::TreeBuilder::morton63,
                               fast::TreeBuilder::hploc30, fast::TreeBuilder::hploc63}) {
        const JudgedTree host = judged(builder, boxes);
        const JudgedTree device = judged(DeviceBuilder{builder}, boxes);
        EXPECT_EQ(device.fault, "");
        EXPECT_EQ(device.depth, host.depth);
        EXPECT_EQ(device.codes, host.codes);
        EXPECT_EQ(device.primitives, host.primitives);
    }
    EXPECT_EQ(wrong_rays(DeviceBuilder{fast::TreeBuilder::hploc63}, lit_square(), 100, random), 0);
}

TEST_F(AxesOnDevice, FormulasHaveTheResultsOfTheHost)
{
    for (const double z : {0.9, 0.2, -0.9, -0.8}) {
        const GlassInput input{{std::sqrt(1 - z * z), 0, z}, 1.5, 0.5};
        const GlassAnswer host = glass_by(Wing::host, input);
        const GlassAnswer device = glass_by(Wing::cuda, input);
        EXPECT_EQ(device.refracts, host.refracts);
        EXPECT_NEAR(device.reflected, host.reflected, 1e-6);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(device.wi_local[axis], host.wi_local[axis], 1e-6);
    }

    const fast::SceneArrays arrays = fast::scene_arrays(lit_square(), false);
    const std::vector<fast::PointProbe> points = {{0, 0.25f, 0.5f}, {1, 0.1f, 0.1f}};
    const std::vector<float> host = fast::probe_irradiance(arrays, points);
    const std::vector<float> device = fast::probe_irradiance_on_device(arrays, points);
    ASSERT_EQ(device.size(), host.size());
    for (std::size_t i = 0; i < host.size(); ++i) {
        EXPECT_GT(host[i], 0.0f);
        EXPECT_NEAR(device[i], host[i], 1e-5f * host[i]);
    }

    const fast::CameraProbe probe{
        fast::camera_of(lit_square(), arrays.place, 8, 8), 2.5f, 7.0f, {0, 0, -1}};
    const auto by_host = fast::probe_camera(std::span(&probe, 1)).front();
    const auto by_device = fast::probe_camera_on_device(std::span(&probe, 1)).front();
    EXPECT_TRUE(by_host.shown);
    EXPECT_EQ(by_device.shown, by_host.shown);
    EXPECT_EQ(by_device.pixel, by_host.pixel);
    EXPECT_NEAR(by_device.pdf_solid_angle, by_host.pdf_solid_angle, 1e-5f * by_host.pdf_solid_angle);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(by_device.direction[axis], by_host.direction[axis], 1e-6f);
}

} // namespace
