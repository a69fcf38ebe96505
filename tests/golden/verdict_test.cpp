// The conditions under which one stage is enough for a verdict.

#include "golden/judge.h"
#include "golden/verdict.h"
#include "tests/golden/simulated_golden.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using golden::Comparison;
using golden::Finding;
using golden::Method;
using golden::Verdict;

class VerdictAtOnce : public golden_test::SimulatedGolden {
protected:
    /// The finding of one functional. All 32 batches are the golden's mean times `factor`.
    static Finding judged(double factor)
    {
        const golden::CompareOptions options;
        const golden::Judge judge(reference(), Method::welch, options);
        golden::Candidate candidate(reference().functionals);
        images::Image image = reference().mean;
        for (images::Rgb& pixel : image.pixels) pixel *= factor;
        for (int batch = 0; batch < 32; ++batch) candidate.add_batch(image);
        return judge.judge(candidate, 0, 0);
    }

    /// The finding of the whole picture for 32 batches with noise, whose mean is half of the golden's.
    static Finding noisy_and_dark(Method method)
    {
        golden::Candidate noisy = candidate({.everywhere = 0.5}, 32);
        const golden::CompareOptions options;
        return golden::Judge(reference(), method, options).judge(noisy, 0, 0);
    }

    /// Whether these findings alone are enough for a verdict. If they are, the verdict must be FAIL.
    static bool is_decided(const std::vector<Finding>& findings, bool can_render_again)
    {
        Comparison comparison;
        comparison.findings = findings;
        golden::summarise(comparison);
        const bool decided = golden::decide_at_once(comparison, {}, can_render_again);
        if (decided) {
            EXPECT_EQ(comparison.verdict, Verdict::fail) << comparison.reason;
        }
        return decided;
    }
};

TEST_F(VerdictAtOnce, TooDarkByMeansIsMarked)
{
    for (const double factor : {0.0, 0.5, 0.9}) EXPECT_TRUE(judged(factor).darker_by_means) << factor;
    EXPECT_LT(judged(0.0).adjusted_p, 1e-8);
    EXPECT_FALSE(judged(1.1).darker_by_means);
    EXPECT_TRUE(noisy_and_dark(Method::welch).darker_by_means);
    EXPECT_FALSE(noisy_and_dark(Method::ranks).darker_by_means); // the same estimator: as rare in both
}

// In one of 40 right pictures, 32 batches of light tracing contain no light in a tile; and the batches
// of a path tracer may have few of the events that make a caustic.
TEST_F(VerdictAtOnce, LightThatTheBatchesLackIsLookedForInAFreshRender)
{
    EXPECT_FALSE(is_decided({judged(0.0)}, true));
    EXPECT_LT(noisy_and_dark(Method::welch).adjusted_p, 1e-8);
    EXPECT_FALSE(is_decided({noisy_and_dark(Method::welch)}, true));
    EXPECT_TRUE(is_decided({noisy_and_dark(Method::ranks)}, true));
}

// A given picture cannot be rendered again, so light that it lacks is an error.
TEST_F(VerdictAtOnce, LightThatNoPictureHasIsMissing)
{
    EXPECT_TRUE(is_decided({judged(0.0)}, false));
}

TEST_F(VerdictAtOnce, TooBrightIsCertainEitherWay)
{
    for (const bool can_render_again : {false, true}) {
        EXPECT_TRUE(is_decided({judged(1.1)}, can_render_again));
        EXPECT_TRUE(is_decided({judged(0.0), judged(1.1)}, can_render_again));
    }
}

} // namespace
