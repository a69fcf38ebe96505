// The diagnosis names each of the usual mistakes, and nothing else.

#include "golden/diagnosis.h"

#include "golden/compare.h"
#include "golden/faults.h"
#include "tests/golden/simulated_golden.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace {

using images::Image;
using images::Rgb;

class Diagnosis : public golden_test::SimulatedGolden {
protected:
    static constexpr std::uint64_t batches = 256;
    static constexpr double samples = 4.0 * batches;

    static golden::Comparison judged(const std::vector<Image>& pictures)
    {
        return golden::compare_picture(reference(), pictures.at(0), samples,
                                       golden_test::for_small_pictures());
    }
    /// The diagnosis of a picture, or "".
    static std::string diagnosis(const Image& picture)
    {
        return golden::diagnose(reference(), judged({picture}), {picture}, samples, judged);
    }
    /// A right picture, changed by `mistake`.
    static std::string diagnosis_with(const std::function<Image(Image)>& mistake)
    {
        return diagnosis(mistake(picture(batches, 6)));
    }
    static Image each_value(Image image, const std::function<double(double)>& change)
    {
        for (Rgb& pixel : image.pixels)
            for (int c = 0; c < 3; ++c) pixel[c] = change(pixel[c]);
        return image;
    }
    static Image each_place(const Image& image, const std::function<Rgb(int, int)>& pixel)
    {
        Image result(image.width, image.height);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) result.at(x, y) = pixel(x, y);
        return result;
    }
};

constexpr int last = golden_test::size - 1;

TEST_F(Diagnosis, ARightPictureHasNone)
{
    ASSERT_EQ(judged({picture(batches, 6)}).verdict, golden::Verdict::pass);
    EXPECT_EQ(diagnosis(picture(batches, 6)), "");
}

TEST_F(Diagnosis, NamesMistakesOfPlace)
{
    const auto at = [](const std::function<std::array<int, 2>(int, int)>& from) {
        return diagnosis_with([&](const Image& image) {
            return each_place(image, [&](int x, int y) {
                const auto [column, row] = from(x, y);
                return column < 0 || row < 0 || column > last || row > last ? Rgb(0.0)
                                                                            : image.at(column, row);
            });
        });
    };
    using Place = std::array<int, 2>;
    EXPECT_NE(at([](int x, int y) {
                  return Place{x, last - y};
              }).find("is upside down:"),
              std::string::npos);
    EXPECT_NE(at([](int x, int y) {
                  return Place{last - x, y};
              }).find("is mirrored"),
              std::string::npos);
    EXPECT_NE(at([](int x, int y) {
                  return Place{last - x, last - y};
              }).find("rotated by 180"),
              std::string::npos);
    EXPECT_NE(at([](int x, int y) { return Place{y, x}; }).find("transposed"), std::string::npos);
    // A clockwise quarter turn: the left column becomes the first row.
    EXPECT_NE(at([](int x, int y) { return Place{y, last - x}; }).find("rotated by"), std::string::npos);
    EXPECT_NE(at([](int x, int y) {
                  return Place{x - 1, y};
              }).find("one pixel to the right"),
              std::string::npos);
    EXPECT_NE(at([](int x, int y) {
                  return Place{x + 1, y};
              }).find("one pixel to the left"),
              std::string::npos);
}

TEST_F(Diagnosis, NamesExchangedChannels)
{
    const auto with = [](const std::function<Rgb(const Rgb&)>& order) {
        return diagnosis_with([&](Image image) {
            for (Rgb& pixel : image.pixels) pixel = order(pixel);
            return image;
        });
    };
    const auto has = [](const std::string& text, const char* part) {
        return text.find(part) != std::string::npos;
    };
    EXPECT_TRUE(has(with([](const Rgb& p) { return Rgb(p.b, p.g, p.r); }), "blue, green, red"));
    EXPECT_TRUE(has(with([](const Rgb& p) { return Rgb(p.g, p.r, p.b); }), "red and green exchanged"));
    EXPECT_TRUE(has(with([](const Rgb& p) { return Rgb(p.r, p.b, p.g); }), "green and blue exchanged"));
    EXPECT_TRUE(has(with([](const Rgb& p) { return Rgb(p.b, p.r, p.g); }), "blue, red, green"));
    EXPECT_TRUE(has(with([](const Rgb& p) { return Rgb(p.g, p.b, p.r); }), "green, blue, red"));
}

TEST_F(Diagnosis, NamesEncodings)
{
    const auto with = [](const std::function<double(double)>& encode) {
        return diagnosis_with([&](const Image& image) { return each_value(image, encode); });
    };
    EXPECT_NE(with([](double v) {
                  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
              }).find("is encoded as sRGB:"),
              std::string::npos);
    EXPECT_NE(with([](double v) { return std::pow(v, 1.0 / 2.2); }).find("a gamma of 2.2:"),
              std::string::npos);
}

