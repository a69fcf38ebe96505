// Channels, layers and primaries of other programs' files.

#include "images/exr.h"
#include "images/image_error.h"
#include "tests/images/foreign_exr.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

#include <ImfRgbaFile.h>
#include <ImfStandardAttributes.h>

#include <limits>

namespace {

using images::ExrPicture;
using images::Rgb;
using namespace images_test;

const ForeignChannels two_pixels = {{"R", {1.0f, 4.0f}}, {"G", {2.0f, 5.0f}}, {"B", {3.0f, 6.0f}}};

/// Two pixels with these channels.
ExrPicture read_two(const ForeignChannels& channels, Imf::PixelType type = Imf::FLOAT,
                    const std::string& layer = "")
{
    const TemporaryFolder folder;
    write_foreign(folder / "a.exr", Imf::Header(2, 1), channels, type);
    return images::read_exr(folder / "a.exr", layer);
}

/// What the reader says of a file of two pixels, without the file's name.
std::string error_of_two(const ForeignChannels& channels, const std::string& layer = "")
{
    const std::string error =
        error_of<images::ImageError>([&] { read_two(channels, Imf::FLOAT, layer); });
    const std::size_t name = error.find("a.exr: ");
    return name == std::string::npos ? error : error.substr(name + 7);
}

/// `two_pixels` as a layer, with `more` channels.
ForeignChannels layer_and(const std::string& name, ForeignChannels more = {})
{
    for (const auto& [channel, values] : two_pixels) more[name + "." + channel] = values;
    return more;
}

void expect_two_pixels(const ExrPicture& picture)
{
    EXPECT_EQ(picture.mean.at(0, 0), Rgb(1.0, 2.0, 3.0));
    EXPECT_EQ(picture.mean.at(1, 0), Rgb(4.0, 5.0, 6.0));
}

TEST(ForeignExrChannels, HalfFloatAndWholeNumbersAreRead)
{
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT, Imf::UINT}) {
        ForeignChannels with_alpha = two_pixels;
        with_alpha["A"] = {0.0f, 1.0f};
        expect_two_pixels(read_two(with_alpha, type)); // alpha is ignored
    }
}

TEST(ForeignExrChannels, TheOnlyLayerOfColoursIsThePicture)
{
    for (const char* name : {"left", "Beauty", "ViewLayer.Combined"}) {
        const ExrPicture picture = read_two(
            layer_and(name, {{"depth.Z", {7.0f, 7.0f}}, {std::string(name) + ".A", {1.0f, 1.0f}}}));
        expect_two_pixels(picture);
        EXPECT_EQ(picture.layer, name);
    }
    // Channels without a layer are the picture, whatever layers there are.
    ForeignChannels both =
        layer_and("Gloss", {{"R", {9.0f, 9.0f}}, {"G", {9.0f, 9.0f}}, {"B", {9.0f, 9.0f}}});
    const ExrPicture picture = read_two(both);
    EXPECT_EQ(picture.mean.at(0, 0), Rgb(9.0));
    EXPECT_EQ(picture.layer, "");
}

TEST(ForeignExrChannels, LuminanceAloneIsGrey)
{
    const ExrPicture grey = read_two({{"Y", {0.5f, 3.0f}}, {"A", {1.0f, 1.0f}}});
    EXPECT_EQ(grey.mean.at(0, 0), Rgb(0.5));
    EXPECT_EQ(grey.mean.at(1, 0), Rgb(3.0));
    const ExrPicture layer = read_two({{"Beauty.Y", {0.5f, 3.0f}}, {"Z", {1.0f, 1.0f}}});
    EXPECT_EQ(layer.mean.at(1, 0), Rgb(3.0));
    EXPECT_EQ(layer.layer, "Beauty");
    // Of a layer of colours and one of luminance the colours are the picture.
    ForeignChannels both = layer_and("Beauty", {{"Mask.Y", {1.0f, 1.0f}}});
    expect_two_pixels(read_two(both));
    EXPECT_EQ(read_two(both, Imf::FLOAT, "Mask").mean.at(1, 0), Rgb(1.0));
}

