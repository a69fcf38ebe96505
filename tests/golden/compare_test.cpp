#include "golden/compare.h"
#include "golden/reason.h"
#include "tests/golden/simulated_golden.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <string>

namespace {

using calibration::Bias;
using calibration::Noise;
using calibration::SimulatedRenderer;
using golden::Candidate;
using golden::CompareOptions;
using golden::Comparison;
using golden::Golden;
using golden::GoldenMaker;
using golden::Method;
using golden::Verdict;
using images::Image;
using images::Rgb;
using images_test::error_of;

using golden_test::for_small_pictures;
using golden_test::metadata;
using golden_test::size;

class Compare : public golden_test::SimulatedGolden {};

TEST_F(Compare, ARightPicturePassesAndSaysWhatItCouldHaveSeen)
{
    const Comparison result =
        golden::compare(reference(), candidate(), Method::ranks, for_small_pictures());
    EXPECT_EQ(result.verdict, Verdict::pass) << result.reason;
    for (const double detectable : result.detectable) {
        EXPECT_GT(detectable, 0.001);
        EXPECT_LT(detectable, 0.02);
    }
    ASSERT_TRUE(result.least_sensitive_stratum);
    const golden::Finding& least = result.findings[*result.least_sensitive_stratum];
    EXPECT_GT(least.detectable, result.detectable[0]);
    EXPECT_NE(result.reason.find("; of " + describe_place(least) + " alone, one of " +
                                 golden::say_percent(least.detectable) + "."),
              std::string::npos)
        << result.reason;
    EXPECT_EQ(result.findings.size(), 3 * reference().functionals.size());
    EXPECT_EQ(result.golden_batches, 512u);
    EXPECT_EQ(result.coverage, 1.0);
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const golden::Finding& whole = golden::whole_picture(result, channel);
        EXPECT_LE(whole.interval.low, 1.0); // 99% intervals
        EXPECT_GE(whole.interval.high, 1.0);
        EXPECT_LT(whole.interval.high - whole.interval.low, 0.05);
    }
}

TEST_F(Compare, APictureThatIsTooDarkFailsAndTheRatioSaysByHowMuch)
{
    const Comparison result =
        golden::compare(reference(), candidate({.everywhere = 0.95}), Method::ranks);
    EXPECT_EQ(result.verdict, Verdict::fail) << result.reason;
    const golden::Finding& whole = golden::whole_picture(result, 1);
    EXPECT_LT(whole.interval.low, 0.95);
    EXPECT_GT(whole.interval.high, 0.95);
    EXPECT_LT(whole.interval.high, 1.0);
    EXPECT_LT(whole.test.z, 0.0);
    EXPECT_LT(result.p, 1e-8);
}

TEST_F(Compare, AFewBatchesPassNothing)
{
    for (const std::uint64_t batches : {1u, 2u, 4u}) {
        const Comparison result = golden::compare(reference(), candidate({}, batches), Method::ranks);
        EXPECT_EQ(result.verdict, Verdict::inconclusive) << result.reason;
    }
    EXPECT_THROW(golden::compare(reference(), candidate({}, 0), Method::ranks), std::invalid_argument);
    EXPECT_THROW(golden::compare(reference(), candidate({}, 1), Method::welch), std::invalid_argument);
}

TEST_F(Compare, WhatCannotMeetTheSpecificationIsInconclusiveAndNamesIt)
{
    CompareOptions strict;
    strict.specification = 1e-4;
    const Comparison result = golden::compare(reference(), candidate(), Method::ranks, strict);
    EXPECT_EQ(result.verdict, Verdict::inconclusive);
    EXPECT_NE(result.reason.find("(required: 0.01%)"), std::string::npos) << result.reason;
}

// The first stage finds this error at the suspicion level, but not at the certainty level.
constexpr Bias suspicious{.everywhere = 0.987};

