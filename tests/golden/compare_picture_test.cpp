// Comparison of a single picture: its noise is estimated apart from the golden's, and with more samples
// smaller errors are detectable.

#include "golden/reason.h"
#include "tests/golden/simulated_golden.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace {

using calibration::Noise;
using calibration::SimulatedRenderer;
using golden::Comparison;
using golden::Verdict;
using golden_test::for_small_pictures;
using images::Image;
using images_test::error_of;

class ComparePicture : public golden_test::SimulatedGolden {};

/// The golden has 3072 samples per pixel.
TEST_F(ComparePicture, NoiseIsWhatItsSamplesLetExpectWhetherTheGoldenHasMoreOrLess)
{
    for (const std::uint64_t samples : {64u, 256u, 1024u, 4096u, 16384u}) {
        const Comparison result = golden::compare_picture(
            reference(), picture(samples / 4, 7), static_cast<double>(samples), for_small_pictures());
        ASSERT_TRUE(result.noise_ratio && result.noise_error);
        std::cout << samples << " samples: " << say_noise(result) << '\n';
        // The ratio is the largest of three channels. Two of them have the same noise.
        EXPECT_NEAR(*result.noise_ratio, 1.0, 3.0 * *result.noise_error) << samples;
        // The error is about that of a variance from 1024 values: sqrt(2 / 1024) of the variances of
        // picture and golden together. The noise in the caustic is skewed and has a larger weight.
        const double both = 1.0 + static_cast<double>(samples) / 3072.0;
        EXPECT_GT(*result.noise_error, 0.03 * both) << samples;
        EXPECT_LT(*result.noise_error, 0.25 * both) << samples;
    }
}

TEST_F(ComparePicture, NoisierThanItClaimsIsFoundOut)
{
    const Comparison result =
        golden::compare_picture(reference(), picture(64, 7), 4.0 * 256, for_small_pictures());
    EXPECT_NEAR(*result.noise_ratio, 4.0, 3.0 * *result.noise_error);
    EXPECT_GT(*result.noise_ratio, 1.0 + 3.0 * *result.noise_error);
}

// A denoiser took four fifths of the noise from every pixel. The mean of the picture is not known better
// by that, so it is judged as a picture of its samples, and their noise is the least that is assumed.
TEST_F(ComparePicture, QuieterThanItsSamplesCanBeIsJudgedByTheirNoise)
{
    const Image noisy = picture(16, 7);
    Image quiet = noisy;
    for (std::size_t i = 0; i < quiet.pixels.size(); ++i)
        quiet.pixels[i] =
            reference().mean.pixels[i] + 0.2 * (noisy.pixels[i] - reference().mean.pixels[i]);
    const auto judged = [](const Image& image) {
        return golden::compare_picture(reference(), image, 64.0, for_small_pictures());
    };
    const Comparison result = judged(quiet);
    ASSERT_TRUE(result.noise_ratio);
    EXPECT_LT(*result.noise_ratio, 0.1);
    EXPECT_EQ(result.verdict, Verdict::inconclusive) << result.reason;
    for (std::size_t c = 0; c < golden::channel_count; ++c)
        EXPECT_GT(result.detectable[c], 0.8 * judged(noisy).detectable[c]);
}

TEST_F(ComparePicture, MoreSamplesShowMoreUpToTheLimitThatTheGoldenSets)
{
    double previous = 1.0;
    double at_last = 1.0;
    for (const std::uint64_t samples : {64u, 256u, 1024u, 4096u, 16384u}) {
        const Comparison result = golden::compare_picture(
            reference(), picture(samples / 4, 7), static_cast<double>(samples), for_small_pictures());
        EXPECT_EQ(result.verdict, samples < 256 ? Verdict::inconclusive : Verdict::pass)
            << result.reason;
        EXPECT_LT(result.detectable[0], 0.95 * previous) << samples;
        EXPECT_GT(result.detectable[0], result.golden_limit[0]);
        previous = result.detectable[0];
        at_last = result.detectable[0] / result.golden_limit[0];
        const bool at_the_limit = say_golden_limit(result).find("hardly help") != std::string::npos;
        EXPECT_EQ(at_the_limit, samples >= 16384) << samples << ": " << say_golden_limit(result);
    }
    // The picture adds a fifth of the golden's variance, which is a tenth of the standard error. The
    // rest is the uncertainty of the noise.
    EXPECT_LT(at_last, 1.2);
}

