// The steps of explain_tree lead to the nodes of the reference's tree.

#include "explain/tree.h"
#include "explain/tree_text.h"
#include "ref/trees/bvh.h"
#include "ref/trees/radix_tree.h"
#include "tests/ref/transport/random_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <stdexcept>

namespace {

using explain::Probe;

/// Codes with many equal ones, sorted.
std::vector<std::uint64_t> any_codes()
{
    std::vector<std::uint64_t> codes(static_cast<std::size_t>(transport_test::any_number(2.0, 60.0)));
    const bool few = transport_test::any_chance(0.5);
    for (std::uint64_t& code : codes)
        code = few ? std::uint64_t{*transport_test::any_word()} % 8
                   : std::uint64_t{*transport_test::any_word()} << 20;
    std::ranges::sort(codes);
    return codes;
}

RC_GTEST_PROP(ExplainTree, SearchesLeadToTheNodesOfTheReference, ())
{
    const std::vector<std::uint64_t> codes = any_codes();
    for (std::int64_t i = 0; i + 1 < std::ssize(codes); ++i) {
        const explain::NodeSearch search = explain::search_of_node(codes, i);
        const auto [first, last, gamma] = ref::radix_node(codes, i);
        RC_ASSERT(std::min(search.i, search.j) == first);
        RC_ASSERT(std::max(search.i, search.j) == last);
        RC_ASSERT(search.gamma == gamma);
        std::int64_t l = 0;
        for (const Probe& probe : search.length) {
            RC_ASSERT(probe.key == i + (l + probe.step) * search.d);
            RC_ASSERT(probe.delta == ref::delta(codes, i, probe.key));
            RC_ASSERT(probe.longer == (probe.delta > search.delta_min));
            l += probe.longer ? probe.step : 0;
        }
        RC_ASSERT(l == search.l);
        RC_ASSERT(!search.doubling.back().longer);
    }
}

std::vector<ref::Aabb> any_boxes(std::size_t count)
{
    std::vector<ref::Aabb> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        const ref::Vec3 p = transport_test::any_point(1.0);
        boxes.push_back({p, p + ref::Vec3(transport_test::any_number(0.0, 0.3))});
        if (transport_test::any_chance(0.3)) boxes.push_back(boxes.back());
    }
    return boxes;
}

RC_GTEST_PROP(ExplainTree, TheWayLeadsToTheRootThroughTheTree, ())
{
    const auto boxes = any_boxes(static_cast<std::size_t>(transport_test::any_number(1.0, 40.0)));
    const int bits = transport_test::any_chance(0.5) ? 10 : 21;
    const ref::Tree tree =
        ref::build(boxes, bits == 10 ? ref::Builder::morton30 : ref::Builder::morton63);
    for (std::uint32_t primitive = 0; primitive < boxes.size(); ++primitive) {
        const explain::TreeExplanation told = explain::explain_tree(boxes, bits, primitive);
        RC_ASSERT(tree.primitives[tree.leaf_begin[tree.leaf(told.leaf)]] == primitive);
        RC_ASSERT(told.key.code == ref::morton_encode(told.cell));
        std::uint32_t node = told.leaf;
        for (const explain::Ancestor& at : told.way) {
            RC_ASSERT(at.node == tree.nodes[node].parent);
            RC_ASSERT(at.bounds == tree.bounds[at.node]);
            RC_ASSERT(std::ranges::is_permutation(at.from, tree.nodes[at.node].children));
            RC_ASSERT(at.first <= told.key.place && told.key.place <= at.last);
            // From left to right, the last leaf of each child finishes it.
            RC_ASSERT(at.arrives[0] == at.gamma);
            RC_ASSERT(at.arrives[1] == at.last);
            node = at.node;
        }
        RC_ASSERT(tree.nodes[node].parent == ref::no_node);
        RC_ASSERT(told.search.has_value() == (told.key.place + 1 < std::ssize(boxes)));
    }
}

TEST(ExplainTree, RefusesAPrimitiveThatDoesNotExist)
{
    const std::vector<ref::Aabb> boxes(3, ref::Aabb{ref::Vec3(0.0), ref::Vec3(1.0)});
    EXPECT_THROW((void)explain::explain_tree(boxes, 10, 3), std::invalid_argument);
}

// Whatever the order in which the walks start, the walk that starts last among the leaves of a node is
// the second to arrive there, and of the other child's leaves it is again the last that arrives.
RC_GTEST_PROP(ExplainTree, TheLastWalkOfEachChildArrives, ())
{
    const auto boxes = any_boxes(static_cast<std::size_t>(transport_test::any_number(1.0, 40.0)));
    const ref::Tree tree = ref::build(boxes, ref::Builder::morton30);
    std::vector<std::uint32_t> order(tree.leaf_count());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, std::mt19937(*transport_test::any_word()));
    std::vector<std::size_t> starts(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) starts[order[i]] = i;
    const auto arrivals = explain::refit_arrivals(tree, order);

    // The leaf whose walk starts last, of each node.
    std::vector<std::uint32_t> last(tree.nodes.size());
    const std::function<std::uint32_t(std::uint32_t)> find = [&](std::uint32_t node) {
        if (tree.is_leaf(node)) return last[node] = tree.leaf(node);
        const std::uint32_t a = find(tree.nodes[node].children[0]);
        const std::uint32_t b = find(tree.nodes[node].children[1]);
        return last[node] = starts[a] > starts[b] ? a : b;
    };
    find(0);
    for (std::uint32_t node = 0; node < tree.internal_count(); ++node) {
        RC_ASSERT(std::ranges::is_permutation(arrivals[node].children, tree.nodes[node].children));
        RC_ASSERT(arrivals[node].leaves[1] == last[node]);
        for (const std::size_t i : {0U, 1U})
            RC_ASSERT(arrivals[node].leaves[i] == last[arrivals[node].children[i]]);
    }
}

} // namespace
