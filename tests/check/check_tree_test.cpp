// check_tree names every way in which a tree can be broken, and accepts every numbering of a right one.

#include "check/trees/check_tree.h"

#include "check/trees/inputs.h"
#include "check/trees/report.h"
#include "ref/trees/bvh.h"
#include "ref/trees/is_valid_tree.h"
#include "ref/trees/quality.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

namespace {

using check::check_tree;
using check::InputKind;
using check::NeutralTree;
using check::TreeReport;

std::vector<ref::Aabb> eight_boxes()
{
    return check::input_boxes(InputKind::grid, 8, 1);
}

/// One of the kinds without NaN and infinite coordinates.
InputKind legal_kind(std::uint64_t number)
{
    const auto legal = std::span(check::input_kinds).subspan(1).first<14>();
    return legal[number % legal.size()];
}

struct Broken {
    const char* name;
    std::function<void(NeutralTree&)> damage;
    const char* property;
    const char* example;
};

TEST(CheckTree, NamesThePropertyAndTheFirstCounterExample)
{
    // A balanced tree over the cells of a grid of 2 x 2 x 2: internal nodes 0 to 6, leaves 7 to 14.
    const std::vector<ref::Aabb> boxes = eight_boxes();
    const NeutralTree good = check::neutral(ref::build(boxes, ref::Builder::morton63));
    ASSERT_TRUE(check_tree(good, boxes).passes()) << describe(check_tree(good, boxes));
    const std::int64_t child = good.nodes[0];
    const std::int64_t leaf_5 = 4 * 12; // the row of leaf node 12
    const std::vector<Broken> kinds = {
        {"a box too few", [](NeutralTree& t) { t.boxes.pop_back(); }, "sizes", "15 nodes have 14 boxes"},
        {"half a node", [](NeutralTree& t) { t.nodes.pop_back(); }, "sizes", "no multiple of 4"},
        {"parents missing", [](NeutralTree& t) { t.parents.pop_back(); }, "sizes", "14 parents"},
        {"empty leaf", [&](NeutralTree& t) { t.nodes[static_cast<std::size_t>(leaf_5) + 3] = 0; },
         "nodes", "node 12 has neither children nor primitives"},
        {"internal node with primitives", [](NeutralTree& t) { t.nodes[3] = 2; }, "nodes",
         "node 0 has children, and 2 primitives"},
        {"one child", [](NeutralTree& t) { t.nodes[1] = -1; }, "nodes",
         "node 0 of a binary tree has one child"},
        {"child out of range", [](NeutralTree& t) { t.nodes[1] = 15; }, "indices",
         "node 0 has the child 15: there are 15 nodes"},
        {"slots out of range",
         [&](NeutralTree& t) { t.nodes[static_cast<std::size_t>(leaf_5) + 2] = 8; }, "indices",
         "node 12 has 1 slots from 8 on: there are 8"},
        {"slots beyond 64 bits",
         [&](NeutralTree& t) {
             t.nodes[static_cast<std::size_t>(leaf_5) + 2] = INT64_MAX;
             t.nodes[static_cast<std::size_t>(leaf_5) + 3] = INT64_MAX;
         },
         "indices", "node 12 has 9223372036854775807 slots from 9223372036854775807 on"},
        {"no such primitive", [](NeutralTree& t) { t.primitives[2] = 8; }, "indices",
         "node 9 holds primitive 8: there are 8"},
        {"two roots",
         [](NeutralTree& t) {
             t.nodes.insert(t.nodes.end(), {-1, -1, 0, 1});
             t.boxes.push_back(t.boxes[7]);
             t.parents.push_back(-1);
         },
         "one-root", "node 0 and node 15 are nobody's child"},
        {"a root with a parent", [&](NeutralTree& t) { t.root = child; }, "one-root",
         "is a child of node 0"},
        {"a root that is not there", [](NeutralTree& t) { t.root = 15; }, "one-root",
         "the root is node 15"},
        {"a child of two", [](NeutralTree& t) { t.nodes[4] = t.nodes[1]; }, "one-parent",
         "is a child of node 0 and of node 1"},
        {"a wrong parent", [](NeutralTree& t) { t.parents[9] = 0; }, "parents",
         "node 9 names node 0, and is a child of node"},
        {"a primitive twice", [](NeutralTree& t) { t.primitives[1] = t.primitives[0]; }, "primitives",
         "primitive 0 is in node 7 and in node 8"},
        {"a slot left out", [](NeutralTree& t) { t.nodes[4 * 8 + 2] = 0; }, "primitives",
         "primitive 0 is in node 7 and in node 8"},
        {"a box too small", [](NeutralTree& t) { t.boxes[0].upper.x = 1.75; }, "contain",
         "the box of node 0 ends at x = 1.75, that of its child, node"},
        {"a leaf's box too small", [](NeutralTree& t) { t.boxes[7].lower.z = 0.5; }, "contain",
         "the box of node 7 begins at z = 0.5, that of its primitive 0 at 0"},
        {"NaN in a box", [](NeutralTree& t) { t.boxes[3].lower.x = std::nan(""); }, "contain",
         "the box of node 0 begins at x = 0, that of its child, node 3, at nan"},
        {"a box too large by one bit",
         [](NeutralTree& t) { t.boxes[7].upper.y = std::nextafter(1.0, 2.0); }, "contain",
         "ends at y = 1, that of its child, node 7, at 1.0000000000000002"},
        {"all boxes too large", [](NeutralTree& t) { t.boxes.assign(15, t.boxes[0]); }, "tight",
         "ends at"},
    };
    for (const Broken& kind : kinds) {
        NeutralTree tree = good;
        kind.damage(tree);
        const TreeReport report = check_tree(tree, boxes);
        const check::Property* failure = report.first_failure();
        ASSERT_NE(failure, nullptr) << kind.name;
        EXPECT_EQ(failure->name, kind.property) << kind.name << ": " << describe(report);
        EXPECT_NE(failure->example.find(kind.example), std::string::npos)
            << kind.name << ": " << failure->example;
    }
}

TEST(CheckTree, NamesAPrimitiveThatIsInNoLeaf)
{
    const std::vector<ref::Aabb> boxes(2, {ref::Vec3(0), ref::Vec3(1)});
    NeutralTree tree;
    tree.nodes = {-1, -1, 0, 1};
    tree.boxes = {boxes[0]};
    tree.primitives = {0, 1};
    const TreeReport report = check_tree(tree, boxes);
    ASSERT_FALSE(report.passes());
    EXPECT_EQ(report.first_failure()->name, "primitives");
    EXPECT_EQ(report.first_failure()->example, "primitive 1 is in no leaf");
    EXPECT_EQ(report.first_failure()->primitive, 1);
}

TEST(CheckTree, NamesACycle)
{
    // Nodes 1 and 2 are each other's child; only node 0 and two leaves are reached.
    const std::vector<ref::Aabb> boxes(4, {ref::Vec3(0), ref::Vec3(1)});
    NeutralTree tree;
    tree.nodes = {3, 4, 0,  0,  2, 5, 0,  0,  1, 6, 0,  0,  -1, -1,
                  0, 1, -1, -1, 1, 1, -1, -1, 2, 1, -1, -1, 3,  1};
    tree.boxes.assign(7, boxes[0]);
    tree.primitives = {0, 1, 2, 3};
    const TreeReport report = check_tree(tree, boxes);
    ASSERT_FALSE(report.passes());
    EXPECT_EQ(report.first_failure()->name, "reachable");
    EXPECT_EQ(report.first_failure()->violations, 4U);
    EXPECT_EQ(report.first_failure()->example,
              "node 1 is not reached from the root, node 0: it is in a cycle or below one");
}

TEST(CheckTree, AcceptsTheTreesOverNothing)
{
    EXPECT_TRUE(check_tree({}, {}).passes());
    NeutralTree empty_leaf;
    empty_leaf.nodes = {-1, -1, 0, 0};
    empty_leaf.boxes.resize(1);
    EXPECT_TRUE(check_tree(empty_leaf, {}).passes());
    EXPECT_FALSE(check_tree({}, eight_boxes()).passes());
    EXPECT_FALSE(check_tree(empty_leaf, eight_boxes()).passes());
}

TEST(CheckTree, MeasuresAsTheReferenceDoes)
{
    const std::vector<ref::Aabb> boxes = check::input_boxes(InputKind::uniform, 200, 3);
    check::TreeChecks checks;
    checks.costs = true;
    for (const ref::Builder builder : {ref::Builder::morton63, ref::Builder::sah_leaf}) {
        const ref::Tree tree = ref::build(boxes, builder);
        const ref::Quality quality = ref::quality(tree);
        const TreeReport report = check_tree(check::neutral(tree), boxes, checks);
        ASSERT_TRUE(report.costs && report.shape);
        EXPECT_NEAR(report.costs->tree, quality.sah_cost, 1e-12 * quality.sah_cost);
        EXPECT_EQ(report.shape->depth, static_cast<std::size_t>(quality.depth));
        EXPECT_NEAR(report.shape->mean_leaf_depth, quality.mean_leaf_depth, 1e-10);
        EXPECT_EQ(report.shape->in_order_of_63_bits, builder == ref::Builder::morton63);
        EXPECT_EQ(report.costs->lbvh, ref::quality(ref::build(boxes, ref::Builder::morton63)).sah_cost);
    }
}

TEST(CheckTree, LimitsDepthAndOrderWhereAsked)
{
    const std::vector<ref::Aabb> boxes = eight_boxes();
    NeutralTree tree = check::neutral(ref::build(boxes, ref::Builder::morton30));
    check::TreeChecks checks;
    checks.max_depth = 3;
    checks.morton_bits = 30;
    EXPECT_TRUE(check_tree(tree, boxes, checks).passes());
    checks.max_depth = 2;
    EXPECT_EQ(check_tree(tree, boxes, checks).first_failure()->name, "depth");
    checks.max_depth.reset();
    std::swap(tree.nodes[0], tree.nodes[1]); // a valid tree in another order
    EXPECT_EQ(check_tree(tree, boxes, checks).first_failure()->name, "morton-order");
    checks.morton_bits = 0;
    EXPECT_TRUE(check_tree(tree, boxes, checks).passes());
}

TEST(CheckTree, AcceptsFloatsThatAreRoundedOutwards)
{
    const std::vector<ref::Aabb> boxes = check::input_boxes(InputKind::uniform, 50, 5, false);
    NeutralTree tree = check::neutral(ref::build(boxes, ref::Builder::sah));
    const float infinity = std::numeric_limits<float>::infinity();
    for (auto& [lower, upper] : tree.boxes)
        for (int axis = 0; axis < 3; ++axis) {
            auto low = static_cast<float>(lower[axis]);
            auto high = static_cast<float>(upper[axis]);
            if (low > lower[axis]) low = std::nextafter(low, -infinity);
            if (high < upper[axis]) high = std::nextafter(high, infinity);
            lower[axis] = low;
            upper[axis] = high;
        }
    EXPECT_EQ(check_tree(tree, boxes).first_failure()->name, "tight");
    tree.single_precision = true;
    EXPECT_TRUE(check_tree(tree, boxes).passes()) << describe(check_tree(tree, boxes));
    tree.boxes[7].upper.x = std::nextafter(static_cast<float>(tree.boxes[7].upper.x), infinity);
    EXPECT_FALSE(check_tree(tree, boxes).passes());
}

/// Node `node` of the binary tree and its grandchildren as nodes of up to four children, appended to
/// `wide`. Returns its number.
std::int64_t append_wide(const NeutralTree& binary, std::int64_t node, NeutralTree& wide)
{
    const auto at = static_cast<std::size_t>(node);
    std::vector<std::int64_t> children;
    for (const std::int64_t child : binary.children(at)) {
        if (child == NeutralTree::none) continue;
        const auto below = static_cast<std::size_t>(child);
        if (binary.is_leaf(below))
            children.push_back(child);
        else
            children.insert(children.end(), binary.children(below).begin(),
                            binary.children(below).end());
    }
    std::vector<std::int64_t> row;
    for (const std::int64_t child : children) row.push_back(append_wide(binary, child, wide));
    row.resize(4, NeutralTree::none);
    row.push_back(binary.first_slot(at));
    row.push_back(binary.slot_count(at));
    wide.nodes.insert(wide.nodes.end(), row.begin(), row.end());
    wide.boxes.push_back(binary.boxes[at]);
    return static_cast<std::int64_t>(wide.boxes.size()) - 1;
}

TEST(CheckTree, AcceptsWideTreesWithTheRootAnywhere)
{
    const std::vector<ref::Aabb> boxes = check::input_boxes(InputKind::uniform, 100, 9);
    const NeutralTree binary = check::neutral(ref::build(boxes, ref::Builder::sah_leaf));
    NeutralTree wide;
    wide.width = 4;
    wide.primitives = binary.primitives;
    const std::int64_t root = append_wide(binary, 0, wide); // the last node
    const TreeReport report = check_tree(wide, boxes);
    EXPECT_TRUE(report.passes()) << describe(report);
    EXPECT_EQ(report.shape->root, root);
    EXPECT_LT(report.shape->depth, check_tree(binary, boxes).shape->depth);
}

TEST(CheckTree, NeedsNoStackForADeepTree)
{
    // A chain: node i has the leaf n - 1 + i and the node i + 1.
    const std::int64_t n = 300'000;
    const std::vector<ref::Aabb> boxes(static_cast<std::size_t>(n), {ref::Vec3(0), ref::Vec3(1)});
    NeutralTree tree;
    for (std::int64_t i = 0; i + 1 < n; ++i)
        tree.nodes.insert(tree.nodes.end(), {n - 1 + i, i + 2 < n ? i + 1 : 2 * n - 2, 0, 0});
    for (std::int64_t i = 0; i < n; ++i) {
        tree.nodes.insert(tree.nodes.end(), {-1, -1, i, 1});
        tree.primitives.push_back(i);
    }
    tree.boxes.assign(static_cast<std::size_t>(2 * n - 1), boxes[0]);
    const TreeReport report = check_tree(tree, boxes);
    EXPECT_TRUE(report.passes()) << describe(report);
    EXPECT_EQ(report.shape->depth, static_cast<std::size_t>(n) - 1);
}

RC_GTEST_PROP(CheckTree, AcceptsEveryNumberingOfTheNodes, ())
{
    std::mt19937_64 bits(*rc::gen::arbitrary<std::uint64_t>());
    const std::vector<ref::Aabb> boxes = check::input_boxes(legal_kind(bits()), 1 + bits() % 40, bits());
    const NeutralTree tree = check::neutral(ref::build(boxes, ref::Builder::sah_leaf));
    std::vector<std::size_t> number(tree.size());
    std::iota(number.begin(), number.end(), std::size_t{0});
    std::shuffle(number.begin(), number.end(), bits);
    const auto renumbered = [&](std::int64_t node) {
        return node == NeutralTree::none
                   ? node
                   : static_cast<std::int64_t>(number[static_cast<std::size_t>(node)]);
    };
    NeutralTree other = tree;
    for (std::size_t node = 0; node < tree.size(); ++node) {
        const std::size_t to = number[node];
        for (std::size_t i = 0; i < 4; ++i)
            other.nodes[4 * to + i] =
                i < 2 ? renumbered(tree.nodes[4 * node + i]) : tree.nodes[4 * node + i];
        other.boxes[to] = tree.boxes[node];
        other.parents[to] = renumbered(tree.parents[node]);
    }
    RC_ASSERT(check_tree(other, boxes).passes());
}

RC_GTEST_PROP(CheckTree, AgreesWithTheReferencesCheckOnDamagedTrees, ())
{
    std::mt19937_64 bits(*rc::gen::arbitrary<std::uint64_t>());
    const std::vector<ref::Aabb> boxes = check::input_boxes(legal_kind(bits()), 2 + bits() % 6, bits());
    ref::Tree tree = ref::build(boxes, ref::Builder::morton30);
    const std::size_t node = bits() % tree.nodes.size();
    const auto number = static_cast<std::uint32_t>(bits() % (tree.nodes.size() + 1));
    switch (bits() % 4) {
    case 0: // not of a leaf: the reference tells leaves by their numbers
        tree.nodes[node % tree.internal_count()].children[bits() % 2] = number;
        break;
    case 1:
        tree.nodes[node].parent = number;
        break;
    case 2:
        tree.primitives[bits() % boxes.size()] = static_cast<std::uint32_t>(bits() % (boxes.size() + 1));
        break;
    default:
        tree.bounds[node].lower.y = tree.bounds[bits() % tree.nodes.size()].lower.y;
    }
    bool valid = true; // but for the order of leaves, which any other builder may choose
    for (const std::string& line : is_valid_tree(tree, boxes))
        valid = valid && line.ends_with("are not one range");
    RC_ASSERT(check_tree(check::neutral(tree), boxes).passes() == valid);
}

} // namespace