TEST_F(Compare, ASuspicionThatNoStageCanConfirmIsInconclusive)
{
    const Comparison result = golden::compare(reference(), candidate(suspicious), Method::ranks);
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << result.reason;
    EXPECT_LT(result.p, 0.05);
    EXPECT_GT(result.p, 1e-8);
    EXPECT_NE(result.reason.find("Suspicious"), std::string::npos);
}

TEST_F(Compare, TheLevelOfSuspicionIsAProbability)
{
    CompareOptions options = for_small_pictures();
    const Candidate picture = candidate(suspicious);
    const double p = golden::compare(reference(), picture, Method::ranks, options).p;
    const auto begins = [&](const std::string& words) {
        const Comparison result = golden::compare(reference(), picture, Method::ranks, options);
        return result.reason.starts_with(words) ? "as it should" : result.reason;
    };
    options.suspicion_level = 1.1 * p;
    EXPECT_EQ(begins("Suspicious"), "as it should");
    options.suspicion_level = 0.9 * p;
    EXPECT_EQ(begins("No difference found"), "as it should");
}

TEST_F(Compare, ASuspicionThatAFreshRenderConfirmsFails)
{
    const Comparison result = golden::compare(reference(), stages({suspicious}), Method::ranks);
    EXPECT_EQ(result.verdict, Verdict::fail) << result.reason;
    ASSERT_EQ(result.stages.size(), 2u);
    EXPECT_EQ(result.stages[1].batches, 256u);
    EXPECT_LT(result.stages[1].p, result.stages[1].level);
}

TEST_F(Compare, EverySuspicionIsTestedOnTheFreshRenderNotTheStrongestAlone)
{
    // The first stage is too dark, most of all the whole picture; the second only in the shadow.
    const golden::RenderStage render =
        stages({{.everywhere = 0.987, .in_shadow = 0.975}, {.everywhere = 1.013, .in_shadow = 0.94}});
    const Comparison first = golden::compare(
        reference(),
        [&] {
            Candidate candidate(reference().functionals);
            render(0, 64, candidate);
            return candidate;
        }(),
        Method::ranks);
    const Comparison result = golden::compare(reference(), render, Method::ranks);
    EXPECT_EQ(result.verdict, Verdict::fail) << result.reason;
    ASSERT_EQ(result.stages.size(), 2u);
    EXPECT_LT(result.stages[1].p, result.stages[1].level);
    ASSERT_TRUE(first.suspicion && result.suspicion);
    EXPECT_NE(*result.suspicion, *first.suspicion) << first.reason;
    const golden::Finding& confirmed = result.findings[*result.suspicion];
    EXPECT_GT(confirmed.adjusted_p, result.p);
    EXPECT_LT(confirmed.adjusted_p, CompareOptions{}.screening_level);
    EXPECT_NE(result.reason.find(describe_place(confirmed)), std::string::npos) << result.reason;
}

TEST_F(Compare, TheProbabilityAfterAFreshRenderIsThatOfTheFindingThatIsNamed)
{
    // Both renders are too dark everywhere, so more than one suspicion is confirmed. Which of them is
    // the strongest differs, as the second render is darker still in the shadow.
    const golden::RenderStage render =
        stages({{.everywhere = 0.987}, {.everywhere = 0.99, .in_shadow = 0.94}});
    const Comparison result = golden::compare(reference(), render, Method::ranks);
    ASSERT_EQ(result.verdict, Verdict::fail) << result.reason;
    ASSERT_EQ(result.stages.size(), 2u);
    Candidate fresh(reference().functionals);
    render(1, 256, fresh);
    const Comparison second = golden::compare(reference(), fresh, Method::ranks);
    const golden::Finding& named = result.findings[*result.suspicion];
    EXPECT_EQ(result.stages[1].p,
              golden::one_sided(second.findings[*result.suspicion].test, named.test.z));
    EXPECT_NE(result.reason.find(describe_place(named)), std::string::npos) << result.reason;
}

