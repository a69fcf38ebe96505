// The traversals of wide trees: in their order, and of the deepest tree that there can be.

#include "cuda/trees/traverse.h"

#include "tests/cuda/trees/narrow_trees.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <vector>

namespace {

using fast::Aabb;
using fast::Node;
using fast::Triangle;
using fast::Vec3;
using fast::WideTree;
using fast_trees_test::Narrow;
using trees_test::Random;

/// The closest hit by the traversal that a GPU uses.
fast::Hit intersect_with_masks(const fast::Surfaces<false>& surfaces, const fast::Ray& ray)
{
    fast::Hit best{ray.t_max, fast::no_primitive, 0, 0};
    const fast::ShearedRay sheared(ray);
    const std::uint32_t root = surfaces.tree.nodes.empty() ? fast::leaf_bit : 0;
    if (surfaces.tree.groups.empty()) return best;
    traverse_with_masks(surfaces.tree, root, fast::WideSlabs(fast::SlabRay(ray, surfaces.tree.bounds)),
                        ray.t_max, [&](std::uint32_t group) {
                            intersect_group(surfaces, group, ray, sheared, [&](const fast::Hit& hit) {
                                if (comes_before(hit, best)) best = hit;
                            });
                            return best.t;
                        });
    return best;
}

RC_GTEST_PROP(WideTree, BothTraversalsFindTheSameHits, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    Narrow narrow(*rc::gen::inRange<std::size_t>(0, 1000), random);
    const WideTree tree = narrow.widened(narrow.executor);
    const fast::Surfaces<false> surfaces{
        tree.view(), {}, static_cast<std::uint32_t>(narrow.triangles.size())};
    for (int i = 0; i < 50; ++i) {
        const fast::Ray ray{Vec3(2.0 * random.in_cube()), std::numeric_limits<float>::infinity(),
                            Vec3(random.direction())};
        const fast::Hit hit = intersect(surfaces, ray);
        const fast::Hit other = intersect_with_masks(surfaces, ray);
        RC_ASSERT(hit.primitive == other.primitive);
        RC_ASSERT(hit.t == other.t);
    }
}

/// The groups that a ray along x tests, by both traversals, in a node whose children are `groups`:
/// number g is between x = g and g + 0.5. `hit`: whether each is hit, in its middle.
std::array<std::vector<std::uint32_t>, 2> groups_tested(const std::vector<std::uint32_t>& groups,
                                                        bool hit)
{
    fast::WideNode node{};
    for (int c = 0; c < fast::most_children; ++c) {
        Aabb box = fast::empty_aabb();
        node.children[c] = fast::no_node;
        if (c < static_cast<int>(groups.size())) {
            const std::uint32_t group = groups[static_cast<std::size_t>(c)];
            const auto x = static_cast<float>(group);
            box = {Vec3(x, -1, -1), Vec3(x + 0.5f, 1, 1)};
            node.children[c] = group | fast::leaf_bit;
        }
        for (int axis = 0; axis < 3; ++axis) {
            node.planes[axis][c] = box.lower[axis];
            node.planes[3 + axis][c] = box.upper[axis];
        }
    }
    const fast::WideTreeView tree{{&node, 1}, {}, Aabb{Vec3(0, -1, -1), Vec3(8, 1, 1)}};
    const fast::Ray ray{Vec3(-1, 0, 0), std::numeric_limits<float>::infinity(), Vec3(1, 0, 0)};
    const fast::WideSlabs slabs(fast::SlabRay(ray, tree.bounds));
    std::array<std::vector<std::uint32_t>, 2> tested;
    const auto record = [&](std::vector<std::uint32_t>& order) {
        return [&order, hit, &ray](std::uint32_t group) {
            order.push_back(group);
            return hit ? static_cast<float>(group) + 1.25f : ray.t_max;
        };
    };
    traverse_with_children(tree, 0, slabs, ray.t_max, record(tested[0]));
    traverse_with_masks(tree, 0, slabs, ray.t_max, record(tested[1]));
    return tested;
}

// A wrong order would cost time and change no hit.
TEST(WideTree, BothTraversalsTestTheNearerGroupFirstAndNoneBeyondAHit) // map: traversal
{
    std::mt19937_64 random(1);
    for (int i = 0; i < 200; ++i) {
        std::vector<std::uint32_t> groups = {0, 1, 2, 3, 4, 5, 6, 7};
        std::ranges::shuffle(groups, random);
        groups.resize(1 + static_cast<std::size_t>(i % fast::most_children));
        std::vector<std::uint32_t> sorted = groups;
        std::ranges::sort(sorted);
        auto [with_children, with_masks] = groups_tested(groups, false);
        EXPECT_EQ(with_masks, sorted);
        if (with_children.size() > 2) // in which order the others come is left open
            std::ranges::sort(std::span(with_children).subspan(2));
        EXPECT_EQ(with_children, sorted);
        sorted.resize(1);
        for (const auto& tested : groups_tested(groups, true)) EXPECT_EQ(tested, sorted);
    }
}

/// A binary tree in the making.
struct Making {
    std::vector<Node> nodes;
    std::vector<std::uint32_t> leaf_links;

