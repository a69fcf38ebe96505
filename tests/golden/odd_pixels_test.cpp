// Errors of single pixels are found and reported with their position. The noise of right pictures is not
// reported as such an error.

#include "golden/odd_pixels.h"
#include "images/non_finite.h"
#include "tests/golden/simulated_golden.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using calibration::Noise;
using calibration::SimulatedRenderer;
using golden::Comparison;
using golden::Oddity;
using golden::OddPixels;
using golden::Verdict;
using golden_test::for_small_pictures;
using images::Image;
using images::PixelPosition;
using images::Rgb;

class OddPixel : public golden_test::SimulatedGolden {
protected:
    static constexpr std::uint64_t batches = 256;
    static constexpr double samples = 1024.0;

    static Comparison judge(const Image& image)
    {
        return golden::compare_picture(reference(), image, samples, for_small_pictures());
    }
    static std::vector<OddPixels> look(const Image& image)
    {
        return golden::odd_pixels(reference(), image, batches, 1e-9);
    }
    static void expect_starts(const std::string& text, const std::string& start)
    {
        EXPECT_EQ(text.substr(0, start.size()), start);
    }
};

TEST_F(OddPixel, IsNotFoundInARightPicture)
{
    EXPECT_TRUE(look(picture(batches, 7)).empty());
}

TEST_F(OddPixel, ThatIsNegativeFails)
{
    Image image = picture(batches, 7);
    image.at(20, 9).g = -5.0;
    const auto found = look(image);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Oddity::negative);
    EXPECT_TRUE(found[0].wrong);
    EXPECT_EQ(found[0].place, (PixelPosition{20, 9}));
    EXPECT_EQ(found[0].channel, 1u);
    EXPECT_EQ(found[0].value, -5.0);
    const Comparison result = judge(image);
    EXPECT_EQ(result.verdict, Verdict::fail);
    expect_starts(result.reason,
                  "1 pixel is negative, which radiance cannot be: green of pixel (20, 9) is -5.");
    image.at(21, 9).r = -7.0;
    expect_starts(judge(image).reason,
                  "2 pixels are negative, which radiance cannot be: foremost red of "
                  "pixel (21, 9) is -7.");
}

TEST_F(OddPixel, ThatIsNegativeByRoundingAloneIsNoFault)
{
    Image image = picture(batches, 7);
    image.at(0, 0).b = -1e-7; // in the black corner, as after a conversion of colour spaces
    EXPECT_EQ(judge(image).verdict, Verdict::pass) << judge(image).reason;
}

TEST_F(OddPixel, ThatIsClippedFails)
{
    Image image = picture(batches, 7); // the caustic is brighter than 1
    for (Rgb& pixel : image.pixels) pixel = glm::min(pixel, Rgb(1.0));
    const auto found = look(image);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Oddity::clipped);
    EXPECT_TRUE(found[0].wrong); // the mean, too, would make this picture fail
    EXPECT_EQ(found[0].value, 1.0);
    EXPECT_GT(found[0].expected, 1.3);
    EXPECT_GT(found[0].pixels.size(), 20u);
    EXPECT_LT(found[0].pixels.size(), 50u); // 3% of 1024
    const Comparison result = judge(image);
    EXPECT_EQ(result.verdict, Verdict::fail);
    EXPECT_NE(result.reason.find("clipped, exactly 1 where the golden is brighter"), std::string::npos)
        << result.reason;
}

TEST_F(OddPixel, OfSeveralKindsAreAllNamedFirst)
{
    // A clipped picture with one pixel of -5 and one of +200.
    Image image = picture(batches, 7);
    for (Rgb& pixel : image.pixels) pixel = glm::min(pixel, Rgb(1.0));
    image.at(3, 20) = Rgb(-5.0);
    image.at(30, 1) = Rgb(200.0);
    const Comparison result = judge(image);
    EXPECT_EQ(result.verdict, Verdict::fail);
    expect_starts(result.reason, "1 pixel is negative");
    for (const char* part : {"(3, 20) is -5.", "clipped, exactly 1", "1 pixel is far brighter",
                             "of pixel (30, 1) is 200, in the golden 0."})
        EXPECT_NE(result.reason.find(part), std::string::npos) << result.reason;
}

TEST_F(OddPixel, ThatIsDeadFails)
{
    Image image = picture(batches, 7);
    image.at(25, 3) = Rgb(0.0);
    const auto found = look(image);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].kind, Oddity::dark);
    EXPECT_TRUE(found[0].wrong);
    EXPECT_EQ(found[0].place, (PixelPosition{25, 3}));
    const Comparison result = judge(image);
    EXPECT_EQ(result.verdict, Verdict::fail);
    expect_starts(result.reason, "1 pixel is far darker than the golden: ");
    EXPECT_NE(result.reason.find("of pixel (25, 3) is 0, in the golden 0."), std::string::npos)
        << result.reason;
    // In a picture of few samples, a pixel may be black by chance.
    Image noisy = picture(1, 7);
    noisy.at(25, 3) = Rgb(0.0);
    EXPECT_NE(golden::compare_picture(reference(), noisy, 4.0).verdict, Verdict::fail);
}

