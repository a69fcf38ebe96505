// The whole build, by every executor, on all kinds of boxes: the properties of the trees of ref/ hold
// here too, and from the same codes the tree is the same, bit for bit.

#include "cuda/trees/lbvh.h"

#include "ref/trees/bvh.h"
#include "ref/trees/is_valid_tree.h"
#include "ref/trees/quality.h"
#include "ref/trees/refit.h"
#include "tests/cuda/parallel/on_device.h"
#include "tests/cuda/trees/build_on.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cstdlib>
#include <numeric>
#include <stdexcept>

namespace {

using fast_trees_test::build_on;
using fast_trees_test::Built;
using fast_trees_test::On;
using fast_trees_test::Setup;
using trees_test::Kind;
using trees_test::Random;

using Lines = std::vector<std::string>;

fast::Aabb first_or_empty(std::span<const fast::Aabb> boxes)
{
    return boxes.empty() ? fast::empty_aabb() : boxes[0];
}

/// The tree that the reference builds from these codes and boxes.
ref::Tree reference_tree(const Built& built, std::span<const fast::Aabb> boxes)
{
    ref::Tree tree;
    if (boxes.empty()) return tree;
    tree.nodes = ref::radix_tree(built.codes);
    tree.primitives = built.primitives;
    tree.leaf_begin.resize(boxes.size() + 1);
    std::iota(tree.leaf_begin.begin(), tree.leaf_begin.end(), 0);
    ref::refit(tree, fast_trees_test::exactly(boxes));
    return tree;
}

bool same_bits(const ref::Vec3& a, const ref::Vec3& b)
{
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

/// The list of everything that is wrong with a build over these boxes.
Lines violations(const Built& built, std::span<const fast::Aabb> boxes, int code_bits)
{
    const ref::Tree tree = neutral(built, first_or_empty(boxes));
    Lines found = is_valid_tree(tree, fast_trees_test::exactly(boxes));
    if (found.empty()) found = is_valid_radix_tree(tree, built.codes);
    for (std::size_t i = 1; i < built.codes.size(); ++i) {
        if (std::pair(built.codes[i - 1], built.primitives[i - 1]) >=
            std::pair(built.codes[i], built.primitives[i]))
            found.push_back("leaf " + std::to_string(i) + " is not in order of code, then primitive");
    }
    if (!built.codes.empty() && built.codes.back() >> code_bits != 0)
        found.emplace_back("codes too long");
    for (const fast::Node& node : built.nodes)
        if (node.arrivals != 0) found.emplace_back("a node is not ready for the next refit");
    const ref::Tree expected = reference_tree(built, boxes);
    if (expected.nodes != tree.nodes) found.emplace_back("not the reference's nodes");
    for (std::size_t i = 0; i < tree.bounds.size() && i < expected.bounds.size(); ++i)
        if (!same_bits(tree.bounds[i].lower, expected.bounds[i].lower) ||
            !same_bits(tree.bounds[i].upper, expected.bounds[i].upper))
            found.push_back("box " + std::to_string(i) + " is not the reference's");
    if (found.size() > 5) found.resize(5);
    return found;
}

bool operator==(const fast::Node& a, const fast::Node& b)
{
    static_assert(std::has_unique_object_representations_v<std::array<std::uint32_t, 16>>);
    using Words = std::array<std::uint32_t, 16>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

void expect_same_bits(const Built& a, const Built& b)
{
    EXPECT_EQ(a.codes, b.codes);
    EXPECT_EQ(a.primitives, b.primitives);
    EXPECT_EQ(a.leaf_links, b.leaf_links);
    ASSERT_EQ(a.nodes.size(), b.nodes.size());
    for (std::size_t i = 0; i < a.nodes.size(); ++i) ASSERT_TRUE(a.nodes[i] == b.nodes[i]) << i;
}

class LbvhOn : public testing::TestWithParam<Setup> {
protected:
    void SetUp() override
    {
        if (GetParam().on == On::device) parallel_test::skip_without_device();
    }
    /// Whether this executor can build `n` primitives in acceptable time.
    [[nodiscard]] static bool takes(std::size_t n)
    {
        return GetParam().on != On::interleaved || n < 1000;
    }
};

INSTANTIATE_TEST_SUITE_P(Every, LbvhOn,
                         testing::Values(Setup{On::serial, 30}, Setup{On::serial, 63},
                                         Setup{On::threads, 30}, Setup{On::threads, 63},
                                         Setup{On::interleaved, 30}, Setup{On::interleaved, 63},
                                         Setup{On::device, 30}, Setup{On::device, 63}),
                         [](const auto& test) { return name(test.param); });

TEST_P(LbvhOn, IsTheReferenceTreeOfItsCodesAtEverySmallSizeAndAroundBlocks)
{
    Random random(1);
    std::vector<std::size_t> sizes = {255, 256, 257, 258, 511, 512, 513, 514};
    for (std::size_t n = 0; n <= 70; ++n) sizes.push_back(n);
    for (const std::size_t n : sizes) {
        const auto boxes = fast_trees_test::rounded(
            trees_test::boxes(n % 2 == 0 ? Kind::uniform : Kind::duplicated, n, random));
        ASSERT_EQ(violations(build_on(GetParam(), boxes, n), boxes, GetParam().code_bits), Lines()) << n;
    }
}

// map: delta, range-direction, range-length, split, children
TEST_P(LbvhOn, IsTheReferenceTreeOfItsCodesForEveryKindOfInput)
{
    Random random(2);
    for (int kind = 0; kind < trees_test::kinds; ++kind)
        for (const std::size_t n : {2u, 3u, 17u, 300u}) {
            const auto boxes =
                fast_trees_test::rounded(trees_test::boxes(static_cast<Kind>(kind), n, random));
            const Built built = build_on(GetParam(), boxes, n);
            ASSERT_EQ(violations(built, boxes, GetParam().code_bits), Lines())
                << trees_test::name(static_cast<Kind>(kind)) << " n " << n;
            ASSERT_LE(ref::quality(neutral(built, boxes[0])).depth,
                      GetParam().code_bits + static_cast<int>(std::bit_width(n - 1)));
        }
}

TEST_P(LbvhOn, IsTheReferenceTreeOfItsCodesAtSizesAroundPowersOfTwo)
{
    Random random(3);
    for (const std::size_t n : {65535u, 65536u, 65537u, (1u << 20) + 1}) {
        if (!takes(n)) GTEST_SKIP() << "a million changes of threads take too long";
        const auto boxes = fast_trees_test::rounded(trees_test::boxes(Kind::uniform, n, random));
        ASSERT_EQ(violations(build_on(GetParam(), boxes), boxes, GetParam().code_bits), Lines()) << n;
    }
}

TEST_P(LbvhOn, IsTheReferenceTreeOfItsCodesBeyondWhatAFloatCanCount)
{
    const char* const wanted = std::getenv("PLUMBLINE_LONG");
    if (wanted == nullptr) GTEST_SKIP() << "takes minutes and 16 GiB: set PLUMBLINE_LONG=1 to run it";
    if (!takes(1u << 24)) GTEST_SKIP() << "a million changes of threads take too long";
    Random random(4);
    const auto boxes =
        fast_trees_test::rounded(trees_test::boxes(Kind::uniform, (1u << 24) + 3, random));
    ASSERT_EQ(violations(build_on(GetParam(), boxes), boxes, GetParam().code_bits), Lines());
}

TEST_P(LbvhOn, TakesManyCoincidentPrimitives) // map: delta-ties
{
    for (const std::size_t n : {3u, 512u, 65537u}) {
        if (!takes(n)) continue;
        const std::vector<fast::Aabb> boxes(n, fast::Aabb{fast::Vec3(1), fast::Vec3(2)});
        const Built built = build_on(GetParam(), boxes);
        ASSERT_EQ(violations(built, boxes, GetParam().code_bits), Lines()) << n;
        EXPECT_EQ(ref::quality(neutral(built, boxes[0])).depth, static_cast<int>(std::bit_width(n - 1)));
    }
}

TEST_P(LbvhOn, BuiltTwiceIsEqualAndEqualToTheSerialOne)
{
    Random random(5);
    for (const std::size_t n : {1u, 2u, 100u, 999u, 20000u}) {
        if (!takes(n)) continue;
        const auto boxes = fast_trees_test::rounded(trees_test::boxes(Kind::clustered, n, random));
        const Built built = build_on(GetParam(), boxes, 1);
        expect_same_bits(built, build_on(GetParam(), boxes, 2));
        expect_same_bits(built, build_on({On::serial, GetParam().code_bits}, boxes));
    }
}

std::string message(const Setup& setup, const std::vector<fast::Aabb>& boxes)
{
    try {
        build_on(setup, boxes);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

/// The message of the reference for the same boxes.
std::string reference_message(const std::vector<fast::Aabb>& boxes)
{
    try {
        ref::build(fast_trees_test::exactly(boxes), ref::Builder::morton30);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

TEST_P(LbvhOn, RejectsInvalidBoxesWithTheReferencesMessage)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    const std::vector<fast::Aabb> good(300, fast::Aabb{fast::Vec3(0), fast::Vec3(1)});
    EXPECT_EQ(message(GetParam(), good), "");
    for (int axis = 0; axis < 3; ++axis)
        for (const float bad : {nan, infinity, -infinity, 1.5f}) {
            auto boxes = good;
            boxes[299].lower[axis] = nan; // the first one is reported
            boxes[257].lower[axis] = bad;
            EXPECT_EQ(message(GetParam(), boxes).substr(0, 15), "primitive 257: ") << bad;
            EXPECT_EQ(message(GetParam(), boxes), reference_message(boxes)) << bad;
        }
    EXPECT_EQ(message(GetParam(), {fast::empty_aabb()}), "primitive 0: its box is empty");
}

// ---- without ref/ ----------------------------------------------------------------------------------

RC_GTEST_PROP(LbvhRefit, AfterPrimitivesMoveGivesTheBoxesOfTheNewPlaces, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::size_t n = *rc::gen::inRange<std::size_t>(1, 300);
    const auto kind = static_cast<Kind>(*rc::gen::inRange(0, trees_test::kinds));
    const auto boxes = fast_trees_test::rounded(trees_test::boxes(Kind::uniform, n, random));
    const auto moved = fast_trees_test::rounded(trees_test::boxes(kind, n, random));
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    fast::Lbvh<std::uint32_t> tree(memory, executor, static_cast<std::uint32_t>(n));
    tree.build(executor, boxes);
    tree.refit(executor, moved);
    tree.refit(executor, moved); // leaves no state that would disturb a second refit
    const Built built = fast_trees_test::copy_of(tree);
    RC_ASSERT(is_valid_tree(neutral(built, moved[0]), fast_trees_test::exactly(moved)) == Lines());
}

TEST(LbvhMemory, IsReusedFromOneBuildToTheNextWithoutATrace)
{
    Random random(6);
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    fast::Lbvh<std::uint64_t> reused(memory, executor, 1000);
    for (const std::size_t n : {1000u, 3u, 500u, 1u, 0u, 2u, 999u}) {
        const auto boxes = fast_trees_test::rounded(trees_test::boxes(Kind::uniform, n, random));
        reused.build(executor, boxes);
        fast::Lbvh<std::uint64_t> fresh(memory, executor, static_cast<std::uint32_t>(n));
        fresh.build(executor, boxes);
        expect_same_bits(fast_trees_test::copy_of(reused), fast_trees_test::copy_of(fresh));
    }
}

TEST(LbvhStages, AreReportedInOrder)
{
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    fast::Lbvh<std::uint32_t> tree(memory, executor, 2);
    const std::vector<fast::Aabb> boxes(2, fast::Aabb{fast::Vec3(0), fast::Vec3(1)});
    std::vector<fast::Stage> stages;
    tree.build(executor, boxes, [&](fast::Stage stage) { stages.push_back(stage); });
    using fast::Stage;
    EXPECT_EQ(stages,
              (std::vector{Stage::bounds, Stage::codes, Stage::sort, Stage::tree, Stage::refit}));
}

} // namespace
