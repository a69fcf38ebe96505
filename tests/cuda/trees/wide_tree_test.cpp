// The conversion of narrow trees to wide ones.

#include "cuda/trees/wide_tree.h"

#include "tests/cuda/parallel/interleaved_executor.h"
#include "tests/cuda/trees/narrow_trees.h"
#include "tests/cuda/trees/same_trees.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace {

using fast::Aabb;
using fast::Node;
using fast::Triangle;
using fast::TriangleGroup;
using fast::Vec3;
using fast::WideNode;
using fast::WideTree;
using fast_trees_test::Narrow;
using fast_trees_test::same_groups;
using fast_trees_test::same_nodes;
using trees_test::Random;

/// Counts how often each primitive is in a group, and how many nodes and groups there are.
struct Census {
    std::vector<int> seen;
    std::size_t nodes = 0;
    std::size_t groups = 0;
};

/// The box around everything below `child`. Checks that the boxes in the wide nodes agree with it.
Aabb check_below(const fast::WideTreeView& tree, const Narrow& narrow, std::uint32_t child,
                 Census& census, std::uint32_t& primitives)
{
    Aabb all = fast::empty_aabb();
    if (fast::is_leaf(child)) {
        ++census.groups;
        const TriangleGroup& group = tree.groups[child & ~fast::leaf_bit];
        for (int lane = 0; lane < fast::lane_count; ++lane) {
            const std::uint32_t primitive = group.primitives[lane];
            const Triangle triangle = group.triangle(lane);
            if (primitive == fast::no_primitive) {
                RC_ASSERT(triangle.vertices[0].x != triangle.vertices[0].x); // NaN: never hit
                continue;
            }
            ++primitives;
            ++census.seen[primitive];
            RC_ASSERT(std::memcmp(&triangle, &narrow.triangles[primitive], sizeof triangle) == 0);
            all = unite(all, narrow.boxes[primitive]);
        }
        return all;
    }
    ++census.nodes;
    const WideNode& node = tree.nodes[child];
    std::uint32_t below = 0;
    for (int c = 0; c < fast::most_children; ++c) {
        if (node.children[c] == fast::no_node) {
            RC_ASSERT(node.planes[0][c] > node.planes[3][c]); // no ray enters
            continue;
        }
        const Aabb box = check_below(tree, narrow, node.children[c], census, below);
        for (int axis = 0; axis < 3; ++axis) {
            RC_ASSERT(node.planes[axis][c] == box.lower[axis]);
            RC_ASSERT(node.planes[3 + axis][c] == box.upper[axis]);
        }
        all = unite(all, box);
    }
    RC_ASSERT(below > fast::most_in_group); // otherwise it would be a group
    primitives += below;
    return all;
}

/// Checks that the tree over the triangles of `narrow` is valid.
void check_tree(const fast::WideTreeView& tree, const Narrow& narrow)
{
    Census census{std::vector<int>(narrow.triangles.size())};
    std::uint32_t primitives = 0;
    if (!tree.nodes.empty())
        check_below(tree, narrow, 0, census, primitives);
    else if (!tree.groups.empty())
        check_below(tree, narrow, fast::leaf_bit, census, primitives);
    RC_ASSERT(primitives == narrow.triangles.size());
    for (const int times : census.seen) RC_ASSERT(times == 1);
    RC_ASSERT(census.nodes == tree.nodes.size()); // no unnecessary nodes
    RC_ASSERT(census.groups == tree.groups.size());
}

RC_GTEST_PROP(WideTree, HoldsEveryPrimitiveOnceInBoxesThatFit, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    Narrow narrow(*rc::gen::inRange<std::size_t>(0, 300), random);
    check_tree(narrow.widened(narrow.executor).view(), narrow);
}

/// The wide trees over the radix tree of `Code`, and over its clusters.
template <class Code>
std::array<WideTree, 2> widened_by_codes(Narrow& narrow)
{
    const auto count = static_cast<std::uint32_t>(narrow.triangles.size());
    fast::Lbvh<Code> sorted(narrow.memory, narrow.executor, count);
    sorted.build(narrow.executor, narrow.boxes);
    fast::Hploc clustered(narrow.memory, count);
    const fast::Divisions divisions(narrow.memory, narrow.executor, sorted.nodes(), sorted.leaf_links());
    WideTree radix{narrow.memory,   narrow.executor,     std::as_const(sorted).nodes(),
                   divisions.all(), sorted.primitives(), narrow.triangles};
    clustered.build(narrow.executor, narrow.boxes, sorted.order());
    return {std::move(radix), WideTree{narrow.memory, narrow.executor, clustered.nodes(),
                                       clustered.divisions(), sorted.primitives(), narrow.triangles}};
}

RC_GTEST_PROP(SurfaceTree, IsTheWideTreeOfItsBuilder, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    Narrow narrow(*rc::gen::inRange<std::size_t>(0, 300), random, random.below(2) == 0);
    const auto [morton30, hploc30] = widened_by_codes<std::uint32_t>(narrow);
    const auto [morton63, hploc63] = widened_by_codes<std::uint64_t>(narrow);
    const std::map<fast::TreeBuilder, const WideTree*> expected = {
        {fast::TreeBuilder::morton30, &morton30},
        {fast::TreeBuilder::morton63, &morton63},
        {fast::TreeBuilder::hploc30, &hploc30},
        {fast::TreeBuilder::hploc63, &hploc63}};
    for (const fast::TreeBuilder builder : fast::tree_builders) {
        const fast::SurfaceTree surfaces(narrow.memory, narrow.executor, narrow.triangles, {}, builder);
        const fast::WideTreeView tree = surfaces.view<false>().tree;
        check_tree(tree, narrow);
        RC_ASSERT(same_nodes(tree.nodes, expected.at(builder)->view().nodes));
        RC_ASSERT(same_groups(tree.groups, expected.at(builder)->view().groups));
    }
}