TEST_F(OddPixel, ThatIsFarTooBrightIsNamedAndTheRestJudgedWithoutIt)
{
    Image image = picture(batches, 7);
    image.at(25, 3) = Rgb(200.0);
    const Comparison result = judge(image);
    EXPECT_EQ(result.verdict, Verdict::inconclusive);
    expect_starts(result.reason, "1 pixel is far brighter than the golden: ");
    for (const char* part :
         {"of pixel (25, 3) is 200, in the golden 0.", "Without it: No difference found; an error of",
          "would have been", "Another picture, with another seed"})
        EXPECT_NE(result.reason.find(part), std::string::npos) << result.reason;
    EXPECT_FALSE(result.shortfall);
    // In a picture of few samples, the bright pixel is not the cause of INCONCLUSIVE. The reason states
    // the true cause: too few samples.
    Image few = picture(4, 7);
    few.at(25, 3) = Rgb(20.0);
    const Comparison inconclusive =
        golden::compare_picture(reference(), few, 16.0, for_small_pictures());
    EXPECT_EQ(inconclusive.verdict, Verdict::inconclusive);
    EXPECT_NE(inconclusive.reason.find("samples per pixel are needed instead of 16."), std::string::npos)
        << inconclusive.reason;
}

TEST_F(OddPixel, ThatIsFarTooBrightHidesNoOtherError)
{
    // An error this small is certain only in the mean of the whole picture, and the one pixel is a tenth
    // of that mean. A picture that is too bright without the pixel fails. A picture that is too dark
    // without it does not fail, as it may lack the light of such pixels.
    const auto with_one = [](double everywhere) {
        Image image = picture(batches, 7, {.everywhere = everywhere});
        image.at(25, 3) = Rgb(50.0);
        return judge(image);
    };
    const Comparison bright = with_one(1.016);
    EXPECT_EQ(bright.verdict, Verdict::fail) << bright.reason;
    EXPECT_NE(bright.reason.find(" Without it, "), std::string::npos) << bright.reason;
    EXPECT_NE(with_one(0.984).verdict, Verdict::fail) << with_one(0.984).reason;
    EXPECT_EQ(with_one(0.984).verdict, Verdict::inconclusive);
}

TEST_F(OddPixel, ThatHindersNothingIsNamedInAPass)
{
    golden::Candidate candidate(reference().functionals);
    for (std::uint64_t batch = 0; batch < 64; ++batch) {
        Image image = renderer().render(2, batch);
        if (batch == 11) image.at(25, 3) = Rgb(1e4); // changes one rank of 64
        candidate.add_batch(image);
    }
    const Comparison result =
        golden::compare(reference(), candidate, golden::Method::ranks, for_small_pictures());
    EXPECT_EQ(result.verdict, Verdict::pass) << result.reason;
    expect_starts(result.reason, "1 pixel is far brighter than the golden: ");
}

TEST_F(OddPixel, OfOneOfSeveralPicturesIsNamedWithThePicture)
{
    std::vector<Image> pictures;
    for (std::uint64_t i = 0; i < 64; ++i) pictures.push_back(picture(1, 40 + i));
    const Comparison right = golden::compare_pictures(reference(), pictures, for_small_pictures());
    EXPECT_EQ(right.verdict, Verdict::pass) << right.reason;
    std::vector<Image> one_negative = pictures;
    one_negative[11].at(25, 3).r = -0.2; // the mean of the pictures stays positive
    const Comparison negative =
        golden::compare_pictures(reference(), one_negative, for_small_pictures());
    EXPECT_EQ(negative.verdict, Verdict::fail);
    expect_starts(negative.reason, "1 pixel is negative, which radiance cannot be: red of pixel (25, 3) "
                                   "of picture 12 is -0.2.");
    std::vector<Image> firefly = pictures;
    firefly[11].at(25, 3) = Rgb(1e5);
    const Comparison bright = golden::compare_pictures(reference(), firefly, for_small_pictures());
    EXPECT_EQ(bright.verdict, Verdict::inconclusive) << bright.reason;
    EXPECT_NE(bright.reason.find("Without it: No difference found"), std::string::npos) << bright.reason;
}

TEST_F(OddPixel, IsNeverWrongInARightPictureWhateverItsNoise)
{
    for (const Noise noise : calibration::noises) {
        const SimulatedRenderer renderer(golden_test::size, noise);
        for (std::uint64_t trial = 0; trial < 10; ++trial) {
            images::Film film(golden_test::size, golden_test::size);
            for (std::uint64_t batch = 0; batch < 64; ++batch) {
                const Image one = renderer.render(50 + trial, batch);
                film.add_batch(one);
                for (const OddPixels& odd : golden::odd_pixels(reference(), one, 1.0, 1e-9))
                    EXPECT_FALSE(odd.wrong) << name(noise) << ": " << describe(odd);
            }
            for (const OddPixels& odd : golden::odd_pixels(reference(), film.mean(), 64.0, 1e-9))
                EXPECT_FALSE(odd.wrong) << name(noise) << ": " << describe(odd);
        }
    }
}

