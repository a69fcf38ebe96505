// Mistakes of the camera, which only further renders of the golden's scene can undo.

#include "golden/camera_faults.h"

#include "golden/compare.h"
#include "golden/diagnosis.h"
#include "tests/golden/simulated_golden.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace {

using images::Image;
using images::Rgb;

/// The first of the mistakes without which `picture` PASSes; empty if there is none.
std::string first_without_which(const golden::JudgePictures& judge, const golden::Golden& golden,
                                const Image& picture, const std::vector<golden::Fault>& faults)
{
    const auto passes = [&](const Image& image) {
        try {
            return judge({image}).verdict == golden::Verdict::pass;
        } catch (const std::invalid_argument&) { // no picture: all but the golden's own noise is gone
            return false;
        }
    };
    for (const golden::Fault& fault : faults)
        if (const auto undone = fault.undo(picture, golden.mean); undone && passes(*undone))
            return fault.is;
    return "";
}

TEST(RenderedFault, AddsTheDifferenceAndSpreadsNegativeLight)
{
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    Image picture(4, 1);
    Image wrong(4, 1);
    Image right(4, 1);
    Image golden(4, 1);
    picture.pixels = {Rgb(1.0), Rgb(2.0), Rgb(3.0), Rgb(4.0)};
    right.pixels = {Rgb(1.0), Rgb(1.0), Rgb(5.0), Rgb(1.0)};
    wrong.pixels = {Rgb(2.5), Rgb(1.5), Rgb(2.0), Rgb(unknown)};
    golden.pixels = {Rgb(9.0), Rgb(9.0), Rgb(9.0), Rgb(7.0)};
    // 1 - 1.5 is negative; with 2 - 0.5 beside it the mean is 0.5.
    const auto undone = golden::rendered_fault("x", wrong, right).undo(picture, golden);
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->pixels, (std::vector<Rgb>{Rgb(0.5), Rgb(0.5), Rgb(6.0), Rgb(7.0)}));
    EXPECT_FALSE(golden::rendered_fault("x", right, right).undo(picture, golden)); // changes nothing
    for (Rgb& pixel : wrong.pixels) pixel = Rgb(100.0);
    EXPECT_FALSE(golden::rendered_fault("x", wrong, right).undo(picture, golden)); // less than no light
}

TEST(RatioFault, ScalesTheGoldenByTheRatioOfThePictures)
{
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    Image picture(4, 1);
    Image wrong(4, 1);
    Image golden(4, 1);
    picture.pixels = {Rgb(3.0), Rgb(2.0), Rgb(3.0), Rgb(4.0)};
    wrong.pixels = {Rgb(2.0), Rgb(1.0), Rgb(0.0), Rgb(unknown)};
    golden.pixels = {Rgb(8.0), Rgb(0.0), Rgb(0.5), Rgb(7.0)};
    const auto undone = golden::ratio_fault("x", wrong).undo(picture, golden);
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->pixels, (std::vector<Rgb>{Rgb(12.0), Rgb(0.0), Rgb(3.5), Rgb(7.0)}));
}

/// A picture of a sharp edge, a bright disc and a gradient, of which pictures half a pixel aside exist.
class HalfPixel : public ::testing::Test {
protected:
    static constexpr int size = 32;
    static constexpr double samples = 1024.0;

    static double truth(double x, double y) // x and y in pixels
    {
        const double distance = std::hypot(x - 20.3, y - 9.7);
        return 0.3 + 0.02 * x + 0.01 * y + (x + 0.4 * y > 17.0 ? 0.5 : 0.0) +
               (distance < 6.0 ? 2.0 : 0.0);
    }
    /// The mean over squares of `width` pixels around the centres of pixels of `pitch`, `aside` by that.
    static Image picture_of(double aside_x, double aside_y, double width = 1.0, double pitch = 1.0)
    {
        const int side = static_cast<int>(size / pitch);
        Image image(side, side);
        constexpr int steps = 8;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (int i = 0; i < steps * steps; ++i)
                    image.at(x, y) += Rgb(
                        truth((x + 0.5) * pitch - aside_x + width * ((i % steps + 0.5) / steps - 0.5),
                              (y + 0.5) * pitch - aside_y + width * ((i / steps + 0.5) / steps - 0.5)) /
                        (steps * steps));
        return image;
    }
    /// `image` with the noise of `samples` per pixel, of relative standard deviation 0.3 for one.
    static Image noisy(Image image, std::uint64_t seed, double count)
    {
        std::uint64_t state = seed << 32;
        for (Rgb& pixel : image.pixels)
            for (int c = 0; c < 3; ++c) {
                double sum = 0.0;
                for (int i = 0; i < 4; ++i)
                    sum += static_cast<double>(calibration::mix(++state) >> 11) * 0x1p-53 - 0.5;
                pixel[c] *= 1.0 + 0.3 * std::sqrt(3.0) * sum / std::sqrt(count);
            }
        return image;
    }
    static const golden::Golden& reference()
    {
        static const golden::Golden instance = [] {
            const Image right = picture_of(0.0, 0.0);
            golden::GoldenMaker maker(size, size, 64);
            for (std::uint64_t batch = 0; batch < 256; ++batch)
                maker.add_batch(noisy(right, 1000 + batch, 4.0));
            return maker.golden(golden_test::metadata);
        }();
        return instance;
    }
    static golden::Comparison judged(const std::vector<Image>& pictures)
    {
        return golden::compare_picture(reference(), pictures.at(0), samples);
    }
    static std::string name_of(const Image& image)
    {
        static const std::vector<golden::Fault> faults =
            golden::half_pixel_faults(noisy(picture_of(0.0, 0.0, 0.5, 0.5), 8, samples / 4.0));
        return first_without_which(judged, reference(), noisy(image, 7, samples), faults);
    }
};

TEST_F(HalfPixel, IsNamedInEachDirection)
{
    EXPECT_EQ(judged({noisy(picture_of(0.0, 0.0), 7, samples)}).verdict, golden::Verdict::pass);
    struct Shift {
        double x, y;
        const char* is;
    };
    for (const auto& [x, y, is] : {Shift{0.5, 0.0, "to the right"},
                                   {-0.5, 0.0, "to the left"},
                                   {0.0, 0.5, "downwards"},
                                   {0.0, -0.5, "upwards"},
                                   {0.5, 0.5, "to the right and downwards"},
                                   {-0.5, 0.5, "to the left and downwards"},
                                   {0.5, -0.5, "to the right and upwards"},
                                   {-0.5, -0.5, "to the left and upwards"}})
        EXPECT_EQ(name_of(picture_of(x, y)), std::string("shifted by half a pixel ") + is);
}

TEST_F(HalfPixel, IsNotNamedForOtherMistakes)
{
    for (const Image& wrong : {picture_of(0.0, 0.0, 2.0), picture_of(0.25, 0.0), picture_of(0.75, 0.0),
                               picture_of(0.5, 0.0, 2.0), picture_of(1.0, 0.0)}) {
        EXPECT_NE(judged({noisy(wrong, 7, samples)}).verdict, golden::Verdict::pass);
        EXPECT_EQ(name_of(wrong), "");
    }
}

} // namespace
