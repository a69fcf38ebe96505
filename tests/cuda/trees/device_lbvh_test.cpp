// Tests of trees that need a GPU.

#include "cuda/launch/device_lbvh.h"

#include "cuda/parallel/memory.h"
#include "cuda/trees/surfaces.h"
#include "tests/cuda/parallel/on_device.h"
#include "tests/cuda/trees/build_on.h"
#include "tests/cuda/trees/triangles.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>

#include <bit>
#include <stdexcept>

namespace {

using fast_trees_test::build_on;
using fast_trees_test::Built;
using parallel_test::found_device;
using parallel_test::OnDevice;
using trees_test::Kind;
using trees_test::Random;

std::vector<fast::Aabb> some_boxes(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    return fast_trees_test::rounded(trees_test::boxes(Kind::uniform, n, random));
}

/// Whether both have the same bits everywhere.
bool same(const fast::BuiltTree& device, const Built& host)
{
    using Words = std::array<std::uint32_t, 16>;
    bool nodes = device.nodes.size() == host.nodes.size();
    for (std::size_t i = 0; nodes && i < host.nodes.size(); ++i)
        nodes = std::bit_cast<Words>(device.nodes[i]) == std::bit_cast<Words>(host.nodes[i]);
    return nodes && device.leaf_links == host.leaf_links && device.primitives == host.primitives &&
           device.codes == host.codes;
}

TEST(WithoutADevice, ATreeOnItSaysWhy)
{
    if (found_device().usable) GTEST_SKIP() << "there is one: " << found_device().description;
    try {
        const fast::DeviceLbvh tree(1, 30);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_EQ(error.what(), found_device().description);
    }
}

TEST_F(OnDevice, TenThousandBuildsEqualTheSerialOne)
{
    for (const int code_bits : {30, 63}) {
        fast::DeviceLbvh tree(5000, code_bits);
        for (std::uint64_t seed = 0; seed < 50; ++seed) {
            const auto boxes = some_boxes(seed * 100 + 1, seed);
            const Built expected = build_on({fast_trees_test::On::serial, code_bits}, boxes);
            for (int repeat = 0; repeat < 100; ++repeat) {
                tree.build(boxes);
                ASSERT_TRUE(same(tree.download(), expected)) << boxes.size() << " repeat " << repeat;
            }
        }
    }
}

TEST_F(OnDevice, ABuildCanBeCapturedInAGraph)
{
    const auto boxes = some_boxes(3000, 1);
    fast::DeviceLbvh tree(3000, 30);
    tree.build(boxes);
    tree.build_as_graph();
    EXPECT_TRUE(same(tree.download(), build_on({fast_trees_test::On::serial, 30}, boxes)));
}

TEST_F(OnDevice, StagesTakeTimeAndGiveTheSameTree)
{
    const auto boxes = some_boxes(3000, 1);
    fast::DeviceLbvh tree(3000, 63);
    tree.build(boxes);
    for (const float milliseconds : tree.time_stages()) EXPECT_GT(milliseconds, 0);
    EXPECT_TRUE(same(tree.download(), build_on({fast_trees_test::On::serial, 63}, boxes)));
}

TEST_F(OnDevice, RaysFindTheHitsThatTheHostFinds) // bit for bit: no fused multiply-add on either side
{
    const auto triangles = fast_trees_test::triangles_of(trees_test::icosphere(4, 0.5));
    Random random(1);
    std::vector<fast::Sphere> spheres;
    for (int i = 0; i < 100; ++i)
        spheres.push_back(
            {fast::Vec3(random.in_cube()), static_cast<float>(random.magnitude(-2, -0.5))});
    std::vector<fast::Ray> rays;
    for (int i = 0; i < 10000; ++i)
        rays.push_back({fast::Vec3(2.0 * random.in_cube()), std::numeric_limits<float>::infinity(),
                        fast::Vec3(random.direction())});
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    using Words = std::array<std::uint32_t, 4>;
    for (const auto& with : {spheres, std::vector<fast::Sphere>()}) {
        const std::vector<fast::Hit> hits = fast::intersect_on_device(triangles, with, rays);
        const fast::SurfaceTree host(memory, executor, triangles, with);
        for (std::size_t i = 0; i < rays.size(); ++i)
            ASSERT_EQ(std::bit_cast<Words>(hits[i]),
                      std::bit_cast<Words>(intersect(host.view<true>(), rays[i])))
                << i;
    }
}

TEST_F(OnDevice, OutOfMemoryNamesBytesAndLeavesTheDeviceUsable)
{
    const auto boxes = some_boxes(100, 1);
    std::vector<std::unique_ptr<fast::DeviceLbvh>> held;
    std::string message;
    try {
        for (int i = 0; i < 100; ++i) held.push_back(std::make_unique<fast::DeviceLbvh>(1u << 27, 63));
    } catch (const fast::OutOfMemory& error) {
        message = error.what();
    }
    EXPECT_NE(message.find("device memory is exhausted: "), std::string::npos) << message;
    EXPECT_NE(message.find(" bytes wanted, "), std::string::npos) << message;
    held.clear();
    fast::DeviceLbvh tree(100, 30);
    tree.build(boxes);
    EXPECT_TRUE(same(tree.download(), build_on({fast_trees_test::On::serial, 30}, boxes)));
}

} // namespace
