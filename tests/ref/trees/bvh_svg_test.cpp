#include "cli/bvh_svg.h"

#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>

namespace {

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(RadixTreeFigure, HasAMarkForEveryNodeSplitBitAndPrimitive)
{
    const std::vector<std::uint64_t> codes = {0b00001, 0b00010, 0b00100, 0b00101,
                                              0b10011, 0b11000, 0b11001, 0b11110};
    const std::vector<std::uint32_t> primitives = {3, 5, 1, 7, 4, 0, 6, 2};
    const std::string svg = cli::radix_tree_figure(codes, primitives, 5);
    EXPECT_EQ(count(svg, "<circle"), 7u);
    EXPECT_EQ(count(svg, "stroke='#c2410c'"), 7u);      // splits
    EXPECT_EQ(count(svg, "stroke-width='4'"), 7u);      // ranges
    EXPECT_EQ(count(svg, "stroke='#8a8f98'"), 14u);     // links to children
    EXPECT_EQ(count(svg, "<text"), 7u + 8 + 8 * 5 + 8); // nodes, keys, bits, primitives
    for (const std::uint32_t primitive : primitives)
        EXPECT_EQ(count(svg, ">#" + std::to_string(primitive) + "<"), 1u);
    EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
}

TEST(RadixTreeFigure, ShowsNoMoreBitsThanTellKeysApart)
{
    const std::uint64_t top = std::uint64_t{1} << 29;
    const std::string svg = cli::radix_tree_figure(std::vector<std::uint64_t>{0, 0, top},
                                                   std::vector<std::uint32_t>{0, 1, 2}, 30);
    EXPECT_EQ(count(svg, "<text"), 2u + 3 + 3 * 1 + 3);
}

TEST(RadixTreeFigure, OfOneKeyHasNoInternalNode)
{
    const std::string svg =
        cli::radix_tree_figure(std::vector<std::uint64_t>{5}, std::vector<std::uint32_t>{0}, 30);
    EXPECT_EQ(count(svg, "<circle"), 0u);
    EXPECT_EQ(count(svg, ">#0<"), 1u);
}

} // namespace
