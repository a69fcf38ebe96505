// Builders in C++: right ones pass, each wrong one fails on a small input.

#include "check/trees/check_builder.h"

#include "check/trees/report.h"
#include "ref/trees/bvh.h"
#include "tests/check/wrong_builders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace {

using check::BuilderOptions;
using check::BuilderReport;
using check_test::Defect;

BuilderOptions quick()
{
    BuilderOptions options;
    options.cases = 20;
    options.largest = 300;
    return options;
}

TEST(CheckBuilder, PassesOurBuilders)
{
    for (const ref::Builder builder :
         {ref::Builder::morton30, ref::Builder::morton63, ref::Builder::sah, ref::Builder::sah_leaf})
        for (const bool single_precision : {true, false}) {
            BuilderOptions options = quick();
            options.single_precision = single_precision;
            options.checks.morton_bits = builder == ref::Builder::morton30   ? 30
                                         : builder == ref::Builder::morton63 ? 63
                                                                             : 0;
            const BuilderReport report = check::check_builder(
                [&](std::span<const ref::Aabb> boxes) {
                    return check::neutral(ref::build(boxes, builder));
                },
                options);
            EXPECT_TRUE(report.passes()) << describe(report);
            EXPECT_FALSE(report.budget_spent);
        }
}

struct Wrong {
    Defect defect;
    const char* problem;
    std::size_t most; // primitives of the input that is left
};

TEST(CheckBuilder, FindsEveryDefectOnASmallInput)
{
    // Blocks have 64 threads: the smallest input with a partial block after a whole one has 65.
    const std::vector<Wrong> wrong = {
        {Defect::shared_child, "one-parent", 3}, {Defect::offset_twice, "indices", 4},
        {Defect::tiny_input, "rejected", 2},     {Defect::one_primitive, "rejected", 1},
        {Defect::flat_axis, "nodes", 2},         {Defect::accepts_nan, "accepted-nan", 1},
        {Defect::short_count, "nodes", 256},     {Defect::leaf_goes_on, "nodes", 2},
        {Defect::lost_key, "primitives", 65},    {Defect::partial_block, "contain", 65},
        {Defect::last_leaf, "contain", 1},       {Defect::chain, "depth", 12},
        {Defect::stale_box, "contain", 2},       {Defect::scene_box, "tight", 2},
    };
    for (const auto& [defect, problem, most] : wrong) {
        BuilderOptions options = quick();
        if (defect == Defect::chain) options.checks.max_depth = 10;
        const BuilderReport report = check::check_builder(
            [&](std::span<const ref::Aabb> boxes) { return build(defect, boxes); }, options);
        const char* name = check_test::defect_names[static_cast<std::size_t>(defect)];
        ASSERT_TRUE(report.smallest) << name;
        EXPECT_EQ(report.smallest->problem.name, problem) << name;
        EXPECT_LE(report.smallest->boxes.size(), most) << name;
        EXPECT_EQ(report.smallest->failed_again, 5U) << name;
        EXPECT_FALSE(report.passes());
    }
}

TEST(CheckBuilder, PassesTheSameBuilderWithoutADefect)
{
    const BuilderReport report = check::check_builder(
        [](std::span<const ref::Aabb> boxes) { return build(Defect::none, boxes); }, quick());
    EXPECT_TRUE(report.passes()) << describe(report);
}

TEST(CheckBuilder, SimplifiesTheCoordinatesOfAFailure)
{
    // Fails only where a box has an extent along z.
    const auto builder = [](std::span<const ref::Aabb> boxes) {
        for (const ref::Aabb& box : boxes)
            if (std::isfinite(box.lower.z) && box.upper.z > box.lower.z) throw std::logic_error("z");
        return build(Defect::none, boxes);
    };
    const BuilderReport report = check::check_builder(builder, quick());
    ASSERT_TRUE(report.smallest);
    const std::vector<ref::Aabb> expected = {{{0, 0, 0}, {0, 0, 1}}};
    EXPECT_EQ(report.smallest->boxes, expected) << describe(report);
    EXPECT_EQ(report.smallest->problem.text, "legal primitives were rejected: z");
}

