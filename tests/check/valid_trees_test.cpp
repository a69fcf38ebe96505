// check_tree accepts every form of a right tree, and nothing that the reference's own check rejects.

#include "check/trees/check_tree.h"

#include "check/trees/inputs.h"
#include "check/trees/report.h"
#include "ref/trees/bvh.h"
#include "ref/trees/is_valid_tree.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace {

using check::check_tree;
using check::InputKind;
using check::NeutralTree;
using check::TreeReport;

/// One of the kinds without NaN and infinite coordinates.
InputKind legal_kind(std::uint64_t number)
{
    const auto legal = std::span(check::input_kinds).subspan(1).first<14>();
    return legal[number % legal.size()];
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
