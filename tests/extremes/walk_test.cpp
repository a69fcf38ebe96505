#include "extremes/point.h"
#include "extremes/walk.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace extremes {

namespace {

/// An axis from 1e-3 to 1e3 whose cases have the error 1e-9 times a random number, and leak from 100 on.
Axis simple_axis()
{
    Axis axis;
    axis.number = 1;
    axis.name = "simple";
    axis.ordinary = 1.0;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-3, 3, 1);
    axis.methods = {
        {"ref", Format::binary64, [](double parameter, Random& random, int cases, Tally& tally) {
             for (int i = 0; i < cases; ++i)
                 if (parameter >= 99)
                     tally.add(Failure::leaked);
                 else
                     tally.add(1e-9 * random.uniform());
         }}};
    return axis;
}

} // namespace

TEST(Walk, TheSameCasesForAnyNumberOfThreads)
{
    const Axis axis = simple_axis();
    WalkOptions options;
    options.cases = 1234;
    const auto one = visit(axis, axis.methods[0], 1.0, options);
    options.threads = 4;
    const auto four = visit(axis, axis.methods[0], 1.0, options);
    ASSERT_TRUE(one && four);
    EXPECT_EQ(one->cases(), 1234u);
    EXPECT_EQ(one->largest(), four->largest());
    EXPECT_EQ(one->quantile(0.5), four->quantile(0.5));
    options.seed = 2;
    EXPECT_NE(visit(axis, axis.methods[0], 1.0, options)->largest(), one->largest());
    EXPECT_NE(visit(axis, axis.methods[0], 0.1, options)->largest(),
              visit(axis, axis.methods[0], 1.0, options)->largest());
}

TEST(Walk, MethodsTogetherGetTheCasesOfEachAlone)
{
    Axis axis = simple_axis();
    axis.methods.push_back(
        {"twice", Format::binary64, [](double, Random& random, int cases, Tally& tally) {
             for (int i = 0; i < cases; ++i) tally.add(2e-9 * random.uniform());
         }});
    WalkOptions options;
    options.cases = 1234;
    options.threads = 2;
    const std::vector<const Method*> both = {&axis.methods[0], &axis.methods[1]};
    const auto together = visit(axis, both, 1.0, options);
    ASSERT_TRUE(together);
    ASSERT_EQ(together->size(), 2u);
    EXPECT_EQ((*together)[0].largest(), visit(axis, axis.methods[0], 1.0, options)->largest());
    EXPECT_EQ((*together)[1].largest(), 2 * (*together)[0].largest());
    EXPECT_EQ((*together)[1].cases(), 1234u);
}

TEST(Walk, NoMoreCasesThanTheAxisAllows)
{
    Axis axis = simple_axis();
    axis.most_cases = 10;
    EXPECT_EQ(visit(axis, axis.methods[0], 1.0, {})->cases(), 10u);
}

TEST(Walk, StopsAndPassesExceptionsOn)
{
    Axis axis = simple_axis();
    WalkOptions options;
    options.stop = [] { return true; };
    EXPECT_FALSE(visit(axis, axis.methods[0], 1.0, options));
    axis.methods[0].run = [](double, Random&, int, Tally&) { throw std::runtime_error("defect"); };
    options.stop = [] { return false; };
    options.threads = 2;
    EXPECT_THROW(visit(axis, axis.methods[0], 1.0, options), std::runtime_error);
}

TEST(Walk, FindsTheFirstFailureOnEachSide)
{
    const Axis axis = simple_axis();
    std::vector<Point> points;
    for (const double parameter : axis.values)
        points.push_back(point_of(parameter, *visit(axis, axis.methods[0], parameter, {})));
    EXPECT_EQ(first_failure(axis, points, Failure::leaked, true), 100.0);
    EXPECT_FALSE(first_failure(axis, points, Failure::leaked, false));
    EXPECT_FALSE(first_failure(axis, points, Failure::missed, true));
    points[0].failures[static_cast<std::size_t>(Failure::missed)] = 1;
    points[1].failures[static_cast<std::size_t>(Failure::missed)] = 1;
    EXPECT_EQ(first_failure(axis, points, Failure::missed, false), points[1].parameter);
    const auto safe = safe_range(axis, points);
    ASSERT_TRUE(safe);
    EXPECT_EQ(safe->from, points[2].parameter);
    EXPECT_EQ(safe->to, 10.0);
}

TEST(Walk, PointsContradictALimit)
{
    const Axis axis = simple_axis();
    std::vector<Point> points;
    for (const double parameter : axis.values)
        points.push_back(point_of(parameter, *visit(axis, axis.methods[0], parameter, {})));
    Limit limit{"ref", 10.0, [](double) { return 1e-9; }, 100.0, Failure::leaked, ""};
    EXPECT_EQ(contradiction(axis, limit, points), "");
    limit.bound = [](double parameter) { return parameter > 5 ? 1e-12 : 1e-9; };
    EXPECT_NE(contradiction(axis, limit, points).find("above the bound of 1e-12 at 10"),
              std::string::npos);
    limit.safe = 100.0;
    limit.bound = [](double) { return 1e-9; };
    EXPECT_EQ(contradiction(axis, limit, points), "1000 of 1000 cases fail at 100: leaked");
    limit.safe = 10.0;
    limit.failure = Failure::missed; // at 100 cases leak
    EXPECT_EQ(contradiction(axis, limit, points), "no case fails at 100, beyond the limit: missed");
}

TEST(Walk, WhatIsNotWalkedIsNeitherSafeNorAContradiction)
{
    const Axis axis = simple_axis();
    std::vector<Point> points;
    for (const double parameter : axis.values) {
        Tally tally;
        if (parameter == 10.0 || parameter == 100.0)
            tally.leave_out("needs 17 GiB");
        else
            tally.add(1e-12);
        points.push_back(point_of(parameter, tally));
    }
    EXPECT_EQ(points[4].not_walked, "needs 17 GiB");
    EXPECT_EQ(points[3].not_walked, "");
    EXPECT_FALSE(points[4].failed());
    EXPECT_EQ(safe_range(axis, points)->to, 1.0);
    const Limit limit{"ref", 10.0, [](double) { return 1e-9; }, 100.0, Failure::leaked, ""};
    EXPECT_EQ(contradiction(axis, limit, points), "");
}

} // namespace extremes