TEST(ForeignExrChannels, WhatIsNoPictureIsToldWithWhatIsWanted)
{
    const std::vector<float> any = {1.0f, 1.0f};
    EXPECT_EQ(error_of_two({{"A", any}, {"Z", any}}), "has the channels A, Z; wanted: R, G, B, or Y");
    EXPECT_EQ(error_of_two({{"Z", any}}), "has the channel Z; wanted: R, G, B, or Y");
    EXPECT_EQ(error_of_two({{"R", any}, {"G", any}}), "has the channels G, R; wanted: R, G, B, or Y");
    EXPECT_EQ(error_of_two({{"diffuse.R", any}, {"diffuse.G", any}}),
              "has the channels diffuse.G, diffuse.R; wanted: R, G, B, or Y");
    EXPECT_EQ(error_of_two(two_pixels, "Beauty"),
              "has the channels B, G, R; wanted: Beauty.R, Beauty.G, Beauty.B, or Beauty.Y");
    ForeignChannels many;
    for (char c = 'a'; c <= 'z'; ++c) many[std::string(8, c)] = any;
    const std::string error = error_of_two(many);
    EXPECT_LT(error.size(), 160u) << error;
    EXPECT_NE(error.find("gggggggg, ..., zzzzzzzz; wanted"), std::string::npos) << error;
}

TEST(ForeignExrChannels, HalvedChromaIsRefused)
{
    const TemporaryFolder folder;
    {
        std::vector<Imf::Rgba> pixels(16, Imf::Rgba(0.5f, 0.25f, 0.125f));
        Imf::RgbaOutputFile file((folder / "a.exr").c_str(), 4, 4, Imf::WRITE_YC);
        file.setFrameBuffer(pixels.data(), 1, 4);
        file.writePixels(4);
    }
    const std::string error = error_of<images::ImageError>([&] { images::read_exr(folder / "a.exr"); });
    EXPECT_NE(error.find("a.exr: has luminance and chroma (Y, RY, BY), which hold colours coarsely; "
                         "wanted: R, G, B, or Y"),
              std::string::npos)
        << error;
}

/// Two pixels with these primaries.
ExrPicture with_primaries(const Imf::Chromaticities& primaries)
{
    const TemporaryFolder folder;
    Imf::Header header(2, 1);
    Imf::addChromaticities(header, primaries);
    write_foreign(folder / "a.exr", header, layer_and("Gloss", two_pixels));
    return images::read_exr(folder / "a.exr");
}

TEST(ForeignExrPrimaries, Rec709IsNotChanged)
{
    expect_two_pixels(with_primaries(Imf::Chromaticities()));
}

TEST(ForeignExrPrimaries, OtherPrimariesAreConverted)
{
    // Rec.2020 to Rec.709, ITU-R BT.2087-0, annex 2, in the other direction.
    const ExrPicture wide =
        with_primaries({{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}});
    const auto expect_wide = [](const Rgb& value, const Rgb& wide_value) {
        EXPECT_NEAR(0.6274 * value.r + 0.3293 * value.g + 0.0433 * value.b, wide_value.r, 5e-4);
        EXPECT_NEAR(0.0691 * value.r + 0.9195 * value.g + 0.0114 * value.b, wide_value.g, 5e-4);
        EXPECT_NEAR(0.0164 * value.r + 0.0880 * value.g + 0.8956 * value.b, wide_value.b, 5e-4);
    };
    expect_wide(wide.mean.at(0, 0), Rgb(1.0, 2.0, 3.0));
    expect_wide(wide.mean.at(1, 0), Rgb(4.0, 5.0, 6.0));
    expect_wide(wide.layers.at("Gloss").at(1, 0), Rgb(4.0, 5.0, 6.0));

    // X, Y, Z as primaries: IEC 61966-2-1.
    const ExrPicture xyz =
        with_primaries({{1.0f, 0.0f}, {0.0f, 1.0f}, {0.0f, 0.0f}, {1.0f / 3, 1.0f / 3}});
    const Rgb value = xyz.mean.at(0, 0);
    EXPECT_NEAR(value.r, 3.2406 * 1.0 - 1.5372 * 2.0 - 0.4986 * 3.0, 2e-3);
    EXPECT_NEAR(value.g, -0.9689 * 1.0 + 1.8758 * 2.0 + 0.0415 * 3.0, 2e-3);
    EXPECT_NEAR(value.b, 0.0557 * 1.0 - 0.2040 * 2.0 + 1.0570 * 3.0, 2e-3);
}

TEST(ForeignExrPrimaries, ThoseThatAreNoPrimariesAreAnError)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Imf::Chromaticities& none :
         {Imf::Chromaticities({0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}), // one point
          Imf::Chromaticities({0.1f, 0.1f}, {0.2f, 0.2f}, {0.3f, 0.3f}, {0.3f, 0.4f}), // a line
          Imf::Chromaticities({0.64f, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.3f, 0.0f}),
          Imf::Chromaticities({nan, 0.33f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.3f, 0.3f})}) {
        const std::string error = error_of<images::ImageError>([&] { with_primaries(none); });
        EXPECT_NE(error.find("a.exr: its chromaticities are no primaries and white of colours"),
                  std::string::npos)
            << error;
    }
}

} // namespace
