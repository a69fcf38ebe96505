// Trees of few primitives, by every builder, and trees that are damaged on purpose.

#include "extremes/trees/check_binary_tree.h"
#include "extremes/trees/tree_builds.h"

#include "cuda/parallel/executor.h"
#include "cuda/trees/lbvh.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace extremes {

namespace {

const std::vector<AnyBuilder> all_builders = {ref::Builder::morton30,      ref::Builder::morton63,
                                              ref::Builder::sah,           fast::TreeBuilder::morton30,
                                              fast::TreeBuilder::morton63, fast::TreeBuilder::hploc30,
                                              fast::TreeBuilder::hploc63};

std::vector<fast::Aabb> random_boxes(std::size_t n)
{
    Random random(1);
    std::vector<fast::Aabb> boxes;
    for (std::size_t i = 0; i < n; ++i) {
        const fast::Vec3 lower(random.direction());
        boxes.push_back({lower, lower + 0.1f});
    }
    return boxes;
}

/// A tree that can be damaged.
struct OwnTree {
    std::vector<fast::Aabb> boxes = random_boxes(20);
    std::vector<fast::Node> nodes;
    std::vector<std::uint32_t> leaf_links, primitives;

    OwnTree()
    {
        fast::HostMemory memory;
        fast::SerialExecutor executor;
        fast::Lbvh<std::uint32_t> tree(memory, executor, 20);
        tree.build(executor, boxes);
        nodes.assign(tree.nodes().begin(), tree.nodes().end());
        leaf_links.assign(tree.leaf_links().begin(), tree.leaf_links().end());
        primitives.assign(tree.primitives().begin(), tree.primitives().end());
    }
    [[nodiscard]] std::string fault(bool in_order = true) const
    {
        return checked({nodes, leaf_links, primitives, boxes}, in_order).fault;
    }
};

} // namespace

TEST(TreeBuilds, TreesOverFewPrimitivesAreValid)
{
    for (const AnyBuilder& builder : all_builders)
        for (const std::size_t n : {0u, 1u, 2u, 3u, 100u}) {
            std::vector<ref::Aabb> boxes;
            for (const fast::Aabb& box : random_boxes(n))
                boxes.push_back({ref::Vec3(box.lower), ref::Vec3(box.upper)});
            const JudgedTree tree = judged(builder, boxes);
            EXPECT_EQ(tree.fault, "") << n;
            EXPECT_EQ(tree.primitives.size(), n);
            EXPECT_EQ(tree.codes.size(), code_bits(builder) > 0 ? n : 0);
            if (n > 0) {
                EXPECT_GE(tree.depth, static_cast<int>(std::bit_width(n - 1))) << n;
                EXPECT_LE(tree.depth, depth_bound(builder, n)) << n;
            }
        }
}

TEST(CheckBinaryTree, FindsEveryKindOfDamage)
{
    ASSERT_EQ(OwnTree().fault(), "");
    const std::vector<std::pair<const char*, std::function<void(OwnTree&)>>> damages = {
        {"primitive twice", [](OwnTree& tree) { tree.primitives[3] = tree.primitives[4]; }},
        {"primitive too large", [](OwnTree& tree) { tree.primitives[3] = 20; }},
        {"too few nodes", [](OwnTree& tree) { tree.nodes.pop_back(); }},
        {"root with a parent", [](OwnTree& tree) { tree.nodes[0].link = 5; }},
        {"wrong link of a leaf", [](OwnTree& tree) { tree.leaf_links[7] ^= 1; }},
        {"wrong link of a node", [](OwnTree& tree) { tree.nodes[7].link ^= 1; }},
        {"cycle", [](OwnTree& tree) { tree.nodes[9].children[0] = 0; }},
        {"no such node", [](OwnTree& tree) { tree.nodes[9].children[0] = 19; }},
        {"no such leaf", [](OwnTree& tree) { tree.nodes[9].children[1] = fast::leaf_bit | 20; }},
        {"box too small", [](OwnTree& tree) { tree.nodes[2].bounds[1].upper.y -= 0.01f; }},
        {"box too large", [](OwnTree& tree) { tree.nodes[2].bounds[0].lower.z -= 0.01f; }},
    };
    for (const auto& [name, damage] : damages) {
        OwnTree tree;
        damage(tree);
        EXPECT_NE(tree.fault(), "") << name;
    }
}

TEST(CheckBinaryTree, ChecksTheOrderOfLeavesWhereItMatters)
{
    OwnTree tree;
    fast::Node& root = tree.nodes[0]; // mirrored
    std::swap(root.children[0], root.children[1]);
    std::swap(root.bounds[0], root.bounds[1]);
    for (const std::uint32_t side : {0u, 1u}) {
        const std::uint32_t child = root.children[side];
        (fast::is_leaf(child) ? tree.leaf_links[child & ~fast::leaf_bit] : tree.nodes[child].link) =
            fast::link_to(0, side);
    }
    EXPECT_EQ(tree.fault(false), "");
    EXPECT_NE(tree.fault(true), "");
}

TEST(LostOrder, CountsNeighboursWithTheSameCodeAndDifferentCentroids)
{
    const JudgedTree tree{{1, 1, 1, 2, 3}, {0, 1, 2, 3, 4}, "", 3};
    EXPECT_EQ(lost_order(tree, [](auto, auto) { return false; }), 0.5);
    EXPECT_EQ(lost_order(tree, [](auto a, auto b) { return a + b == 1; }), 0.25);
    EXPECT_EQ(lost_order({}, [](auto, auto) { return false; }), 0.0);
    EXPECT_EQ(lost_order_bound(1000, 0.0), 0.0);
    EXPECT_NEAR(lost_order_bound(1001, 2e-5), (10.01 + 8 * std::sqrt(10.01) + 10) / 1000, 1e-9);
}

} // namespace extremes
