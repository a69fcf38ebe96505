// Pictures with the same noise are found. Independent pictures are never reported, even if their noise
// has heavy tails.

#include "golden/independence.h"
#include "tests/golden/simulated_golden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace {

using calibration::Noise;
using calibration::SimulatedRenderer;
using golden::shared_noise;
using images::Image;
using images::Rgb;

class Independence : public golden_test::SimulatedGolden {
protected:
    static std::vector<Image> independent(std::size_t count, std::uint64_t batches = 16)
    {
        std::vector<Image> pictures;
        for (std::size_t i = 0; i < count; ++i) pictures.push_back(picture(batches, 20 + i));
        return pictures;
    }
    /// The same picture with relative differences of size `by`, as from single precision or another
    /// order of summation.
    static Image rounded_otherwise(Image image, double by = 1e-6)
    {
        std::mt19937_64 random(3);
        std::normal_distribution<double> normal;
        for (Rgb& pixel : image.pixels) pixel *= 1.0 + by * normal(random);
        return image;
    }
};

TEST_F(Independence, OfOnePictureTwiceIsSaid)
{
    const std::vector<Image> one = independent(1);
    const auto found = shared_noise(reference(), std::vector{one[0], one[0]});
    ASSERT_TRUE(found);
    EXPECT_EQ(found->why, "are equal in all pixels");
    // Also if the golden has more noise than the pictures.
    const Image long_one = picture(4096, 9);
    EXPECT_TRUE(shared_noise(reference(), std::vector{long_one, long_one}));
    EXPECT_TRUE(shared_noise(reference(), std::vector(5, one[0])));
}

TEST_F(Independence, OfTheSameNoiseRoundedOtherwiseIsSaid)
{
    const std::vector<Image> one = independent(1);
    EXPECT_TRUE(shared_noise(reference(), std::vector{one[0], rounded_otherwise(one[0])}));
    // In one pixel of 50, a rounding error changes the direction of a path.
    Image here_and_there = rounded_otherwise(one[0]);
    const Image other = picture(16, 99);
    for (std::size_t i = 0; i < other.pixels.size(); i += 50) here_and_there.pixels[i] = other.pixels[i];
    EXPECT_TRUE(shared_noise(reference(), std::vector{one[0], here_and_there}));
}

TEST_F(Independence, OfTwoAmongManyIsSaidWhereverTheyAre)
{
    for (const std::size_t count : {3u, 4u, 9u, 64u})
        for (const std::size_t again : {std::size_t{1}, count / 2, count - 1}) {
            std::vector<Image> pictures = independent(count);
            pictures[again] = rounded_otherwise(pictures[0]);
            const auto found = shared_noise(reference(), pictures);
            ASSERT_TRUE(found) << again << " of " << count;
            EXPECT_EQ(found->first, 0u);
            EXPECT_EQ(found->second, again);
        }
}

TEST_F(Independence, OfNearlyTheSameNoiseIsSaidAndOfHalfOfItIsNot)
{
    const auto mixed = [&](double share) {
        std::vector<Image> pictures = independent(4);
        const Image other = picture(16, 99);
        for (std::size_t i = 0; i < other.pixels.size(); ++i)
            pictures[2].pixels[i] =
                pictures[0].pixels[i] + share * (other.pixels[i] - reference().mean.pixels[i]);
        return shared_noise(reference(), pictures);
    };
    EXPECT_TRUE(mixed(0.03)); // a correlation of 0.9995
    EXPECT_FALSE(mixed(1.0)); // a correlation of 0.7
}

TEST_F(Independence, IsNotDeniedToIndependentPicturesWhateverTheirNoise)
{
    for (const Noise noise : calibration::noises) {
        const SimulatedRenderer renderer(golden_test::size, noise);
        for (std::uint64_t trial = 0; trial < 20; ++trial) {
            std::vector<Image> pictures;
            for (std::uint64_t i = 0; i < 8; ++i) pictures.push_back(renderer.render(trial, i));
            EXPECT_FALSE(shared_noise(reference(), pictures)) << name(noise);
            pictures.resize(2);
            EXPECT_FALSE(shared_noise(reference(), pictures)) << name(noise);
        }
    }
}

TEST_F(Independence, IsNotDeniedToWrongPictures)
{
    // Pictures that are twice as bright, gamma-encoded or upside down. They differ much from the golden
    // and little from each other.
    std::vector<Image> pictures = {picture(4096, 30), picture(4096, 31), picture(4096, 32)};
    const auto both = [&](const auto& change) {
        std::vector<Image> changed = pictures;
        for (Image& image : changed) change(image);
        EXPECT_FALSE(shared_noise(reference(), changed));
        changed.pop_back();
        EXPECT_FALSE(shared_noise(reference(), changed));
    };
    both([](Image& image) {
        for (Rgb& pixel : image.pixels) pixel *= 2.0;
    });
    both([](Image& image) {
        for (Rgb& pixel : image.pixels)
            for (int c = 0; c < 3; ++c) pixel[c] = std::pow(pixel[c], 1.0 / 2.2);
    });
    both([](Image& image) { std::reverse(image.pixels.begin(), image.pixels.end()); });
}

