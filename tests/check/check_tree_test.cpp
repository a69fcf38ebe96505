// check_tree names every way in which a tree can be broken, and measures right ones.

#include "check/trees/check_tree.h"

#include "check/trees/inputs.h"
#include "check/trees/report.h"
#include "ref/trees/bvh.h"
#include "ref/trees/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using check::check_tree;
using check::InputKind;
using check::NeutralTree;
using check::TreeReport;

std::vector<ref::Aabb> eight_boxes()
{
    return check::input_boxes(InputKind::grid, 8, 1);
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

} // namespace