    /// A node with two equal boxes; its children are set later.
    std::uint32_t node(const Aabb& box)
    {
        nodes.push_back({{box, box}, {0, 0}, fast::no_node, 0});
        return static_cast<std::uint32_t>(nodes.size() - 1);
    }
    void set_child(std::uint32_t parent, std::uint32_t side, std::uint32_t child)
    {
        nodes[parent].children[side] = child;
        (fast::is_leaf(child) ? leaf_links[child & ~fast::leaf_bit] : nodes[child].link) =
            fast::link_to(parent, side);
    }
    /// A balanced tree over `count` new leaves with equal boxes; returns its number as a child.
    std::uint32_t balanced(std::uint32_t count, const Aabb& box)
    {
        if (count == 1) {
            leaf_links.push_back(fast::no_node);
            return static_cast<std::uint32_t>(leaf_links.size() - 1) | fast::leaf_bit;
        }
        const std::uint32_t at = node(box);
        set_child(at, 0, balanced(count / 2, box));
        set_child(at, 1, balanced(count - count / 2, box));
        return at;
    }
    /// The same over as many new groups.
    std::uint32_t balanced_groups(int count, const Aabb& box)
    {
        if (count == 1) return balanced(fast::most_in_group, box);
        const std::uint32_t at = node(box);
        set_child(at, 0, balanced_groups(count / 2, box));
        set_child(at, 1, balanced_groups(count - count / 2, box));
        return at;
    }
};

// The worst case for the stack: at every level of the deepest tree only one child is opened, and the ray
// continues into the other child with all children of the first on the stack.
TEST(WideTree, TheDeepestOneFitsTheStack)
{
    // A level has 0.45 of the area of the level above. To merge wide nodes of a level costs more than it
    // saves on all levels below: 0.45 + 0.45^2 + ... < 1.
    Making made;
    float size = 2 / std::pow(0.45f, 0.5f * (fast::deepest_tree - 1));
    std::uint32_t level_above = fast::no_node;
    for (int level = 1; level < fast::deepest_tree; ++level) {
        const Aabb box{Vec3(-size), Vec3(size)};
        const std::uint32_t at = made.node(box);
        if (level > 1) made.set_child(level_above, 0, at);
        made.set_child(at, 1, made.balanced_groups(fast::most_children - 1, box));
        level_above = at;
        size = std::max(2.0f, size * std::sqrt(0.45f));
    }
    made.set_child(level_above, 0, made.balanced_groups(2, {Vec3(-size), Vec3(size)}));
    const auto leaves = static_cast<std::uint32_t>(made.leaf_links.size());
    std::vector<std::uint32_t> primitives(leaves);
    for (std::uint32_t i = 0; i < leaves; ++i) primitives[i] = i;
    Random random(1);
    std::vector<Triangle> triangles(leaves);
    for (Triangle& triangle : triangles)
        for (Vec3& vertex : triangle.vertices) vertex = Vec3(random.in_cube());
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    const fast::Divisions divisions(memory, executor, made.nodes, made.leaf_links);
    const WideTree tree(memory, executor, made.nodes, divisions.all(), primitives, triangles);
    ASSERT_EQ(tree.levels(), fast::deepest_tree);
    for (int i = 0; i < 100; ++i) {
        const fast::Ray ray{Vec3(0.01 * random.in_cube()), std::numeric_limits<float>::infinity(),
                            Vec3(random.direction())};
        const fast::Surfaces<false> surfaces{tree.view(), {}, leaves};
        const fast::Hit hit = intersect(surfaces, ray);
        const fast::Hit expected = fast_trees_test::linear_search(triangles, ray);
        EXPECT_EQ(hit.primitive, expected.primitive);
        EXPECT_EQ(hit.t, expected.t);
        EXPECT_EQ(intersect_with_masks(surfaces, ray).primitive, expected.primitive);
    }
}

} // namespace
