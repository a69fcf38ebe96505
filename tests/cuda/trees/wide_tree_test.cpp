// The conversion of narrow trees to wide ones.

#include "cuda/trees/wide_tree.h"

#include "tests/cuda/parallel/interleaved_executor.h"
#include "tests/cuda/trees/triangles.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
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
using trees_test::Random;

/// A narrow tree over random triangles, some of them coincident. `one_is_far`: so far away that all
/// others have the same code of 30 bits.
struct Narrow {
    Narrow(std::size_t n, Random& random, bool one_is_far = false)
        : tree(memory, executor, static_cast<std::uint32_t>(n))
    {
        for (std::size_t i = 0; i < n; ++i) {
            const ref::Vec3 at = random.in_cube();
            const double size = random.magnitude(-3, 0);
            Triangle triangle{};
            for (Vec3& vertex : triangle.vertices) vertex = Vec3(at + size * random.in_cube());
            triangles.push_back(i > 0 && random.below(8) == 0 ? triangles[random.below(i)] : triangle);
        }
        if (one_is_far && n > 0)
            for (Vec3& vertex : triangles[0].vertices) vertex += Vec3(1e4f);
        boxes.resize(n);
        executor(static_cast<std::uint32_t>(n), fast::BoundTriangles{triangles, boxes});
        tree.build(executor, boxes);
    }
    template <fast::Executor E>
    WideTree widened(E& by)
    {
        return {memory,   by, std::as_const(tree).nodes(), tree.leaf_links(), tree.primitives(),
                triangles};
    }
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    std::vector<Triangle> triangles;
    std::vector<Aabb> boxes;
    fast::Lbvh<std::uint64_t> tree;
};

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

bool same_nodes(std::span<const WideNode> a, std::span<const WideNode> b)
{
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) // the elements after them are undefined
        if (std::memcmp(a[i].planes, b[i].planes, sizeof a[i].planes) != 0 ||
            std::memcmp(a[i].children, b[i].children, sizeof a[i].children) != 0)
            return false;
    return true;
}

bool same_groups(std::span<const TriangleGroup> a, std::span<const TriangleGroup> b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
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
    WideTree radix{narrow.memory,       narrow.executor,     std::as_const(sorted).nodes(),
                   sorted.leaf_links(), sorted.primitives(), narrow.triangles};
    clustered.build(narrow.executor, narrow.boxes, sorted);
    return {std::move(radix), WideTree{narrow.memory, narrow.executor, std::as_const(clustered).nodes(),
                                       clustered.leaf_links(), sorted.primitives(), narrow.triangles}};
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
    const WideTree tree(memory, executor, made.nodes, made.leaf_links, primitives, triangles);
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
