// Compares every split of the builder with all possible splits, and the cost of trees with costs
// counted by hand.

#include "ref/trees/sah.h"

#include "ref/trees/bvh.h"
#include "ref/trees/quality.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace {

using ref::Aabb;
using ref::Tree;
using ref::Vec3;
using trees_test::Kind;
using trees_test::Random;

std::vector<std::uint32_t> primitives_below(const Tree& tree, std::uint32_t node)
{
    if (tree.is_leaf(node)) {
        const std::uint32_t leaf = tree.leaf(node);
        return {tree.primitives.begin() + tree.leaf_begin[leaf],
                tree.primitives.begin() + tree.leaf_begin[leaf + 1]};
    }
    std::vector<std::uint32_t> all = primitives_below(tree, tree.nodes[node].children[0]);
    const auto right = primitives_below(tree, tree.nodes[node].children[1]);
    all.insert(all.end(), right.begin(), right.end());
    return all;
}

Aabb box_of(std::span<const Aabb> boxes, std::span<const std::uint32_t> primitives)
{
    Aabb box;
    for (const std::uint32_t primitive : primitives) box = unite(box, boxes[primitive]);
    return box;
}

double split_cost(std::span<const Aabb> boxes, std::span<const std::uint32_t> left,
                  std::span<const std::uint32_t> right)
{
    return half_area(box_of(boxes, left)) * static_cast<double>(left.size()) +
           half_area(box_of(boxes, right)) * static_cast<double>(right.size());
}

/// The least cost over all positions along all axes. Primitives of equal centroid are in the order of
/// their numbers.
double least_split_cost(std::span<const Aabb> boxes, std::vector<std::uint32_t> primitives)
{
    double least = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        std::sort(primitives.begin(), primitives.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(centroid(boxes[a])[axis], a) < std::pair(centroid(boxes[b])[axis], b);
        });
        const std::span<const std::uint32_t> all = primitives;
        for (std::size_t i = 1; i < all.size(); ++i)
            least = std::min(least, split_cost(boxes, all.first(i), all.subspan(i)));
    }
    return least;
}

RC_GTEST_PROP(BuildSah, SplitsEveryNodeAtTheLeastCost, ()) // map: sah-split
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::size_t n = *rc::gen::inRange<std::size_t>(2, 40);
    const auto kind = static_cast<Kind>(*rc::gen::inRange(0, trees_test::kinds));
    const std::vector<Aabb> boxes = trees_test::boxes(kind, n, random);
    const Tree tree = ref::build_sah(boxes);
    for (std::uint32_t node = 0; node < tree.internal_count(); ++node) {
        const auto left = primitives_below(tree, tree.nodes[node].children[0]);
        const auto right = primitives_below(tree, tree.nodes[node].children[1]);
        RC_ASSERT(split_cost(boxes, left, right) ==
                  least_split_cost(boxes, primitives_below(tree, node)));
    }
}

TEST(BuildSah, TakesTheMostBalancedOfSplitsOfEqualCost)
{
    // Squares of side 1 across x: a split into i squares of extent a and 5 - i of extent b costs
    // i (2 a + 1) + (5 - i) (2 b + 1). At 0, 1, 4, 5, 10 this is 45 for i = 2 and for i = 4, and more
    // for the others.
    for (const bool mirrored : {false, true}) {
        std::vector<Aabb> boxes;
        for (const double x : {0, 1, 4, 5, 10}) {
            const double at = mirrored ? 10 - x : x;
            boxes.push_back({Vec3(at, 0, 0), Vec3(at, 1, 1)});
        }
        const Tree tree = ref::build_sah(boxes);
        const std::size_t left = primitives_below(tree, tree.nodes[0].children[0]).size();
        EXPECT_EQ(left, mirrored ? 3u : 2u);
    }
}