TEST(CheckBuilder, KeepsTheFirstInputOfAFailureThatDoesNotComeAgain)
{
    int failures = 0; // the second one is on a simpler input
    const auto builder = [&](std::span<const ref::Aabb> boxes) {
        if (boxes.size() == 9 && ++failures <= 2) throw std::logic_error("a race");
        return build(Defect::none, boxes);
    };
    const BuilderReport report = check::check_builder(builder, quick());
    ASSERT_TRUE(report.smallest);
    EXPECT_EQ(report.smallest->boxes, report.first->boxes);
    EXPECT_EQ(report.smallest->problem.name, "rejected");
    EXPECT_EQ(report.smallest->failed_again, 0U);
    EXPECT_NE(describe(report).find("in 0 of 5 further runs"), std::string::npos) << describe(report);
}

TEST(CheckBuilder, StopsShrinkingAtOnceWhenItsBudgetIsSpent)
{
    // 2^17 smaller inputs would be made if shrinking went on without trying them.
    BuilderOptions options;
    options.kinds = {check::InputKind::coincident};
    options.cases = 0;
    options.budget = 1e-6;
    const std::vector<ref::Aabb> boxes = check::input_boxes(check::InputKind::coincident, 65537, 1);
    const check::BuildAttempts attempts = [](std::span<const ref::Aabb>, double) {
        return check::BuildAttempt{check::BuildAttempt::End::crashed, {}, "a crash"};
    };
    const BuilderReport report = check::check_on_input(attempts, boxes, options);
    ASSERT_TRUE(report.smallest);
    EXPECT_EQ(report.smallest->tries, 0U);
    EXPECT_EQ(report.smallest->boxes, boxes);
}

TEST(CheckBuilder, EndsWithItsBudgetAndWhenItIsStopped)
{
    const auto builder = [](std::span<const ref::Aabb> boxes) { return build(Defect::none, boxes); };
    BuilderOptions options = quick();
    options.budget = 0.0;
    const BuilderReport spent = check::check_builder(builder, options);
    EXPECT_TRUE(spent.budget_spent);
    EXPECT_TRUE(spent.passes());

    options = quick();
    int asked = 0;
    options.stop = [&] { return ++asked > 10; };
    const BuilderReport stopped = check::check_builder(builder, options);
    EXPECT_TRUE(stopped.stopped);
    EXPECT_FALSE(stopped.passes());
    EXPECT_FALSE(stopped.smallest);

    // A failure before that is kept as it is.
    bool failed = false;
    options.stop = [&] { return failed; };
    const BuilderReport kept = check::check_builder(
        [&](std::span<const ref::Aabb> boxes) {
            failed = boxes.size() == 7;
            if (failed) throw std::logic_error("not 7");
            return build(Defect::none, boxes);
        },
        options);
    EXPECT_TRUE(kept.stopped);
}

TEST(Inputs, AreLegalAndFloatsAsPromised)
{
    for (const check::InputKind kind : check::input_kinds)
        for (const std::size_t n : {0, 1, 2, 300}) {
            const std::vector<ref::Aabb> boxes = check::input_boxes(kind, n, 7);
            ASSERT_EQ(boxes.size(), kind == check::InputKind::empty ? 0 : n);
            std::size_t spoiled = 0;
            for (const auto& [lower, upper] : boxes) {
                const bool finite = ref::is_finite(lower) && ref::is_finite(upper);
                spoiled += finite ? 0 : 1;
                for (int axis = 0; axis < 3 && finite; ++axis) {
                    EXPECT_LE(lower[axis], upper[axis]) << name(kind);
                    EXPECT_EQ(lower[axis], static_cast<double>(static_cast<float>(lower[axis])));
                }
            }
            const bool spoils = kind == check::InputKind::nan || kind == check::InputKind::infinite;
            EXPECT_EQ(spoiled, spoils && n > 0 ? 1U : 0U) << name(kind);
        }
}

} // namespace