TEST_F(Diagnosis, NamesConstantFactors)
{
    const auto times = [](double factor) {
        return diagnosis_with(
            [&](const Image& image) { return each_value(image, [&](double v) { return factor * v; }); });
    };
    EXPECT_EQ(times(1.0 / std::numbers::pi),
              "Your picture is 0.3183 = 1/pi times the golden everywhere: divided by it, it PASSes.");
    EXPECT_NE(times(4.0 * std::numbers::pi).find(" = 4 pi times"), std::string::npos);
    EXPECT_NE(times(0.5).find("0.5 = 1/2 times"), std::string::npos);
    EXPECT_NE(times(samples).find("= the number of samples per pixel times"), std::string::npos);
    EXPECT_NE(times(1.7).find("Your picture is 1.7"), std::string::npos);
    EXPECT_EQ(times(1.7).find(" = "), std::string::npos);
}

TEST_F(Diagnosis, WrongPicturesOfAnotherKindHaveNone)
{
    const auto wrong = [](const std::function<void(Image&)>& mistake) {
        return [mistake](Image image) {
            mistake(image);
            EXPECT_EQ(judged({image}).verdict, golden::Verdict::fail);
            return image;
        };
    };
    EXPECT_EQ(diagnosis_with(wrong([](Image& image) { // a corner is half as bright
                  for (int y = 0; y < 12; ++y)
                      for (int x = 0; x < 12; ++x) image.at(x, y) *= 0.5;
              })),
              "");
    EXPECT_EQ(diagnosis_with(wrong([](Image& image) { // fog
                  for (Rgb& pixel : image.pixels) pixel += Rgb(0.3);
              })),
              "");
    EXPECT_EQ(diagnosis_with(wrong([](Image& image) { // a gradient
                  for (int y = 0; y <= last; ++y)
                      for (int x = 0; x <= last; ++x) image.at(x, y) *= 0.5 + 1.0 * x / last;
              })),
              "");
    EXPECT_EQ(diagnosis_with(wrong([](Image& image) { image = Image(image.width, image.height); })), "");
}

TEST(Faults, ShiftsAreUndoneAndTheGoldenStandsAtTheBorder)
{
    Image right(3, 3);
    Image golden(3, 3);
    for (std::size_t i = 0; i < 9; ++i) {
        right.pixels[i] = Rgb(static_cast<double>(i));
        golden.pixels[i] = Rgb(100.0 + static_cast<double>(i));
    }
    struct Shift {
        const char* is;
        int dx, dy;
    };
    for (const auto& [is, dx, dy] : {Shift{"to the right", 1, 0},
                                     {"to the left", -1, 0},
                                     {"downwards", 0, 1},
                                     {"upwards", 0, -1}}) {
        const auto inside = [](int v) { return v >= 0 && v < 3; };
        Image wrong(3, 3);
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x)
                if (inside(x + dx) && inside(y + dy)) wrong.at(x + dx, y + dy) = right.at(x, y);
        bool found = false;
        for (const golden::Fault& fault : golden::usual_faults()) {
            if (fault.is != std::string("shifted by one pixel ") + is) continue;
            found = true;
            const auto undone = fault.undo(wrong, golden);
            ASSERT_TRUE(undone);
            for (int y = 0; y < 3; ++y)
                for (int x = 0; x < 3; ++x)
                    EXPECT_EQ(undone->at(x, y),
                              inside(x + dx) && inside(y + dy) ? right.at(x, y) : golden.at(x, y))
                        << is << ' ' << x << ' ' << y;
        }
        EXPECT_TRUE(found) << is;
    }
}

TEST(Faults, ClampedValuesAreThoseAboveOne)
{
    const auto faults = golden::usual_faults();
    const auto clamped = std::find_if(faults.begin(), faults.end(),
                                      [](const auto& fault) { return fault.is == "clamped at 1"; });
    ASSERT_NE(clamped, faults.end());
    Image golden(2, 1);
    golden.pixels = {Rgb(0.2), Rgb(3.0)};
    Image picture(2, 1);
    picture.pixels = {Rgb(0.25), Rgb(1.0)};
    const auto undone = clamped->undo(picture, golden);
    ASSERT_TRUE(undone);
    EXPECT_EQ(undone->pixels[0], Rgb(0.25));
    EXPECT_EQ(undone->pixels[1], Rgb(3.0));
    picture.pixels[1] = Rgb(1.5);
    EXPECT_FALSE(clamped->undo(picture, golden));
    golden.pixels[1] = Rgb(0.9);
    picture.pixels[1] = Rgb(0.9);
    EXPECT_FALSE(clamped->undo(picture, golden)); // nothing was cut
}

} // namespace
