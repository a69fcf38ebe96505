// Single connections, from vertices made by hand.

#include "cuda/parallel/executor.h"
#include "cuda/scene/scene_in_memory.h"
#include "cuda/transport/connect.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using fast::any_needs;
using scenes::Vec3;

constexpr fast::PathOptions path_options{1, 5, fast::Heuristic::balance};

/// A scene in the memory of the host.
struct World {
    explicit World(const scenes::Scene& scene)
        : arrays(fast::scene_arrays(scene, true)),
          in_memory(memory, executor, arrays, fast::camera_of(scene, arrays.place, 64, 64)),
          view(in_memory.view<any_needs>())
    {}
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    fast::SceneArrays arrays;
    fast::SceneInMemory in_memory;
    fast::SceneView<any_needs> view;
};

/// Two matte triangles: a floor, and a wall that no axis is parallel to. A point light and the eye are
/// on the wall, and the eye looks along it.
scenes::Scene eye_and_light_on_wall()
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    scene.material_names = {"matte"};
    const Vec3 corner(-1, -1.1, 0.1);
    const Vec3 x(0.8, 0.48, 0.36);
    const Vec3 y(-0.6, 0.64, 0.48);
    scene.triangles = {{{Vec3(-2, -2, -1), Vec3(2, -2, -1), Vec3(0, 2, -1)}, 0},
                       {{corner, corner + 2.0 * x, corner + 2.0 * y}, 0}};
    scene.point_lights = {{corner + 0.7 * x + 0.6 * y, scenes::Rgb(1.0)}};
    scene.camera = scenes::Camera{corner + 0.1 * x + 0.1 * y,
                                  glm::cross(x, y),
                                  y,
                                  -x, // looks along x
                                  scenes::FovAxis::horizontal,
                                  2.5};
    return scene;
}

/// Calls use(point) for points all over a triangle.
template <class Use>
void for_each_point(const World& world, std::uint32_t triangle, const Use& use)
{
    for (int i = 1; i < 16; ++i)
        for (int j = 1; i + j < 16; ++j)
            use(fast::triangle_point<any_needs, float>(world.view, triangle, static_cast<float>(i) / 16,
                                                       static_cast<float>(j) / 16));
}

// The cosine at the wall is 0; but rounding makes it positive at most points, on one side or the other.
TEST(Connections, OfAnEyeWithTheWallThatItIsOnDoNotExist)
{
    const World world(eye_and_light_on_wall());
    const auto seen = [&](std::uint32_t triangle) {
        int count = 0;
        for_each_point(world, triangle, [&](const fast::SurfacePoint& point) {
            for (const float side : {-1.0f, 1.0f}) {
                fast::CandidateOf<float> candidate;
                std::uint32_t pixel = 0;
                if (fast::light_image_candidate<any_needs, fast::Integrator::light, float>(
                        world.view, path_options, 2, point, side * point.normal, 1.0f, 1.0f,
                        fast::Vec3(1.0f), true, candidate, pixel))
                    ++count;
            }
        });
        return count;
    };
    EXPECT_GT(seen(0), 0);
    EXPECT_EQ(seen(1), 0);
}

TEST(Connections, OfALightWithTheWallThatItIsOnDoNotExist)
{
    const World world(eye_and_light_on_wall());
    const auto lit = [&](std::uint32_t triangle) {
        int count = 0;
        for_each_point(world, triangle, [&](const fast::SurfacePoint& point) {
            for (const float side : {-1.0f, 1.0f}) {
                const fast::EyeVertex z{.t = 2,
                                        .point = point,
                                        .facing = side * point.normal,
                                        .alpha = fast::Vec3(1.0f),
                                        .pdf_projected = 1.0f,
                                        .pdf_area = 1.0f,
                                        .brackets = {1, 1, 1, 1, 1}};
                fast::CandidateOf<float> candidate;
                if (fast::next_event_candidate<any_needs, fast::Integrator::path, float>(
                        world.view, path_options, {{0.5f, 0.5f, 0.5f, 0.5f}}, z, true, candidate))
                    ++count;
            }
        });
        return count;
    };
    EXPECT_GT(lit(0), 0);
    EXPECT_EQ(lit(1), 0);
}

// The rounding of a segment's direction moves its end by up to 11.7 u of its length (clearance.h, step
// 4), which the clearance of a small surface does not cover.
TEST(Connections, EndAboveALightVertexTheHigherTheFartherItIs)
{
    const World world(eye_and_light_on_wall());
    for (const float distance : {0.01f, 0.1f, 1.0f}) {
        fast::LightVertex y{};
        y.facing = fast::Vec3(0, 0, 1);
        y.clearance = 1e-9f;
        y.alpha = fast::Vec3(1.0f);
        fast::EyeVertex z{};
        z.t = 2;
        z.point.position = distance * fast::Vec3(0.6f, 0, 0.8f);
        z.facing = fast::Vec3(-0.6f, 0, -0.8f);
        z.alpha = fast::Vec3(1.0f);
        fast::CandidateOf<float> candidate;
        ASSERT_TRUE((fast::inner_connection_candidate<any_needs, float>(world.view, path_options, 2, y,
                                                                        z, true, candidate)));
        const double end =
            static_cast<double>(candidate.ray.origin.z) + static_cast<double>(candidate.ray.direction.z);
        // The sum in floats is rounded by another u of the distance here.
        EXPECT_GT(end, 0x1p-24 * 12.7 * static_cast<double>(distance)) << distance;
    }
}

} // namespace