TEST_F(Compare, ASuspicionThatAFreshRenderDoesNotConfirmIsDropped)
{
    const Comparison cleared =
        golden::compare(reference(), stages({suspicious, {}}), Method::ranks, for_small_pictures());
    EXPECT_EQ(cleared.verdict, Verdict::pass) << cleared.reason;
    EXPECT_EQ(cleared.stages.size(), 2u);
    // A render that is too bright does not confirm a suspicion that the picture is too dark.
    const Comparison opposite = golden::compare(reference(), stages({suspicious, {.everywhere = 1.013}}),
                                                Method::ranks, for_small_pictures());
    EXPECT_EQ(opposite.verdict, Verdict::pass) << opposite.reason;
}

TEST_F(Compare, EveryStageMustConfirm)
{
    CompareOptions three = for_small_pictures();
    three.stages = {64, 256, 256};
    EXPECT_EQ(
        golden::compare(reference(), stages({suspicious, suspicious, {}}), Method::ranks, three).verdict,
        Verdict::pass);
    EXPECT_EQ(golden::compare(reference(), stages({suspicious}), Method::ranks, three).verdict,
              Verdict::fail);
}

TEST_F(Compare, AnErrorInOneTileIsFoundThere)
{
    Candidate spotted(reference().functionals);
    for (std::uint64_t batch = 0; batch < 64; ++batch) {
        Image image = renderer().render(3, batch);
        for (int y = 4; y < 8; ++y) // tile in column 5, row 1 of 4x4 pixels
            for (int x = 20; x < 24; ++x) image.at(x, y).g *= 0.5;
        spotted.add_batch(image);
    }
    const Comparison result = golden::compare(reference(), spotted, Method::ranks);
    EXPECT_EQ(result.verdict, Verdict::fail) << result.reason;
    ASSERT_TRUE(result.suspicion);
    EXPECT_EQ(describe(result.findings[*result.suspicion]).substr(0, 30),
              "green of tile x 20..23, y 4..7");
    const golden::TileMap green = golden::tile_map(result, 1);
    ASSERT_EQ(green.columns, 8);
    ASSERT_EQ(green.rows, 8);
    for (std::size_t tile = 0; tile < 64; ++tile) {
        if (tile == 8 + 5)
            EXPECT_LT(green.z[tile], -8.0);
        else
            EXPECT_LT(std::abs(green.z[tile]), 4.5) << tile; // alpha = 7e-6 each
        EXPECT_LT(std::abs(golden::tile_map(result, 0).z[tile]), 4.5) << tile;
    }
}

/// A golden without noise, as of a furnace: each pixel has the same value in all batches.
Golden noiseless_golden()
{
    GoldenMaker maker(16, 16, 32);
    Image image(16, 16);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Rgb(0.1 + static_cast<double>(i), 1.0 / 3.0, 0.0);
    for (int batch = 0; batch < 96; ++batch) maker.add_batch(image);
    return maker.golden(metadata);
}

Candidate scaled(const Golden& golden, double factor)
{
    Candidate candidate(golden.functionals);
    Image image = golden.functionals.pilot().mean;
    for (Rgb& pixel : image.pixels) pixel *= factor;
    for (int batch = 0; batch < 64; ++batch) candidate.add_batch(image);
    return candidate;
}

TEST(CompareWithoutNoise, SinglePrecisionIsNoErrorAndATenthOfAPercentIs)
{
    const Golden golden = noiseless_golden();
    for (const Method method : {Method::ranks, Method::welch}) {
        EXPECT_EQ(compare(golden, scaled(golden, 1.0), method).verdict, Verdict::pass);
        EXPECT_EQ(compare(golden, scaled(golden, 1.0 + 5e-7), method).verdict, Verdict::pass);
        EXPECT_EQ(compare(golden, scaled(golden, 1.0 - 5e-7), method).p, 1.0);
        EXPECT_EQ(compare(golden, scaled(golden, 0.999), method).verdict, Verdict::fail);
    }
}

