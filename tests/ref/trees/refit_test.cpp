#include "ref/trees/refit.h"

#include "ref/trees/bvh.h"
#include "ref/trees/is_valid_tree.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using ref::Aabb;
using ref::Tree;
using trees_test::Kind;
using trees_test::Random;

/// The box of a node by recursion: the expected result of refit.
Aabb box_below(const Tree& tree, std::span<const Aabb> boxes, std::uint32_t node)
{
    if (tree.is_leaf(node)) return boxes[tree.primitives[tree.leaf(node)]];
    return unite(box_below(tree, boxes, tree.nodes[node].children[0]),
                 box_below(tree, boxes, tree.nodes[node].children[1]));
}

Tree without_boxes(Tree tree)
{
    for (Aabb& box : tree.bounds) box = {ref::Vec3(-77), ref::Vec3(77)};
    return tree;
}

// map: refit
TEST(Refit, GivesTheSameBoxesForEveryOrderOfArrival) // all orders of up to 6 leaves, and some of 7
{
    Random random(1);
    for (std::size_t n = 0; n <= 6; ++n)
        for (int repeat = 0; repeat < 5; ++repeat) {
            const std::vector<Aabb> boxes = trees_test::boxes(static_cast<Kind>(repeat), n, random);
            const Tree built = ref::build(boxes, ref::Builder::morton30);
            std::vector<std::uint32_t> order(n);
            std::iota(order.begin(), order.end(), 0);
            do {
                Tree tree = without_boxes(built);
                refit(tree, boxes, order);
                for (std::uint32_t node = 0; node < tree.nodes.size(); ++node)
                    ASSERT_EQ(tree.bounds[node], box_below(tree, boxes, node)) << "n " << n;
            } while (std::next_permutation(order.begin(), order.end()));
        }
}

RC_GTEST_PROP(Refit, DoesNotDependOnTheOrderOfLeaves, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::size_t n = *rc::gen::inRange<std::size_t>(1, 500);
    const auto kind = static_cast<Kind>(*rc::gen::inRange(0, trees_test::kinds));
    const std::vector<Aabb> boxes = trees_test::boxes(kind, n, random);
    const Tree built =
        ref::build(boxes, *rc::gen::element(ref::Builder::morton30, ref::Builder::morton63));
    std::vector<std::uint32_t> order(n);
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    Tree tree = without_boxes(built);
    refit(tree, boxes, order);
    RC_ASSERT(tree == built);
}

RC_GTEST_PROP(Refit, AfterPrimitivesMoveGivesTheBoxesOfTheNewPlaces, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::size_t n = *rc::gen::inRange<std::size_t>(1, 300);
    const auto builder =
        *rc::gen::element(ref::Builder::morton30, ref::Builder::sah, ref::Builder::sah_leaf);
    Tree tree = ref::build(trees_test::boxes(Kind::uniform, n, random), builder);
    const std::vector<Aabb> moved =
        trees_test::boxes(static_cast<Kind>(*rc::gen::inRange(0, trees_test::kinds)), n, random);
    refit(tree, moved);
    RC_ASSERT(is_valid_tree(tree, moved) == std::vector<std::string>());
}

} // namespace
