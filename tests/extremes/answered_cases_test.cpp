// Exact answers that methods share.

#include "extremes/leave/tetrahedron.h"

#include <gtest/gtest.h>

namespace extremes {

namespace {

LeaveCase room(double parameter, Random& random, int rays)
{
    return tetrahedron_case(random, rays, parameter,
                            [&](const scenes::Vec3& corner) { return parameter * corner; });
}
LeaveCase moved_room(double parameter, Random& random, int rays)
{
    return tetrahedron_case(random, rays, parameter, [&](const scenes::Vec3& corner) {
        return parameter * corner + scenes::Vec3(8, 0, 0);
    });
}

/// A number that tells cases apart, and that they end with the same random numbers.
double asked(MakeLeaveCase make, double parameter, std::uint64_t seed, int cases)
{
    Random random(seed);
    double sum = 0;
    for (const AnsweredCase& answered : answered_cases(make, parameter, random, cases)) {
        EXPECT_EQ(answered.from.rays.size(), answered.truths.size());
        for (std::size_t i = 0; i < answered.truths.size(); ++i)
            sum += answered.from.rays[i].origin.x + answered.truths[i].value().distance.to_double();
    }
    return sum + random.uniform();
}

} // namespace

TEST(AnsweredCases, AreSharedOnlyByEqualQuestions)
{
    const double first = asked(room, 1, 1, 50);
    EXPECT_EQ(asked(room, 1, 1, 50), first);
    // Each after the first again, so that one thing differs.
    EXPECT_NE(asked(room, 2, 1, 50), first);
    EXPECT_EQ(asked(room, 1, 1, 50), first);
    EXPECT_NE(asked(room, 1, 2, 50), first);
    EXPECT_EQ(asked(room, 1, 1, 50), first);
    EXPECT_NE(asked(room, 1, 1, 30), first);
    EXPECT_EQ(asked(room, 1, 1, 50), first);
    EXPECT_NE(asked(moved_room, 1, 1, 50), first);
    EXPECT_EQ(asked(room, 1, 1, 50), first);
}

TEST(AnsweredCases, OfOneQuestionAreComputedOnce)
{
    Random once(1);
    Random again(1);
    const std::vector<AnsweredCase>& first = answered_cases(room, 1, once, 50);
    const AnsweredCase* const data = first.data();
    EXPECT_EQ(answered_cases(room, 1, again, 50).data(), data);
    EXPECT_TRUE(once == again);
}

} // namespace extremes