TEST(CompareWithoutNoise, LightInAChannelThatShouldBeBlackFails)
{
    const Golden golden = noiseless_golden();
    Candidate candidate(golden.functionals);
    Image image = golden.functionals.pilot().mean;
    for (Rgb& pixel : image.pixels) pixel.b = 1e-3;
    for (int batch = 0; batch < 64; ++batch) candidate.add_batch(image);
    const Comparison result = compare(golden, candidate, Method::ranks);
    EXPECT_EQ(result.verdict, Verdict::fail) << result.reason;
    EXPECT_EQ(result.findings[*result.suspicion].channel, 2u);
    EXPECT_TRUE(std::isnan(result.detectable[2]));
}

TEST(CompareWithoutNoise, WhatRoundingLeavesInABlackChannelIsNoError)
{
    const Golden golden = noiseless_golden();
    const auto verdict = [&](double blue) {
        Image image = golden.functionals.pilot().mean;
        for (Rgb& pixel : image.pixels) pixel.b = blue; // red is 128 on average
        return golden::compare_pictures(golden, std::vector(8, image)).verdict;
    };
    EXPECT_EQ(verdict(1e-6), Verdict::pass);
    EXPECT_EQ(verdict(-1e-6), Verdict::pass);
    EXPECT_EQ(verdict(1e-2), Verdict::fail);
}

TEST(CompareWithoutNoise, OneBrightSampleThatTheGoldenNeverSawDoesNotFail)
{
    const Golden golden = noiseless_golden();
    Candidate candidate(golden.functionals);
    Image image = golden.functionals.pilot().mean;
    for (int batch = 0; batch < 63; ++batch) candidate.add_batch(image);
    image.at(5, 5) += Rgb(1e4);
    candidate.add_batch(image);
    EXPECT_NE(compare(golden, candidate, Method::ranks).verdict, Verdict::fail);
    EXPECT_NE(compare(golden, candidate, Method::welch).verdict, Verdict::fail);
}

TEST_F(Compare, AnotherEstimatorWithOtherNoisePassesAndFailsByItsMean)
{
    // The same picture with gamma noise. Its distribution differs, so a test of ranks would rightly
    // reject it.
    const SimulatedRenderer other(size, Noise::gamma);
    const auto pictures = [&](double factor) {
        Candidate result(reference().functionals);
        for (std::uint64_t i = 0; i < 100; ++i)
            result.add_batch(other.render(5, i, {.everywhere = factor}));
        return result;
    };
    CompareOptions options = for_small_pictures();
    const Comparison right = golden::compare(reference(), pictures(1.0), Method::welch, options);
    EXPECT_EQ(right.verdict, Verdict::pass) << right.reason;
    EXPECT_EQ(right.findings.size(), 2 * reference().functionals.size());
    EXPECT_GT(right.coverage, 0.5);
    EXPECT_EQ(golden::compare(reference(), pictures(0.95), Method::welch, options).verdict,
              Verdict::fail);
}

TEST_F(Compare, WhatIsTooSkewedForATTestIsNeverPassed)
{
    const SimulatedRenderer heavy(size, Noise::pareto_15);
    Candidate pictures(reference().functionals);
    for (std::uint64_t i = 0; i < 64; ++i) pictures.add_batch(heavy.render(5, i));
    const Comparison result =
        golden::compare(reference(), pictures, Method::welch, for_small_pictures());
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << result.reason;
    EXPECT_LT(result.coverage, 1.0);
}

TEST_F(Compare, ASinglePictureIsJudgedByAnAssumedNoiseAndSaysSo)
{
    const auto picture = [&](double factor) { return candidate({.everywhere = factor}, 256, 7).mean(); };
    const Comparison right =
        golden::compare_picture(reference(), picture(1.0), 1024.0, for_small_pictures());
    EXPECT_EQ(right.verdict, Verdict::pass) << right.reason;
    EXPECT_EQ(right.method, Method::picture);
    ASSERT_TRUE(right.noise_ratio);
    EXPECT_GT(*right.noise_ratio, 0.5); // the same noise; the golden's own adds a third
    EXPECT_LT(*right.noise_ratio, 2.5);
    EXPECT_EQ(golden::compare_picture(reference(), picture(0.95), 1024.0).verdict, Verdict::fail);
}

