// The refit under every order of the threads' atomic steps.

#include "cuda/trees/lbvh.h"
#include "tests/cuda/parallel/interleaved_executor.h"
#include "tests/cuda/trees/build_on.h"
#include "tests/cuda/trees/refit_arrivals.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <random>

namespace {

using parallel_test::EveryChoice;
using parallel_test::InterleavedExecutor;
using trees_test::Random;
using Words = std::array<std::uint32_t, 16>; // of a node

/// A tree that was built by the serial executor, and its nodes with all boxes overwritten.
struct Unfitted {
    fast::HostMemory memory;
    std::vector<fast::Aabb> boxes;
    fast::Lbvh<std::uint32_t> tree;
    std::vector<fast::Node> nodes;

    explicit Unfitted(std::vector<fast::Aabb> these)
        : boxes(std::move(these)),
          tree(memory, fast::SerialExecutor{}, static_cast<std::uint32_t>(boxes.size()))
    {
        fast::SerialExecutor serial;
        tree.build(serial, boxes);
    }
    /// Refits the boxes on `executor`, and returns whether all are as the serial executor computed
    /// them.
    template <std::uint32_t (*arrive_at)(std::uint32_t&)>
    bool refits(InterleavedExecutor& executor)
    {
        nodes.assign(tree.nodes().begin(), tree.nodes().end());
        for (fast::Node& node : nodes)
            node.bounds[0] = node.bounds[1] = {fast::Vec3(77), fast::Vec3(-77)};
        executor(tree.primitive_count(),
                 fast::RefitBounds<arrive_at>{boxes, tree.primitives(), tree.leaf_links(), nodes});
        for (std::size_t i = 0; i < nodes.size(); ++i)
            if (std::bit_cast<Words>(nodes[i]) != std::bit_cast<Words>(tree.nodes()[i])) return false;
        return true;
    }
};

/// Boxes whose tree is either balanced or a chain.
std::vector<fast::Aabb> in_a_row(std::uint32_t n, bool chain)
{
    std::vector<fast::Aabb> boxes;
    for (std::uint32_t i = 0; i < n; ++i) {
        const auto at = chain ? std::ldexp(1.0f, static_cast<int>(i)) : static_cast<float>(i);
        boxes.push_back({fast::Vec3(at), fast::Vec3(at + 0.5f)});
    }
    return boxes;
}

TEST(RefitInEveryInterleaving, GivesTheSameBoxes) // map: refit
{
    for (std::uint32_t n = 1; n <= 4; ++n)
        for (const bool chain : {false, true}) {
            if (chain && n < 4) continue; // with fewer there is only one shape and its mirror image
            Unfitted unfitted(in_a_row(n, chain));
            EveryChoice choices;
            InterleavedExecutor executor(n, std::ref(choices));
            int rounds = 0;
            do {
                ASSERT_TRUE(unfitted.refits<fast::arrive>(executor)) << n << " leaves, round " << rounds;
                ++rounds;
            } while (choices.next_round());
            RecordProperty("interleavings_of_" + std::to_string(n) + (chain ? "_in_a_chain" : ""),
                           rounds);
            // The number of orders of the pieces between atomic steps. A leaf has one piece more than
            // arrivals. For two leaves it is 4! / (2! 2!) = 6. For four balanced leaves, one of each
            // pair goes on to the root, which gives 4 cases. Each case has 10! / (2! 3! 2! 3!) = 25200
            // orders of the pieces, and in each pair the right leaf arrives last in 0.3 of them: 4 *
            // 25200 * 0.3^2 = 9072. (0.3: 3 of the 10 orders of aabbb.)
            EXPECT_EQ(rounds, (std::array{0, 1, 6, 126, chain ? 5670 : 9072}[n]));
        }
}

TEST(RefitInEveryInterleaving, FindsATornCounter)
{
    Unfitted unfitted(in_a_row(2, false));
    EveryChoice choices;
    InterleavedExecutor executor(2, std::ref(choices));
    int rounds = 0;
    int found = 0;
    do {
        // Two leaves under one node: both may count as the first, and then no thread resets the count.
        found += unfitted.refits<fast_trees_test::arrive_torn>(executor) ? 0 : 1;
        ++rounds;
    } while (choices.next_round());
    EXPECT_GT(found, 0);
    EXPECT_LT(found, rounds);
}

/// An executor of up to 32 threads with a schedule drawn from `seed`.
template <std::uint32_t (*arrive_at)(std::uint32_t&)>
bool refits_by_chance(std::size_t n, std::uint64_t seed)
{
    Random random(seed);
    Unfitted unfitted(fast_trees_test::rounded(trees_test::boxes(trees_test::Kind::uniform, n, random)));
    std::mt19937_64 bits(seed);
    InterleavedExecutor executor(
        32, [&](std::uint32_t ready) { return static_cast<std::uint32_t>(bits() % ready); });
    return unfitted.refits<arrive_at>(executor);
}

RC_GTEST_PROP(RefitInRandomInterleavings, GivesTheSameBoxes, ())
{
    const std::size_t n = *rc::gen::inRange<std::size_t>(1, 200);
    const auto seed = *rc::gen::arbitrary<std::uint64_t>();
    RC_ASSERT(refits_by_chance<fast::arrive>(n, seed));
}

TEST(RefitInRandomInterleavings, FindsATornCounterEveryTime)
{
    for (std::uint64_t seed = 1; seed <= 20; ++seed)
        EXPECT_FALSE(refits_by_chance<fast_trees_test::arrive_torn>(32, seed)) << seed;
}

} // namespace