TEST(OddPixelWithoutNoise, APictureWithLessNoiseThanItsGoldenIsNotClipped)
{
    // The right value is the same in all pixels. In half of them the golden is brighter, because of its
    // noise.
    std::mt19937_64 random(1);
    std::normal_distribution<double> noise(1.0, 0.2);
    golden::GoldenMaker maker(16, 16, 4);
    for (int batch = 0; batch < 64; ++batch) {
        Image image(16, 16);
        for (Rgb& pixel : image.pixels) pixel = Rgb(noise(random));
        maker.add_batch(image);
    }
    Image image(16, 16);
    for (Rgb& pixel : image.pixels) pixel = Rgb(1.0);
    EXPECT_TRUE(golden::odd_pixels(maker.golden({}), image, 64.0, 1e-9).empty());
}

TEST(OddPixelWithoutNoise, APictureOfFewValuesIsNotClipped)
{
    // Half of the samples find light, always of the same radiance. With 4 samples, one pixel in four has
    // the value 0.25.
    std::mt19937_64 random(2);
    const auto draw = [&] {
        Image image(16, 16);
        for (Rgb& pixel : image.pixels) {
            int lit = 0;
            for (int sample = 0; sample < 4; ++sample) lit += static_cast<int>(random() % 2);
            pixel = Rgb(lit / 4.0);
        }
        return image;
    };
    golden::GoldenMaker maker(16, 16, 4);
    for (int batch = 0; batch < 256; ++batch) maker.add_batch(draw());
    EXPECT_TRUE(golden::odd_pixels(maker.golden({}), draw(), 1.0, 1e-9).empty());
}

TEST(OddPixelWithoutNoise, ALampThatIsSeenIsNotClipped)
{
    // Many pixels have exactly the largest value, in the picture and in the golden.
    golden::GoldenMaker maker(16, 16, 4);
    Image image(16, 16);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = Rgb(i < 100 ? 12.0 : 0.3);
    for (int batch = 0; batch < 8; ++batch) maker.add_batch(image);
    const golden::Golden golden = maker.golden({});
    EXPECT_TRUE(golden::odd_pixels(golden, image, 8.0, 1e-9).empty());
    for (Rgb& pixel : image.pixels) pixel = glm::min(pixel, Rgb(11.0));
    EXPECT_EQ(golden::odd_pixels(golden, image, 8.0, 1e-9).size(), 1u);
}

TEST(OddPixelWithoutNoise, ThatIsDeadIsJudgedAsTheDarkestOfAll)
{
    golden::GoldenMaker maker(16, 16, 4);
    Image image(16, 16);
    for (Rgb& pixel : image.pixels) pixel = Rgb(1.0);
    for (int batch = 0; batch < 300; ++batch) maker.add_batch(image);
    const golden::Golden golden = maker.golden({});
    image.at(5, 9).g = 0.0;
    constexpr double batches = 60.0;
    const auto is_wrong = [&](double level) {
        const auto found = golden::odd_pixels(golden, image, batches, level);
        return found.size() == 1 && found[0].wrong;
    };
    // The chance of one value has a bound that is larger than this, by a factor of less than 100.
    const double least = golden::chance_of_darkness(0.0, 1.0, 0.0, batches);
    constexpr double values = 3.0 * 16.0 * 16.0;
    EXPECT_FALSE(is_wrong(values * least));
    EXPECT_TRUE(is_wrong(100.0 * values * least));
}

/// The bound holds for distributions for which it is nearly tight: one sample of many finds light.
RC_GTEST_PROP(ChanceOfDarkness, IsAnUpperBound, ())
{
    const double chance = 0.01 * static_cast<double>(*rc::gen::inRange(1, 100)); // of a value 1 / chance
    const int n = *rc::gen::inRange(1, 200);
    const double mean = 1.0;
    const double variance = 1.0 / chance - 1.0;
    // The sum of the binomial probabilities P(k of n) up to k. If k samples find light, the mean is
    // k / (n chance).
    double term = std::pow(1.0 - chance, n);
    double sum = 0.0;
    for (int k = 0; k < n * chance; ++k) {
        sum += term;
        RC_ASSERT(sum <= golden::chance_of_darkness(k / (n * chance), mean, variance, n) * (1.0 + 1e-9));
        term *= static_cast<double>(n - k) / (k + 1.0) * chance / (1.0 - chance);
    }
}

TEST(NonFinite, PixelsAreCountedAndTheFirstIsNamed)
{
    Image image(5, 4);
    EXPECT_EQ(images::say_non_finite(image), std::nullopt);
    image.at(3, 2).g = std::numeric_limits<double>::infinity();
    EXPECT_EQ(images::say_non_finite(image), "pixel (3, 2) is NaN or infinite");
    image.at(1, 3).b = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(images::say_non_finite(image), "2 pixels are NaN or infinite, the first is (3, 2)");
}

} // namespace
