// is_valid_tree must detect every way in which a tree can be broken.

#include "ref/trees/is_valid_tree.h"

#include "ref/trees/bvh.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>

#include <functional>

namespace {

using ref::Aabb;
using ref::Tree;
using trees_test::Kind;
using trees_test::Random;

struct Broken {
    const char* name;
    std::function<void(Tree&)> damage;
    const char* says;
};

TEST(IsValidTree, NamesWhatIsBroken)
{
    Random random(1);
    const std::vector<Aabb> boxes = trees_test::boxes(Kind::uniform, 8, random);
    const Tree good = ref::build(boxes, ref::Builder::morton63);
    ASSERT_EQ(is_valid_tree(good, boxes), std::vector<std::string>());
    const std::vector<Broken> kinds = {
        {"one node too few", [](Tree& t) { t.nodes.pop_back(); }, "need"},
        {"one node too many", [](Tree& t) { t.nodes.emplace_back(); }, "need"},
        {"one box too few", [](Tree& t) { t.bounds.pop_back(); }, "boxes"},
        {"no nodes", [](Tree& t) { t.nodes.clear(); }, "need"},
        {"no leaves", [](Tree& t) { t = Tree{}; }, "no leaf"},
        {"a primitive twice", [](Tree& t) { t.primitives[0] = t.primitives[1]; }, "times"},
        {"a primitive that does not exist", [](Tree& t) { t.primitives[0] = 8; }, "no primitive 8"},
        {"one primitive too few", [](Tree& t) { t.primitives.pop_back(); }, "divide"},
        {"an empty leaf", [](Tree& t) { t.leaf_begin[3] = t.leaf_begin[2]; }, "empty"},
        {"a null child", [](Tree& t) { t.nodes[2].children[0] = ref::no_node; }, "not there"},
        {"a child out of range", [](Tree& t) { t.nodes[2].children[1] = 15; }, "not there"},
        {"a null parent", [](Tree& t) { t.nodes[9].parent = ref::no_node; }, "parent"},
        {"a wrong parent", [](Tree& t) { t.nodes[9].parent = t.nodes[9].parent == 1 ? 2 : 1; },
         "parent"},
        {"a root with a parent", [](Tree& t) { t.nodes[0].parent = 1; }, "root"},
        {"a leaf with children",
         [](Tree& t) {
             t.nodes[9].children = {3, 4};
         },
         "leaf"},
        {"a child of two parents", [](Tree& t) { t.nodes[1].children[0] = t.nodes[0].children[0]; },
         "parents"},
        {"children in the wrong order",
         [](Tree& t) { std::swap(t.nodes[0].children[0], t.nodes[0].children[1]); }, "range"},
        {"a box too small",
         [](Tree& t) { t.bounds[0].upper.x = std::nextafter(t.bounds[0].upper.x, -9.0); },
         "box of node 0"},
        {"a box too large",
         [](Tree& t) { t.bounds[10].lower.z = std::nextafter(t.bounds[10].lower.z, -9.0); },
         "box of node 10"},
        {"the scene's box everywhere", [](Tree& t) { t.bounds.assign(t.bounds.size(), t.bounds[0]); },
         "box of node"},
        {"an empty box", [](Tree& t) { t.bounds[3] = Aabb{}; }, "box of node 3"},
        {"NaN in a box", [](Tree& t) { t.bounds[3].lower.x = std::nan(""); }, "box of node 3"},
    };
    for (const Broken& kind : kinds) {
        Tree tree = good;
        kind.damage(tree);
        const std::vector<std::string> found = is_valid_tree(tree, boxes);
        bool named = false;
        for (const std::string& line : found) named = named || line.find(kind.says) != std::string::npos;
        EXPECT_TRUE(named) << kind.name << ": " << (found.empty() ? "nothing found" : found[0]);
    }
}

TEST(IsValidTree, SeesACycleThatTheRootDoesNotReach)
{
    // Nodes 1 and 2 are each other's child: all nodes have one parent, but only two leaves can be
    // reached from the root.
    const std::vector<Aabb> boxes(4, Aabb{ref::Vec3(0), ref::Vec3(1)});
    Tree tree = ref::build(boxes, ref::Builder::morton30);
    const auto link = [&](std::uint32_t node, std::uint32_t left, std::uint32_t right) {
        tree.nodes[node].children = {left, right};
        tree.nodes[left].parent = node;
        tree.nodes[right].parent = node;
    };
    link(0, 3, 4);
    link(1, 2, 5);
    link(2, 1, 6);
    const std::vector<std::string> found = is_valid_tree(tree, boxes);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0], "4 nodes cannot be reached from the root");
}

TEST(IsValidTree, AcceptsTheEmptyTreeForNoPrimitivesOnly)
{
    EXPECT_EQ(is_valid_tree(Tree{}, {}), std::vector<std::string>());
    const std::vector<Aabb> one = {{ref::Vec3(0), ref::Vec3(1)}};
    EXPECT_NE(is_valid_tree(Tree{}, one), std::vector<std::string>());
}

TEST(IsValidRadixTree, SeesASplitThatSharesNoLongerPrefix)
{
    // Over the codes 0, 1, 2, 3 the root must split in the middle; yet a chain is a valid tree.
    const std::vector<std::uint64_t> codes = {0, 1, 2, 3};
    const std::vector<Aabb> boxes(4, Aabb{ref::Vec3(0), ref::Vec3(1)});
    Tree tree = ref::build(boxes, ref::Builder::morton30);
    EXPECT_EQ(is_valid_radix_tree(tree, codes), std::vector<std::string>());
    const auto link = [&](std::uint32_t node, std::uint32_t left, std::uint32_t right) {
        tree.nodes[node].children = {left, right};
        tree.nodes[left].parent = node;
        tree.nodes[right].parent = node;
    };
    link(0, 3, 1);
    link(1, 4, 2);
    link(2, 5, 6);
    EXPECT_EQ(is_valid_tree(tree, boxes), std::vector<std::string>());
    EXPECT_EQ(
        is_valid_radix_tree(tree, codes),
        std::vector<std::string>{"the common prefix of node 1 is not longer than that of its parent 0"});
    EXPECT_NE(is_valid_radix_tree(tree, std::vector<std::uint64_t>{0, 1, 2}),
              std::vector<std::string>());
}

} // namespace