RC_GTEST_PROP(BuildSah, MakesALeafExactlyWhereThatIsNoDearer, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::size_t n = *rc::gen::inRange<std::size_t>(2, 60);
    const auto kind = static_cast<Kind>(*rc::gen::inRange(0, trees_test::kinds));
    const std::vector<Aabb> boxes = trees_test::boxes(kind, n, random);
    const std::size_t max_leaf_size = 4;
    const Tree tree = ref::build_sah(boxes, max_leaf_size);
    for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
        const auto primitives = primitives_below(tree, node);
        if (primitives.size() == 1) continue;
        const double area = half_area(tree.bounds[node]);
        const double as_leaf = ref::C_isect * area * static_cast<double>(primitives.size());
        const double as_node = ref::C_trav * area + ref::C_isect * least_split_cost(boxes, primitives);
        RC_ASSERT(tree.is_leaf(node) == (primitives.size() <= max_leaf_size && as_leaf <= as_node));
    }
}

TEST(Quality, OfAHandMadeTreeIsWhatOneCounts) // map: sah-cost
{
    // Two unit cubes side by side in a box of half area 2 + 1 + 2 = 5.
    const std::vector<Aabb> boxes = {{Vec3(0), Vec3(1)}, {Vec3(1, 0, 0), Vec3(2, 1, 1)}};
    const ref::Quality found = ref::quality(ref::build(boxes, ref::Builder::morton30));
    EXPECT_DOUBLE_EQ(found.sah_cost, 1 + 3.0 / 5 + 3.0 / 5);
    EXPECT_EQ(found.depth, 1);
    EXPECT_EQ(found.mean_leaf_depth, 1.0);
    EXPECT_DOUBLE_EQ(found.overlap, 1.0 / 5); // the face they share
}

TEST(Quality, AnInternalNodeCountsByItsArea) // map: sah-cost
{
    // Three unit cubes in a row, the third after a gap: half areas 9 of the root, 5 of the first two, 3
    // of each.
    const std::vector<Aabb> boxes = {
        {Vec3(0), Vec3(1)}, {Vec3(1, 0, 0), Vec3(2, 1, 1)}, {Vec3(3, 0, 0), Vec3(4, 1, 1)}};
    const ref::Quality found = ref::quality(ref::build(boxes, ref::Builder::sah));
    EXPECT_DOUBLE_EQ(found.sah_cost, 1 + 5.0 / 9 + 3 * (3.0 / 9));
    EXPECT_EQ(found.depth, 2);
    EXPECT_DOUBLE_EQ(found.overlap, 1.0 / 9);
}

TEST(Quality, ALeafCostsAsManyTestsAsItHoldsPrimitives) // map: sah-cost
{
    Tree tree; // one leaf, the root: every ray that hits it tests all of its primitives
    tree.nodes.resize(1);
    tree.bounds = {{Vec3(0), Vec3(1)}};
    tree.leaf_begin = {0, 3};
    tree.primitives = {0, 1, 2};
    EXPECT_EQ(ref::quality(tree).sah_cost, 3 * ref::C_isect);
}

TEST(Quality, OfNoTreeAndOfOneLeafAndOfNoAreaIsFinite)
{
    EXPECT_EQ(ref::quality(Tree{}).sah_cost, 0);
    const std::vector<Aabb> one = {{Vec3(0), Vec3(1)}};
    EXPECT_EQ(ref::quality(ref::build(one, ref::Builder::sah)).sah_cost, 1);
    EXPECT_EQ(ref::quality(ref::build(one, ref::Builder::sah)).depth, 0);
    const std::vector<Aabb> points(4, Aabb{Vec3(1), Vec3(1)});
    EXPECT_EQ(ref::quality(ref::build(points, ref::Builder::morton30)).sah_cost, 3 + 4);
}

TEST(Quality, ASweepIsNoWorseThanAMortonTreeOnMeshes)
{
    for (const trees_test::Mesh& mesh : {trees_test::icosphere(3, 1), trees_test::icosphere(3, 0.1),
                                         trees_test::tessellated_box(8, 2)}) {
        const std::vector<Aabb> boxes = ref::primitive_bounds(scene_of(mesh));
        const double sah = ref::quality(ref::build(boxes, ref::Builder::sah)).sah_cost;
        const double sah_leaf = ref::quality(ref::build(boxes, ref::Builder::sah_leaf)).sah_cost;
        const double morton = ref::quality(ref::build(boxes, ref::Builder::morton30)).sah_cost;
        EXPECT_LT(sah, morton);
        EXPECT_LT(sah_leaf, sah);
        EXPECT_LT(morton, 2 * sah);
    }
}

} // namespace