TEST_F(Independence, IsNotDeniedToPicturesOfDifferentBrightness)
{
    // They are far from each other, in whatever order the two of a pair are subtracted.
    const auto times = [](double factor, Image image) {
        for (Rgb& pixel : image.pixels) pixel *= factor;
        return image;
    };
    const std::vector<Image> few = independent(2);
    for (const double factor : {0.1, 10.0})
        EXPECT_FALSE(shared_noise(reference(), std::vector{few[0], times(factor, few[1])}));
    std::vector<Image> many = {picture(4096, 30), times(2.0, picture(4096, 31)),
                               times(3.0, picture(4096, 32))};
    EXPECT_FALSE(shared_noise(reference(), many));
    std::reverse(many.begin(), many.end());
    EXPECT_FALSE(shared_noise(reference(), many));
}

TEST_F(Independence, IsToldWherePicturesAreNotBlack)
{
    // One sample in 8, or one in 100, finds light, always of the same radiance.
    std::mt19937_64 random(5);
    const auto draw = [&](std::uint64_t one_in) {
        std::vector<Image> pictures(6, Image(golden_test::size, golden_test::size));
        for (Image& image : pictures)
            for (Rgb& pixel : image.pixels)
                if (random() % one_in == 0) pixel = Rgb(50.0);
        return pictures;
    };
    for (const std::uint64_t one_in : {8u, 100u}) {
        std::vector<Image> pictures = draw(one_in);
        EXPECT_FALSE(shared_noise(reference(), pictures));
        pictures.resize(2);
        EXPECT_FALSE(shared_noise(reference(), pictures));
    }
    std::vector<Image> doubled = draw(8);
    doubled[4] = doubled[1];
    EXPECT_TRUE(shared_noise(reference(), doubled));
}

TEST_F(Independence, IsNotDeniedToTwoGoodPicturesBesideAPoorOne)
{
    EXPECT_FALSE(
        shared_noise(reference(), std::vector{picture(512, 60), picture(512, 61), picture(2, 62)}));
}

TEST(IndependenceWithoutNoise, IsNotDeniedToPicturesWithRareEvents)
{
    // The pictures are right and have no noise in nearly all pixels. In these pixels the golden contains
    // rare events.
    std::mt19937_64 random(6);
    const auto draw = [&](std::uint64_t one_in) {
        Image image(32, 32);
        for (Rgb& pixel : image.pixels) pixel = Rgb(random() % one_in == 0 ? 3.0 : 1.0);
        return image;
    };
    golden::GoldenMaker maker(32, 32, 64);
    for (int batch = 0; batch < 256; ++batch) maker.add_batch(draw(100));
    EXPECT_FALSE(shared_noise(maker.golden({}), std::vector{draw(100), draw(100)}));
    EXPECT_FALSE(shared_noise(maker.golden({}), std::vector{draw(100), draw(100), draw(100)}));
}

TEST(IndependenceWithoutNoise, IsNotDeniedToPicturesThatRoundingTellsApart)
{
    // The sky is the same constant in all pictures. A renderer that adds floats, and divides by a number
    // of samples that is not the same in all pictures, moves all of the sky by the same few units of the
    // last place; the first two happen to agree.
    std::mt19937_64 random(7);
    const auto draw = [&](double last_places) {
        Image image(64, 64);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] =
                Rgb(i % 50 == 0 ? 1.0 + 1e-3 * static_cast<double>(random() % 1000)
                                : 0.9 * (1.0 + last_places * std::numeric_limits<float>::epsilon()));
        return image;
    };
    golden::GoldenMaker maker(64, 64, 4);
    for (int batch = 0; batch < 64; ++batch) maker.add_batch(draw(0.0));
    EXPECT_FALSE(shared_noise(maker.golden({}), std::vector{draw(1.0), draw(1.0), draw(5.0)}));
}

TEST(IndependenceWithoutNoise, EqualPicturesAreRight)
{
    golden::GoldenMaker maker(16, 16, 4);
    Image image(16, 16);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = Rgb(1.0 + static_cast<double>(i));
    for (int batch = 0; batch < 8; ++batch) maker.add_batch(image);
    EXPECT_FALSE(shared_noise(maker.golden({}), std::vector{image, image, image}));
    EXPECT_FALSE(shared_noise(maker.golden({}), std::vector{image, image}));
}

TEST(IndependenceBound, IsTheBinomialTail)
{
    // The probability of 9 or 10 of 10 is (10 * 2 + 1) / 3^10.
    EXPECT_NEAR(golden::chance_of_shared_noise(10), 21.0 / 59049.0, 1e-12);
    EXPECT_LT(golden::chance_of_shared_noise(256),
              std::exp(-0.70 * 256.0)); // the bound of docs/comparison.md
    EXPECT_EQ(golden::chance_of_shared_noise(0), 1.0);
}

} // namespace