TEST_F(ComparePicture, SaysHowManySamplesAreNeeded)
{
    golden::CompareOptions options;
    options.specification = 0.01;
    const Comparison few = golden::compare_picture(reference(), picture(16, 7), 64.0, options);
    ASSERT_EQ(few.verdict, Verdict::inconclusive);
    ASSERT_TRUE(few.shortfall);
    const double needed = few.shortfall->candidate * 4.0;
    EXPECT_GT(needed, 64.0);
    EXPECT_LT(needed, 4096.0);
    EXPECT_NE(few.reason.find(" samples per pixel are needed instead of 64."), std::string::npos)
        << few.reason;
    // With somewhat more samples the specified error is detectable. With half of them it is not.
    const auto with = [&](double samples) {
        const auto batches = static_cast<std::uint64_t>(std::ceil(samples / 4.0));
        return golden::compare_picture(reference(), picture(batches, 7),
                                       4.0 * static_cast<double>(batches), options);
    };
    EXPECT_EQ(with(1.2 * needed).verdict, Verdict::pass) << with(1.2 * needed).reason;
    EXPECT_EQ(with(needed / 2.0).verdict, Verdict::inconclusive);
}

TEST_F(ComparePicture, WhereTheGoldenIsTheLimitSaysHowLongAGoldenIsNeeded)
{
    golden::CompareOptions options;
    options.specification = 0.002;
    const Comparison result = golden::compare_picture(reference(), picture(1024, 7), 4096.0, options);
    ASSERT_EQ(result.verdict, Verdict::inconclusive);
    ASSERT_TRUE(result.shortfall);
    EXPECT_TRUE(std::isinf(result.shortfall->candidate));
    EXPECT_GT(result.golden_limit[0], 0.002);
    // The golden may have half of the allowed variance. So it needs twice the batches with which its
    // limit would equal the specification.
    const double worst = std::max(result.golden_limit[0], result.golden_limit[2]);
    EXPECT_NEAR(result.shortfall->golden, 256.0 + 512.0 * 2.0 * std::pow(worst / 0.002, 2.0),
                0.01 * result.shortfall->golden);
    EXPECT_NE(
        result.reason.find("more samples do not help, as the golden's own noise hides errors below"),
        std::string::npos)
        << result.reason;
    EXPECT_NE(result.reason.find("a golden of about"), std::string::npos) << result.reason;
}

TEST_F(ComparePicture, APictureWithTheGoldensOwnNoiseIsRefused)
{
    EXPECT_EQ(error_of<std::invalid_argument>(
                  [&] { golden::compare_picture(reference(), reference().mean, 3072.0); }),
              "has the golden's own noise: it is not independent of the golden");
    // 95% of the noise is the golden's own.
    Image nearly = reference().mean;
    const Image other = picture(64, 9);
    for (std::size_t i = 0; i < nearly.pixels.size(); ++i)
        nearly.pixels[i] = 0.95 * nearly.pixels[i] + 0.05 * other.pixels[i];
    EXPECT_THROW(golden::compare_picture(reference(), nearly, 3072.0), std::invalid_argument);
}

TEST(ComparePictures, SaysHowManyPicturesAreNeeded)
{
    const SimulatedRenderer renderer(32, Noise::gamma);
    golden::GoldenMaker maker(32, 32, 256);
    for (std::uint64_t batch = 0; batch < 768; ++batch) maker.add_batch(renderer.render(1, batch));
    const golden::Golden golden = maker.golden(golden_test::metadata);
    golden::CompareOptions options;
    options.specification = 0.012;
    const auto pictures = [&](std::size_t count) {
        std::vector<Image> result;
        for (std::uint64_t i = 0; i < count; ++i) result.push_back(renderer.render(5, i));
        return result;
    };
    const Comparison few = golden::compare_pictures(golden, pictures(8), options);
    ASSERT_EQ(few.verdict, Verdict::inconclusive);
    ASSERT_TRUE(few.shortfall);
    EXPECT_NE(few.reason.find(" such pictures are needed instead of 8."), std::string::npos)
        << few.reason;
    const auto needed = static_cast<std::size_t>(few.shortfall->candidate);
    EXPECT_GT(needed, 16u);
    EXPECT_EQ(golden::compare_pictures(golden, pictures(needed * 3 / 2), options).verdict,
              Verdict::pass);
    EXPECT_EQ(golden::compare_pictures(golden, pictures(needed / 2), options).verdict,
              Verdict::inconclusive);
}

