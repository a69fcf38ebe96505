// Compares Karras' construction with the recursive one, and checks the definition of a radix tree.

#include "ref/trees/radix_tree.h"

#include "ref/trees/is_valid_tree.h"
#include "ref/trees/lauterbach.h"
#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <numeric>

namespace {

using ref::Node;
using ref::Tree;
using trees_test::Random;
using Codes = std::vector<std::uint64_t>;

/// The tree over `codes` with one primitive per leaf and empty boxes.
Tree tree_over(const Codes& codes)
{
    Tree tree;
    tree.nodes = ref::radix_tree(codes);
    tree.bounds.resize(tree.nodes.size());
    tree.primitives.resize(codes.size());
    std::iota(tree.primitives.begin(), tree.primitives.end(), 0);
    tree.leaf_begin.resize(codes.size() + 1);
    std::iota(tree.leaf_begin.begin(), tree.leaf_begin.end(), 0);
    return tree;
}

std::vector<std::string> violations(const Codes& codes)
{
    const Tree tree = tree_over(codes);
    std::vector<std::string> found = is_valid_tree(tree, std::vector<ref::Aabb>(codes.size()));
    if (found.empty()) found = is_valid_radix_tree(tree, codes);
    return found;
}

/// Edges from the root to the deepest leaf, given that the tree is valid.
int depth(const std::vector<Node>& nodes)
{
    int deepest = 0;
    for (std::uint32_t node = 0; node < nodes.size(); ++node) {
        int edges = 0;
        for (std::uint32_t at = node; nodes[at].parent != ref::no_node; at = nodes[at].parent) ++edges;
        deepest = std::max(deepest, edges);
    }
    return deepest;
}

/// ceil(log2 n) for n >= 1.
int log2_up(std::size_t n)
{
    return static_cast<int>(std::bit_width(n - 1));
}

// [Karras 2012, fig. 3]
const Codes karras_example = {0b00001, 0b00010, 0b00100, 0b00101, 0b10011, 0b11000, 0b11001, 0b11110};

TEST(RadixTree, IsTheOneInKarrasFigure) // map: delta, children
{
    const std::vector<Node> nodes = ref::radix_tree(karras_example);
    ASSERT_EQ(nodes.size(), 15u);
    const auto leaf = [](std::uint32_t key) { return 7 + key; };
    using Children = std::array<std::uint32_t, 2>;
    EXPECT_EQ(nodes[0].children, (Children{3, 4}));             // 0 | 1
    EXPECT_EQ(nodes[1].children, (Children{leaf(0), leaf(1)})); // 0000 | 0001
    EXPECT_EQ(nodes[2].children, (Children{leaf(2), leaf(3)})); // 00100 | 00101
    EXPECT_EQ(nodes[3].children, (Children{1, 2}));             // 000 | 001
    EXPECT_EQ(nodes[4].children, (Children{leaf(4), 5}));       // 10 | 11
    EXPECT_EQ(nodes[5].children, (Children{6, leaf(7)}));       // 110 | 111
    EXPECT_EQ(nodes[6].children, (Children{leaf(5), leaf(6)})); // 11000 | 11001
}

TEST(RadixTree, NodesOfTheFigureCoverTheirRanges) // map: range-direction, range-length, split
{
    const auto expect = [](std::int64_t node, std::int64_t first, std::int64_t last,
                           std::int64_t gamma) {
        const ref::RadixNode found = ref::radix_node(karras_example, node);
        EXPECT_EQ(found.first, first) << node;
        EXPECT_EQ(found.last, last) << node;
        EXPECT_EQ(found.gamma, gamma) << node;
    };
    expect(0, 0, 7, 3);
    expect(1, 0, 1, 0);
    expect(2, 2, 3, 2);
    expect(3, 0, 3, 1);
    expect(4, 4, 7, 4);
    expect(5, 5, 7, 6);
    expect(6, 5, 6, 5);
}

TEST(RadixTree,
     ForFewKeysOfFewBitsIsAlwaysTheRecursiveOne) // every sorted list of up to 7 keys of 3 bits
{
    int lists = 0;
    Codes codes;
    const auto extend = [&](const auto& self) -> void {
        ASSERT_EQ(ref::radix_tree(codes), ref::lauterbach_tree(codes));
        ASSERT_EQ(violations(codes), std::vector<std::string>());
        if (!codes.empty()) {
            ASSERT_LE(depth(ref::radix_tree(codes)), 3 + log2_up(codes.size()));
        }
        ++lists;
        if (codes.size() == 7) return;
        for (std::uint64_t next = codes.empty() ? 0 : codes.back(); next < 8; ++next) {
            codes.push_back(next);
            self(self);
            codes.pop_back();
        }
    };
    extend(extend);
    EXPECT_EQ(lists, 6435); // C(15, 7)
}

/// Sorted codes of up to `bits` bits: spread out, in clusters, or with many equal ones.
Codes any_codes(std::size_t n, int bits, Random& random)
{
    const std::uint64_t mask = (std::uint64_t{1} << bits) - 1;
    const auto style = random.below(4);
    Codes codes;
    for (std::size_t i = 0; i < n; ++i) {
        std::uint64_t code = random.bits() & mask;
        if (style == 1) code = (code & 3) << (bits - 2) | (random.bits() & 15);
        if (style == 2 && i > 0) code = random.below(10) == 0 ? code : codes[random.below(i)];
        if (style == 3) code = std::uint64_t{1} << random.below(static_cast<std::size_t>(bits));
        codes.push_back(code);
    }
    std::sort(codes.begin(), codes.end());
    return codes;
}

// map: delta, range-direction, range-length, split, children
RC_GTEST_PROP(RadixTree, IsTheRecursiveOneAndValidAndShallow, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const int bits = *rc::gen::element(30, 63);
    const Codes codes = any_codes(*rc::gen::inRange<std::size_t>(1, 2000), bits, random);
    const std::vector<Node> nodes = ref::radix_tree(codes);
    RC_ASSERT(nodes == ref::lauterbach_tree(codes));
    RC_ASSERT(violations(codes) == std::vector<std::string>());
    RC_ASSERT(depth(nodes) <= bits + log2_up(codes.size()));
}

TEST(RadixTree, EveryKeyIsCoveredByExactlyOneLeafAtSizesAroundPowersOfTwo)
{
    Random random(1);
    for (const std::size_t n :
         {0u, 1u, 2u, 3u, 4u, 7u, 8u, 9u, 255u, 256u, 257u, 300u, 1023u, 1024u, 1025u, 4097u})
        for (const int bits : {30, 63}) {
            const Codes codes = any_codes(n, bits, random);
            EXPECT_EQ(violations(codes), std::vector<std::string>()) << n;
        }
}

// map: delta-ties
TEST(RadixTree, OfEqualKeysIsBalanced) // without the tie-break: a chain, or nodes without parents
{
    for (const std::size_t n : {2u, 3u, 5u, 100u, 65536u, 100000u}) {
        const Codes codes(n, 0x1234);
        EXPECT_EQ(violations(codes), std::vector<std::string>()) << n;
        EXPECT_EQ(depth(ref::radix_tree(codes)), log2_up(n)) << n;
    }
}

TEST(RadixTree, DoesNotReadBehindItsKeys)
{
    Codes more = karras_example;
    more.push_back(more.back()); // would share the longest prefix with the last key
    EXPECT_EQ(ref::radix_tree(std::span(more).first(karras_example.size())),
              ref::lauterbach_tree(karras_example));
}

TEST(RadixTree, TheDeepestTreeKeepsTheBound)
{
    // Keys 0, 1, 2, 4, ..., 2^62, the first repeated many times: every bit of the code adds a level.
    Codes codes(1024, 0);
    for (int bit = 0; bit < 63; ++bit) codes.push_back(std::uint64_t{1} << bit);
    EXPECT_EQ(violations(codes), std::vector<std::string>());
    EXPECT_EQ(depth(ref::radix_tree(codes)), 63 + 10);
}

} // namespace
