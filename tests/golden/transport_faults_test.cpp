// Mistakes that only further renders of the golden's scene can undo.

#include "golden/transport_faults.h"

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

/// The simulated picture as the sum of paths of 1 to 4 edges, and a fifth length that is not part of it.
class TransportFaults : public golden_test::SimulatedGolden {
protected:
    static constexpr std::uint64_t batches = 256;
    static constexpr double samples = 4.0 * batches;
    static constexpr int longest = 4;

    /// The share of paths of `edges` edges in the light of a pixel: a lamp that is seen in one corner,
    /// and less direct light to the right and below.
    static double share(int edges, int x, int y)
    {
        constexpr double edge = golden_test::size - 1;
        const bool lamp = x < 8 && y < 6;
        if (edges == 1) return lamp ? 0.9 : 0.0;
        const double rest = lamp ? 0.1 : 1.0;
        const double direct = 0.4 + 0.4 * (edge - x) / edge;
        const double third = (1.0 - direct) * (0.4 + 0.3 * y / edge);
        const std::array<double, 4> shares = {direct, third, 1.0 - direct - third,
                                              0.03 + 0.05 * x / edge};
        return rest * shares.at(static_cast<std::size_t>(edges - 2));
    }
    /// `image` with each pixel times `factor` of its place.
    template <class Factor>
    static Image times(Image image, const Factor& factor)
    {
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) image.at(x, y) *= factor(x, y);
        return image;
    }
    /// As our renderer makes it: other noise than the candidate's.
    static const std::vector<golden::Fault>& faults()
    {
        static const std::vector<golden::Fault> instance = [] {
            const Image whole = picture(batches, 21);
            golden::LightByEdges light;
            for (int k = 1; k <= longest + 1; ++k)
                light.push_back(times(whole, [&](int x, int y) { return share(k, x, y); }));
            return golden::transport_faults(light, longest);
        }();
        return instance;
    }
    static golden::Comparison judged(const std::vector<Image>& pictures)
    {
        return golden::compare_picture(reference(), pictures.at(0), samples,
                                       golden_test::for_small_pictures());
    }
    /// A picture in which paths of k edges count weights[k - 1] times.
    static Image weighted(const std::array<double, 5>& weights)
    {
        static const Image whole = picture(batches, 6);
        return times(whole, [&](int x, int y) {
            double sum = 0.0;
            for (int k = 1; k <= longest + 1; ++k)
                sum += weights.at(static_cast<std::size_t>(k - 1)) * share(k, x, y);
            return sum;
        });
    }
    static std::string name_of(const std::array<double, 5>& weights)
    {
        return first_without_which(judged, reference(), weighted(weights), faults());
    }
};

TEST_F(TransportFaults, ADiagnosisNamesThem)
{
    const auto diagnosis = [](const Image& image) {
        return golden::diagnose(reference(), judged({image}), {image}, samples, judged,
                                {[] { return std::vector<golden::Fault>(); }, faults});
    };
    EXPECT_EQ(diagnosis(weighted({1, 1, 1, 1, 0})), ""); // right
    EXPECT_EQ(diagnosis(weighted({0, 1, 1, 1, 0})),
              "Your picture is without the light of emitters that are seen directly (paths of 1 edge): "
              "with this undone, it PASSes.");
}

TEST_F(TransportFaults, LightThatIsMissingOrTwiceIsNamed)
{
    const auto expect = [](const std::array<double, 5>& weights, const std::string& part) {
        EXPECT_EQ(name_of(weights).substr(0, part.size()), part);
    };
    expect({0, 1, 1, 1, 0}, "without the light of emitters that are seen directly");
    expect({2, 1, 1, 1, 0}, "one in which emitters that are seen directly count twice");
    expect({1, 1, 0, 0, 0}, "one of direct light alone");
    expect({1, 0, 1, 1, 0}, "without direct light");
    expect({1, 2, 1, 1, 0}, "one in which direct light counts twice");
    expect({1, 2, 2, 2, 0},
           "one in which all light counts twice but for emitters that are seen directly");
    expect({1, 1, 1, 0, 0}, "one of paths of up to 3 edges, where the golden's have up to 4");
    expect({1, 1, 1, 1, 1}, "one of paths of up to 5 edges, where the golden's have up to 4");
}

TEST_F(TransportFaults, WrongPicturesOfAnotherKindGetNone)
{
    for (const std::array<double, 5>& weights : {std::array<double, 5>{1, 1, 0.5, 1, 0},
                                                 {1, 0.5, 1, 1, 0},
                                                 {1, 1, 0, 1, 0},
                                                 {0.5, 1, 1, 1, 0},
                                                 {0, 0, 1, 1, 0}}) {
        EXPECT_NE(judged({weighted(weights)}).verdict, golden::Verdict::pass);
        EXPECT_EQ(name_of(weights), "");
    }
}

TEST(TransportFaultsOfALength, LightThatIsBlackMakesNoMistake)
{
    const Image black(2, 2);
    Image grey(2, 2);
    for (Rgb& pixel : grey.pixels) pixel = Rgb(0.5);
    const auto faults = golden::transport_faults({black, grey, black}, 2);
    std::vector<std::string> names;
    for (const golden::Fault& fault : faults)
        if (fault.undo(grey, grey)) names.push_back(fault.is);
    EXPECT_EQ(names,
              (std::vector<std::string>{"without direct light (paths of 2 edges)",
                                        "one in which direct light counts twice (paths of 2 edges)"}));
    EXPECT_THROW(golden::transport_faults({black, grey}, 2), std::invalid_argument);
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