/// A golden in which only the pilot has seen the rare events of one pixel.
class RareEventsOfAPilot : public ::testing::Test {
protected:
    static constexpr int side = 32;
    static images::Image grey(double value, double event)
    {
        images::Image image(side, side);
        for (images::Rgb& pixel : image.pixels) pixel = images::Rgb(value);
        image.at(5, 6) += event;
        return image;
    }
    static golden::Golden only_in_pilot(double value, double event)
    {
        golden::GoldenMaker maker(side, side, 16);
        for (int batch = 0; batch < 64; ++batch) maker.add_batch(grey(value, batch == 3 ? event : 0.0));
        return maker.golden({{"batch_size", "4"}});
    }
};

TEST_F(RareEventsOfAPilot, OfThePilotAloneDoNotMakeARightPictureFail)
{
    for (const auto& [value, event] : {std::pair{0.0, 0.5}, {1.8, -0.5}, {1.8, 0.5}}) {
        const golden::Golden golden = only_in_pilot(value, event);
        for (const int events : {2, 3}) {
            const images::Image image = grey(value, event * events / 64.0);
            const golden::Comparison one = golden::compare_picture(golden, image, 256.0);
            EXPECT_NE(one.verdict, golden::Verdict::fail)
                << value << ", " << event << ": " << one.reason;
            std::vector<images::Image> four(4, grey(value, 0.0));
            four[1] = image;
            const golden::Comparison few = golden::compare_pictures(golden, four);
            EXPECT_NE(few.verdict, golden::Verdict::fail)
                << value << ", " << event << ": " << few.reason;
        }
    }
}

/// Each of the pictures has the event once, so they are equal, and the golden has none.
TEST_F(RareEventsOfAPilot, ThatAllOfFewPicturesHaveOnceDoNotMakeThemFail)
{
    golden::GoldenMaker maker(side, side, 16);
    for (int batch = 0; batch < 64; ++batch) maker.add_batch(grey(1.8, 0.0));
    const golden::Golden golden = maker.golden({{"batch_size", "4"}});
    const auto verdict = [&](std::size_t pictures, double value, double event) {
        return golden::compare_pictures(golden, std::vector<images::Image>(pictures, grey(value, event)))
            .verdict;
    };
    EXPECT_NE(verdict(2, 1.8, -0.01), golden::Verdict::fail);
    EXPECT_NE(verdict(8, 1.8, -0.01), golden::Verdict::fail);
    // e^-64 for one pixel: no coincidence. Nor if all pixels are different.
    EXPECT_EQ(verdict(64, 1.8, -0.01), golden::Verdict::fail);
    EXPECT_EQ(verdict(2, 1.81, 0.0), golden::Verdict::fail);
}

TEST_F(RareEventsOfAPilot, DoNotHideADifferenceElsewhere)
{
    const golden::Golden golden = only_in_pilot(1.8, 0.5);
    EXPECT_EQ(golden::compare_picture(golden, grey(1.81, 0.0), 256.0).verdict, golden::Verdict::fail);
    EXPECT_EQ(golden::compare_pictures(golden, std::vector<images::Image>(4, grey(1.81, 0.0))).verdict,
              golden::Verdict::fail);
}

/// A right estimator without noise, as a path tracer under a directional light is beside a golden by
/// bidirectional path tracing. What it differs by is the noise of the golden.
class PicturesWithoutNoise : public golden_test::SimulatedGolden {
protected:
    static golden::Comparison compared(std::size_t count, double factor, double samples = 0.0)
    {
        static const Image truth = picture(8192, 77);
        golden::CompareOptions options = golden_test::for_small_pictures();
        options.picture_samples = samples;
        Image image = truth;
        for (images::Rgb& pixel : image.pixels) pixel *= factor;
        return golden::compare_pictures(reference(), std::vector<Image>(count, image), options);
    }
};

