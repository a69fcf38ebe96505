// All builders on all kinds of boxes.

#include "ref/trees/bvh.h"

#include "ref/trees/is_valid_tree.h"
#include "ref/trees/quality.h"
#include "ref/trees/radix_sort.h"
#include "tests/ref/trees/boxes.h"
#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <stdexcept>

namespace {

using ref::Aabb;
using ref::build;
using ref::Builder;
using ref::Tree;
using ref::Vec3;
using trees_test::Kind;
using trees_test::Random;

constexpr std::array builders = {Builder::morton30, Builder::morton63, Builder::sah, Builder::sah_leaf};

int depth_bound(Builder builder, std::size_t n)
{
    const int bits = builder == Builder::morton30 ? 30 : builder == Builder::morton63 ? 63 : 64;
    return bits + static_cast<int>(std::bit_width(n - 1));
}

TEST(Build, GivesAValidTreeOfBoundedDepthForEveryKindAndSize)
{
    Random random(1);
    std::vector<std::size_t> sizes = {16, 31, 64, 255, 256, 257, 300, 1000};
    for (std::size_t n = 0; n <= 9; ++n) sizes.push_back(n);
    for (int kind = 0; kind < trees_test::kinds; ++kind)
        for (const std::size_t n : sizes)
            for (const Builder builder : builders) {
                const std::vector<Aabb> boxes = trees_test::boxes(static_cast<Kind>(kind), n, random);
                const Tree tree = build(boxes, builder);
                ASSERT_EQ(is_valid_tree(tree, boxes), std::vector<std::string>())
                    << trees_test::name(static_cast<Kind>(kind)) << " n " << n;
                if (builder != Builder::sah_leaf) {
                    ASSERT_EQ(tree.leaf_count(), n);
                }
                if (n > 0) {
                    ASSERT_LE(ref::quality(tree).depth, depth_bound(builder, n));
                }
            }
}

TEST(Build, SortsMortonTreesByCodeThenByPrimitive)
{
    Random random(2);
    for (int kind = 0; kind < trees_test::kinds; ++kind)
        for (const int bits_per_axis : {10, 21}) {
            const std::vector<Aabb> boxes = trees_test::boxes(static_cast<Kind>(kind), 500, random);
            const std::vector<std::uint64_t> codes = ref::morton_codes(boxes, bits_per_axis);
            const Tree tree = build(boxes, bits_per_axis == 10 ? Builder::morton30 : Builder::morton63);
            std::vector<std::uint64_t> sorted;
            for (const std::uint32_t primitive : tree.primitives) sorted.push_back(codes[primitive]);
            EXPECT_EQ(is_valid_radix_tree(tree, sorted), std::vector<std::string>());
            for (std::size_t i = 1; i < sorted.size(); ++i)
                ASSERT_TRUE(std::pair(sorted[i - 1], tree.primitives[i - 1]) <
                            std::pair(sorted[i], tree.primitives[i]));
        }
}

TEST(Build, SpansTheGridOverCentroidsAlone) // not over the boxes, which may be far larger
{
    const auto point = [](double x) { return Aabb{Vec3(x), Vec3(x)}; };
    std::vector<Aabb> boxes = {point(0), point(1), {Vec3(-1000), Vec3(1001)}};
    const auto codes = ref::morton_codes(boxes, 10);
    EXPECT_EQ(codes[0], 0u);
    EXPECT_EQ(codes[1], 0x3fff'ffffu);
    EXPECT_EQ(codes[2], 7u << 27); // 0.5: the middle cell
}

TEST(Build, TakesManyCoincidentPrimitives)
{
    for (const std::size_t n : {65536u, 100000u})
        for (const Builder builder : builders) {
            const std::vector<Aabb> boxes(n, Aabb{Vec3(1), Vec3(2)});
            const Tree tree = build(boxes, builder);
            EXPECT_EQ(is_valid_tree(tree, boxes), std::vector<std::string>());
            EXPECT_LE(ref::quality(tree).depth, 17);
        }
}

TEST(Build, IsNotDrivenIntoAChainByBoxesOfGrowingSize)
{
    std::vector<Aabb> boxes; // the best split always separates the largest box
    for (int i = 0; i < 2000; ++i) boxes.push_back({Vec3(0), Vec3(std::ldexp(1, i / 2 - 500))});
    for (const Builder builder : builders) {
        const Tree tree = build(boxes, builder);
        EXPECT_EQ(is_valid_tree(tree, boxes), std::vector<std::string>());
        EXPECT_LE(ref::quality(tree).depth, depth_bound(builder, boxes.size()));
    }
}

std::string message(const std::vector<Aabb>& boxes, Builder builder)
{
    try {
        build(boxes, builder);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Build, RejectsWhatIsNoBoxAndNamesIt)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Builder builder : builders)
        for (int axis = 0; axis < 3; ++axis) {
            const std::vector<Aabb> good(5, Aabb{Vec3(0), Vec3(1)});
            for (const double bad : {nan, infinity, -infinity}) {
                auto boxes = good;
                boxes[3].upper[axis] = bad;
                EXPECT_EQ(message(boxes, builder).substr(0, 13), "primitive 3: ") << bad;
                boxes = good;
                boxes[4].lower[axis] = bad;
                EXPECT_EQ(message(boxes, builder).substr(0, 13), "primitive 4: ") << bad;
            }
            auto boxes = good;
            boxes[2].lower[axis] = 1.5;
            EXPECT_EQ(message(boxes, builder), "primitive 2: its box is empty");
            EXPECT_EQ(message({Aabb{}}, builder), "primitive 0: its box is empty");
            EXPECT_EQ(message(good, builder), "");
        }
}

std::string message(const scenes::Scene& scene)
{
    try {
        ref::primitive_bounds(scene);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST(Build, RejectsMorePrimitivesThanNodesCanBeNumbered)
{
    const Aabb box{Vec3(0), Vec3(1)};
    // No box but the first exists; the number alone is looked at.
    const std::span<const Aabb> too_many(&box, ref::most_primitives + 1);
    for (const Builder builder : builders) try {
            build(too_many, builder);
            ADD_FAILURE() << "not refused";
        } catch (const std::invalid_argument& error) {
            EXPECT_STREQ(error.what(), "a tree may have 2147483648 primitives, not 2147483649");
        }
}

TEST(PrimitiveBounds, RejectsAVertexThatMinAndMaxWouldSwallowAndNamesItsPrimitive)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    scenes::Scene scene;
    scene.triangles.assign(4, {{Vec3(0), Vec3(1), Vec3(2)}, 0});
    scene.spheres = {{Vec3(0), 1, 0}, {Vec3(0), 1, 0}};
    EXPECT_EQ(message(scene), "");
    for (std::size_t vertex = 0; vertex < 3; ++vertex) {
        scenes::Scene broken = scene;
        broken.triangles[2].vertices[vertex].y = nan;
        EXPECT_EQ(message(broken).substr(0, 13), "primitive 2: ");
    }
    for (const scenes::Sphere& sphere : {scenes::Sphere{Vec3(0, nan, 0), 1, 0},
                                         {Vec3(0), std::numeric_limits<double>::infinity(), 0}}) {
        scenes::Scene broken = scene;
        broken.spheres[1] = sphere;
        EXPECT_EQ(message(broken).substr(0, 13), "primitive 5: ");
    }
}

TEST(PrimitiveBounds, AreThoseOfTheVerticesAndAroundTheSphere)
{
    scenes::Scene scene;
    scene.triangles = {{{Vec3(0, 5, 2), Vec3(1, -1, 2), Vec3(-3, 0, 7)}, 0}};
    scene.spheres = {{Vec3(0.1, 0.2, 0.3), 0.7, 0}};
    const auto boxes = ref::primitive_bounds(scene);
    ASSERT_EQ(boxes.size(), 2u);
    EXPECT_EQ(boxes[0], (Aabb{Vec3(-3, -1, 2), Vec3(1, 5, 7)}));
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LT(boxes[1].lower[axis], scene.spheres[0].center[axis] - 0.7);
        EXPECT_GT(boxes[1].upper[axis], scene.spheres[0].center[axis] + 0.7);
    }
}

RC_GTEST_PROP(RadixSort, IsAStableSort, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const int bits = *rc::gen::element(5, 11, 30, 63);
    const std::size_t n = *rc::gen::inRange<std::size_t>(0, 1000);
    std::vector<std::uint64_t> codes;
    std::vector<std::uint32_t> primitives;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> expected;
    for (std::uint32_t i = 0; i < n; ++i) {
        const bool again = i > 0 && random.below(2) == 0; // equal codes, to test that the sort is stable
        codes.push_back(again ? codes[random.below(i)] : random.bits() >> (64 - bits));
        primitives.push_back(static_cast<std::uint32_t>(n) - i);
        expected.emplace_back(codes[i], primitives[i]);
    }
    std::stable_sort(expected.begin(), expected.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    ref::radix_sort(codes, primitives, bits);
    for (std::size_t i = 0; i < n; ++i) RC_ASSERT(std::pair(codes[i], primitives[i]) == expected[i]);
}

// Here and there larger leaves are cheaper, so that some leaf of the mesh has more than one primitive.
TEST(LeafSize, IsNeverExceeded)
{
    const auto boxes = ref::primitive_bounds(scene_of(trees_test::tessellated_box(8, 2)));
    std::size_t nodes = std::numeric_limits<std::size_t>::max();
    for (const std::size_t size : {1u, 2u, 3u, 16u}) {
        const Tree tree = build(boxes, {Builder::sah_leaf, size});
        EXPECT_EQ(is_valid_tree(tree, boxes), std::vector<std::string>());
        std::size_t largest = 0;
        for (std::size_t leaf = 0; leaf + 1 < tree.leaf_begin.size(); ++leaf)
            largest = std::max<std::size_t>(largest, tree.leaf_begin[leaf + 1] - tree.leaf_begin[leaf]);
        EXPECT_LE(largest, size);
        EXPECT_EQ(largest == 1, size == 1);
        EXPECT_LE(tree.nodes.size(), nodes);
        nodes = tree.nodes.size();
    }
    EXPECT_EQ(build(boxes, Builder::sah_leaf).nodes.size(),
              build(boxes, {Builder::sah_leaf, 8}).nodes.size());
    EXPECT_THROW(build(boxes, {Builder::sah_leaf, 0}), std::invalid_argument);
}

} // namespace