TEST_F(Compare, ASinglePictureNoisierThanItClaimsDoesNotFailForIt)
{
    // The picture has 16 samples, but 16384 are stated.
    const Image noisy = candidate({}, 4, 8).mean();
    const Comparison result = golden::compare_picture(reference(), noisy, 16384.0);
    EXPECT_NE(result.verdict, Verdict::fail) << result.reason;
    EXPECT_GT(*result.noise_ratio, 100.0);
}

TEST_F(Compare, TheChanceOfAFalseAlarmIsStated)
{
    // With one stage, it is the certainty level plus the level of dark pixels. With two stages, it is at
    // least the product of both levels, which holds for a golden without error, and below 1e-5.
    EXPECT_DOUBLE_EQ(golden::compare(reference(), candidate(), Method::ranks).false_alarm, 1e-8 + 1e-9);
    const double two = golden::compare(reference(), stages({{}}), Method::ranks).false_alarm;
    EXPECT_GE(two, 0.05 * 1e-7);
    EXPECT_LT(two, 1e-5);
}

TEST_F(Compare, PicturesThatDoNotFitAreRefused)
{
    Candidate candidate(reference().functionals);
    EXPECT_THROW(candidate.add_batch(Image(size, size + 1)), std::invalid_argument);
    Image image(size, size);
    image.at(7, 9).r = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(error_of<std::invalid_argument>([&] { candidate.add_batch(image); }),
              "pixel (7, 9) is NaN or infinite");
    EXPECT_EQ(candidate.batches(), 0u);
    EXPECT_EQ(error_of<std::invalid_argument>([&] { golden::compare_picture(reference(), image, 4.0); }),
              "pixel (7, 9) is NaN or infinite");
    EXPECT_THROW(golden::compare_picture(reference(), Image(size, size), 0.0), std::invalid_argument);
}

TEST_F(Compare, CandidatesOfAnotherSceneOrOfTheGoldensSeedAreRefused)
{
    const auto error = [](const images::Metadata& candidate, Method method) {
        return error_of<std::invalid_argument>(
            [&] { golden::check_comparable(reference(), candidate, method); });
    };
    EXPECT_EQ(error({}, Method::ranks), "");
    EXPECT_EQ(error({{"scene_hash", "abc"}, {"seed", "2"}, {"batch_size", "4"}}, Method::ranks), "");
    EXPECT_EQ(error({{"scene_hash", "xyz"}}, Method::welch),
              "its scene's hash is xyz, the golden's is abc");
    EXPECT_EQ(error({{"seed", "1"}}, Method::ranks),
              "has the golden's own seed, 1: the two are not independent");
    EXPECT_EQ(error({{"batch_size", "8"}}, Method::ranks), "its batch_size is 8, the golden's is 4");
    EXPECT_EQ(error({{"batch_size", "8"}}, Method::welch), "");
}

TEST_F(Compare, TheMultiplicityIsThatOfChannelsFamiliesAndTheirMembers)
{
    // Of a picture that is too dark: few of the products are cut at 1.
    const Comparison result =
        golden::compare(reference(), candidate({.everywhere = 0.95}), Method::ranks);
    std::set<golden::RegionKind> seen; // kinds with a product below 1
    for (const golden::Finding& finding : result.findings) {
        const double members = finding.region.kind == golden::RegionKind::whole       ? 1.0
                               : finding.region.kind == golden::RegionKind::fine_tile ? 64.0
                                                                                      : 16.0;
        EXPECT_DOUBLE_EQ(finding.adjusted_p, std::min(1.0, finding.test.p * 3.0 * 15.0 * members));
        EXPECT_GE(finding.adjusted_p, result.p);
        if (finding.adjusted_p < 1.0) seen.insert(finding.region.kind);
    }
    EXPECT_EQ(seen.size(), 5u);
}

TEST_F(Compare, WhatAGoldenPromisesToShowIsWhatAComparisonWithItSays)
{
    const Comparison result = golden::compare(reference(), candidate(), Method::ranks);
    EXPECT_EQ(golden::detectable_error(reference(), 64), result.detectable);
}

} // namespace