TEST_F(PicturesWithoutNoise, PassIfTheyAreEnoughToContainRareEvents)
{
    for (const double within_noise : {0.9995, 1.0005}) {
        const Comparison many = compared(80, within_noise);
        EXPECT_EQ(many.verdict, Verdict::pass) << many.reason;
        const Comparison few = compared(4, within_noise);
        EXPECT_EQ(few.verdict, Verdict::inconclusive) << few.reason;
        EXPECT_NE(few.reason.find("far less noise than the golden"), std::string::npos) << few.reason;
        ASSERT_TRUE(few.shortfall);
        EXPECT_GT(few.shortfall->candidate, 5.0) << few.reason;
        const auto enough = static_cast<std::size_t>(1.2 * few.shortfall->candidate) + 1;
        EXPECT_LT(enough, 80u);
        EXPECT_EQ(compared(enough, within_noise).verdict, Verdict::pass);
    }
}

/// Each sample adds less to a picture of many samples, so little light can be hidden.
TEST_F(PicturesWithoutNoise, PassIfTheyAreFewAndOfManySamples)
{
    const double of_a_batch = golden::batch_size_of(reference());
    EXPECT_EQ(compared(4, 1.0005, of_a_batch).verdict, Verdict::inconclusive);
    const Comparison many = compared(4, 1.0005, 64.0 * of_a_batch);
    EXPECT_EQ(many.verdict, Verdict::pass) << many.reason;
}

TEST_F(PicturesWithoutNoise, FailIfLightIsMissingOrAdded)
{
    EXPECT_EQ(compared(80, 0.95).verdict, Verdict::fail);
    EXPECT_EQ(compared(32, 1.02).verdict, Verdict::fail);
    // Few of them may just lack bright samples, but are suspected.
    const Comparison few = compared(3, 0.95);
    EXPECT_EQ(few.verdict, Verdict::inconclusive) << few.reason;
}

/// A third of the golden's batches have an event in one pixel, which the pictures have not.
TEST_F(RareEventsOfAPilot, OfTheGoldenMayBeLackingInFewPicturesAndNotInMany)
{
    golden::GoldenMaker maker(side, side, 32);
    for (std::uint64_t batch = 0; batch < 256; ++batch)
        maker.add_batch(grey(1.0, calibration::mix(batch) % 3 == 0 ? 3.0 : 0.0));
    const golden::Golden golden = maker.golden({{"batch_size", "4"}});
    const auto verdict = [&](std::size_t count, double samples = 0.0) {
        golden::CompareOptions options;
        options.picture_samples = samples;
        return golden::compare_pictures(golden, std::vector<Image>(count, grey(1.0, 0.0)), options);
    };
    // Each picture has a third of an event, which adds at most four times what the golden's adds.
    EXPECT_GT(verdict(16).p, 0.05) << verdict(16).reason;
    EXPECT_NE(verdict(64).verdict, Verdict::fail) << verdict(64).reason;
    EXPECT_EQ(verdict(256).verdict, Verdict::fail) << verdict(256).reason;
    EXPECT_GT(verdict(16, 4.0).p, 0.05) << verdict(16, 4.0).reason;
    EXPECT_LT(verdict(16, 64.0).p, 1e-8) << verdict(16, 64.0).reason; // as 256 of 4
}

/// Whatever limits it, the number that is said to be enough is larger than that of the pictures.
TEST_F(RareEventsOfAPilot, NeverLessThanWhatIsThereIsAskedFor)
{
    const Comparison few =
        golden::compare_pictures(only_in_pilot(1.8, 0.5), std::vector<Image>(4, grey(1.8, 0.0)));
    EXPECT_EQ(few.verdict, Verdict::inconclusive) << few.reason;
    EXPECT_NE(few.reason.find("a golden of about"), std::string::npos) << few.reason;
}

} // namespace
