#include "cuda/launch/ray_pairs.h"

#include "scenes/read_scene.h"
#include "tests/cuda/parallel/on_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

namespace {

/// A cube [-1, 1]^3 of triangles that face inwards, with a sphere in it.
scenes::Scene room()
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    scene.material_names = {"grey"};
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const auto corner = [&](double u, double v) {
                scenes::Vec3 p;
                p[axis] = side;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                return p;
            };
            scene.triangles.push_back({{corner(-1, -1), corner(1, -1), corner(1, 1)}, 0});
            scene.triangles.push_back({{corner(-1, -1), corner(1, 1), corner(-1, 1)}, 0});
        }
    scene.spheres.push_back({scenes::Vec3(0.2, 0.1, -0.3), 0.4, 0});
    return scene;
}

/// Rays from the upper half of the room downwards, and onward to anywhere.
std::vector<fast::RayPair> some_pairs(const fast::Placement& place, std::size_t count)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(-1, 1);
    std::vector<fast::RayPair> pairs(count);
    for (auto& [first, onward] : pairs) {
        first = {place({uniform(random), uniform(random), 0.6}), std::numeric_limits<float>::infinity(),
                 fast::Vec3(uniform(random), uniform(random), -1.0f)};
        onward = fast::Vec3(uniform(random), uniform(random), uniform(random));
    }
    return pairs;
}

TEST(RayPairs, StayInAClosedRoom)
{
    const fast::SceneArrays arrays = fast::scene_arrays(room(), true);
    const auto pairs = some_pairs(arrays.place, 2000);
    const auto hits = fast::trace_ray_pairs(arrays, pairs);
    ASSERT_EQ(hits.size(), pairs.size());
    int onto_sphere = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_NE(hits[i].first.primitive, fast::no_primitive) << i;
        onto_sphere += hits[i].first.primitive == 12 ? 1 : 0;
        const auto& [second, first] = std::pair(hits[i].second, hits[i].first);
        if (first.primitive < 12) { // a wall: not the wall itself, or, from behind it, nothing
            EXPECT_NE(second.primitive, first.primitive) << i;
            continue;
        }
        EXPECT_NE(second.primitive, fast::no_primitive) << i; // out of the sphere, or through it
    }
    EXPECT_GT(onto_sphere, 100);
}

// A point in an edge may be rounded to the far side of the second wall. So points are moved off edges.
TEST(RayPairs, StayInAClosedRoomWhenTheyMeetItsEdges)
{
    scenes::Scene scene = room();
    scene.spheres.clear();
    // Turned and tilted, so that no coordinate is exact and no edge has a right angle.
    for (scenes::Triangle& triangle : scene.triangles)
        for (scenes::Vec3& v : triangle.vertices)
            v = v.x * scenes::Vec3(0.8, 0.48, 0.36) + v.y * scenes::Vec3(-0.6, 0.64, 0.48) +
                (v.z + v.y) * scenes::Vec3(0.0, -0.6, 0.8);
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform(0, 1);
    std::vector<fast::RayPair> pairs(1000);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const auto& v = arrays.triangles[i % arrays.triangles.size()].vertices;
        const float along = uniform(random);
        const float off = std::pow(10.0f, -5.0f - 4.0f * uniform(random));
        const fast::Vec3 direction =
            v[0] + along * (v[1] - v[0]) + off * (v[2] - v[0]); // from the middle
        pairs[i].first = {fast::Vec3(0.0f), std::numeric_limits<float>::infinity(), direction};
        pairs[i].onward = fast::Vec3(uniform(random), uniform(random), uniform(random)) - 0.5f;
    }
    auto hits = fast::trace_ray_pairs(arrays, pairs);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        ASSERT_NE(hits[i].first.primitive, fast::no_primitive) << i;
        const fast::Vec3& normal = arrays.surfaces[hits[i].first.primitive].normal;
        if (glm::dot(pairs[i].onward, normal) * glm::dot(pairs[i].first.direction, normal) > 0.0f)
            pairs[i].onward = -pairs[i].onward; // back into the room
    }
    hits = fast::trace_ray_pairs(arrays, pairs);
    for (std::size_t i = 0; i < hits.size(); ++i)
        EXPECT_NE(hits[i].second.primitive, fast::no_primitive) << i;
}

TEST(RayPairs, OfNothingAreNothing)
{
    const fast::SceneArrays arrays = fast::scene_arrays(room(), true);
    EXPECT_TRUE(fast::trace_ray_pairs(arrays, {}).empty());
    const fast::RayPair away{
        {fast::Vec3(0, 0, 8), std::numeric_limits<float>::infinity(), fast::Vec3(0, 0, 1)},
        fast::Vec3(0, 0, 1)};
    const auto hits = fast::trace_ray_pairs(arrays, std::vector{away});
    EXPECT_EQ(hits.at(0).first.primitive, fast::no_primitive);
    EXPECT_EQ(hits.at(0).second.primitive, fast::no_primitive);
}

using RayPairsOnDevice = parallel_test::OnDevice;

TEST_F(RayPairsOnDevice, AreThoseOfTheHost)
{
    const fast::SceneArrays arrays = fast::scene_arrays(room(), true);
    const auto pairs = some_pairs(arrays.place, 20000);
    const auto host = fast::trace_ray_pairs(arrays, pairs);
    const auto device = fast::trace_ray_pairs_on_device(arrays, pairs);
    ASSERT_EQ(device.size(), host.size());
    for (std::size_t i = 0; i < host.size(); ++i)
        EXPECT_EQ(std::memcmp(&device[i], &host[i], sizeof host[i]), 0) << i;
}

} // namespace