// The test above would not see two builders exchanged if their trees were the same.
TEST(SurfaceTree, OfTwoBuildersDiffer)
{
    Random random(1);
    Narrow narrow(300, random, true);
    std::vector<fast::SurfaceTree> trees;
    for (const fast::TreeBuilder builder : fast::tree_builders)
        trees.emplace_back(narrow.memory, narrow.executor, narrow.triangles,
                           std::span<const fast::Sphere>(), builder);
    for (std::size_t i = 0; i < trees.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            EXPECT_FALSE(
                same_nodes(trees[i].view<false>().tree.nodes, trees[j].view<false>().tree.nodes))
                << name_of(fast::tree_builders[i]) << ", " << name_of(fast::tree_builders[j]);
}

RC_GTEST_PROP(WideTree, IsTheSameForEveryExecutor, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    Narrow narrow(*rc::gen::inRange<std::size_t>(0, 100), random);
    const WideTree serial = narrow.widened(narrow.executor);
    fast::ThreadedExecutor threads(3, 1);
    const WideTree threaded = narrow.widened(threads);
    std::mt19937_64 schedule(random.bits());
    parallel_test::InterleavedExecutor adversary(
        8, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(schedule() % ready); });
    const WideTree interleaved = narrow.widened(adversary);
    for (const WideTree* tree : {&threaded, &interleaved}) {
        RC_ASSERT(same_nodes(tree->view().nodes, serial.view().nodes));
        RC_ASSERT(same_groups(tree->view().groups, serial.view().groups));
    }
}

/// All ways to collapse a binary tree, by trying them.
class AllCollapses {
public:
    AllCollapses(const Narrow& narrow) : nodes_(narrow.tree.nodes()) {}

    /// The least sum of the areas of wide nodes at and below `child`, which is one of them, or a group.
    double least_cost(std::uint32_t child)
    {
        if (is_group(child)) return 0;
        if (const auto known = costs_.find(child); known != costs_.end()) return known->second;
        double least = std::numeric_limits<double>::infinity();
        for (const std::vector<std::uint32_t>& children : cuts_below(child)) {
            double cost = 0;
            for (const std::uint32_t c : children) cost += least_cost(c);
            least = std::min(least, cost);
        }
        const Node& node = nodes_[child];
        return costs_[child] = least + half_area(unite(node.bounds[0], node.bounds[1]));
    }

private:
    using Cuts = std::vector<std::vector<std::uint32_t>>;

    std::uint32_t leaves(std::uint32_t child)
    {
        return fast::is_leaf(child)
                   ? 1
                   : leaves(nodes_[child].children[0]) + leaves(nodes_[child].children[1]);
    }
    bool is_group(std::uint32_t child) { return leaves(child) <= fast::most_in_group; }
    /// All sets of children that a wide node at `child` may have.
    Cuts cuts_below(std::uint32_t child)
    {
        Cuts result;
        for (const auto& left : cuts(nodes_[child].children[0]))
            for (const auto& right : cuts(nodes_[child].children[1])) {
                if (left.size() + right.size() > fast::most_children) continue;
                result.push_back(left);
                result.back().insert(result.back().end(), right.begin(), right.end());
            }
        return result;
    }
    /// All sets of children that may stand for `child`.
    Cuts cuts(std::uint32_t child)
    {
        Cuts result;
        if (!is_group(child)) result = cuts_below(child);
        result.push_back({child});
        return result;
    }

    std::span<const Node> nodes_;
    std::map<std::uint32_t, double> costs_;
};

RC_GTEST_PROP(WideTree, HasTheLeastSumOfAreasOfAllCollapsedTrees, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    Narrow narrow(*rc::gen::inRange<std::size_t>(fast::most_in_group + 1, 90), random);
    const WideTree tree = narrow.widened(narrow.executor);
    double cost = 0;
    for (const WideNode& node : tree.view().nodes) {
        Aabb box = fast::empty_aabb();
        for (int c = 0; c < fast::most_children; ++c)
            if (node.children[c] != fast::no_node) box = unite(box, node.box(c));
        cost += half_area(box);
    }
    // All terms are positive. A sum in floats of m terms errs by at most m u; the choice between two
    // divisions, twice that. There are fewer than 90 terms.
    const double least = AllCollapses(narrow).least_cost(0);
    RC_ASSERT(cost <= least * (1 + 180 * 0x1p-24));
    RC_ASSERT(cost >= least * (1 - 1e-12));
}

// Triangles without area on a line: whatever the nodes are, the sum of areas is 0. Then the fewest nodes
// are best.
TEST(WideTree, HasFewNodesIfNoBoxHasAnArea)
{
    std::vector<Triangle> triangles;
    for (int i = 0; i < 4096; ++i) {
        const auto x = static_cast<float>(i);
        triangles.push_back({{Vec3(x, 0, 0), Vec3(x + 0.5f, 0, 0), Vec3(x, 0, 0)}});
    }
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    for (const fast::TreeBuilder builder : fast::tree_builders) {
        const fast::SurfaceTree surfaces(memory, executor, triangles, {}, builder);
        const fast::WideTreeView tree = surfaces.view<false>().tree;
        // Nodes of eight children each are groups / 7. Here the subtrees do not divide evenly.
        EXPECT_LE(tree.nodes.size(), tree.groups.size() / 5) << name_of(builder);
    }
}

} // namespace
