// Files of other programs. They are made here with OpenEXR itself, without any of our code.

#include "images/exr.h"
#include "images/image_error.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <ImfTiledOutputFile.h>

#include <array>
#include <vector>

namespace {

using images::ExrPicture;
using images::Image;
using images::ImageError;
using namespace images_test;
namespace fs = std::filesystem;

constexpr int width = 13;
constexpr int height = 7;
const Imath::Box2i window(Imath::V2i(-5, 100), Imath::V2i(-5 + width - 1, 100 + height - 1));

/// A value that half precision represents exactly, different in every pixel and channel.
float value(int x, int y, int channel)
{
    return static_cast<float>(channel * 128 + y * width + x) / 8.0f;
}

Image expected()
{
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int channel = 0; channel < 3; ++channel)
                image.at(x, y)[channel] = static_cast<double>(value(x, y, channel));
    return image;
}

/// R, G, B and depth as planes of `Value`, in the layout that OpenEXR writes.
template <class Value>
class Planes {
public:
    explicit Planes(Imf::PixelType type)
    {
        for (int channel = 0; channel < 4; ++channel)
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x) values_[channel].push_back(Value(value(x, y, channel)));
        for (int channel = 0; channel < 4; ++channel)
            buffer.insert(names[channel],
                          Imf::Slice::Make(type, values_[channel].data(), window, sizeof(Value),
                                           sizeof(Value) * static_cast<std::size_t>(width)));
    }
    static constexpr const char* names[] = {"R", "G", "B", "depth.Z"};
    Imf::FrameBuffer buffer;

private:
    std::vector<Value> values_[4];
};

Imf::Header header(Imf::PixelType type, Imf::Compression compression = Imf::ZIP_COMPRESSION)
{
    Imf::Header header(window, window);
    for (const char* name : Planes<float>::names) header.channels().insert(name, Imf::Channel(type));
    header.compression() = compression;
    return header;
}

template <class Value>
void write_scan_lines(const fs::path& path, Imf::PixelType type, const Imf::Header& header)
{
    const Planes<Value> planes(type);
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(planes.buffer);
    file.writePixels(height);
}

void expect_the_picture(const fs::path& path)
{
    const ExrPicture read = images::read_exr(path);
    EXPECT_EQ(read.mean, expected());
    EXPECT_FALSE(read.standard_error.has_value());
    EXPECT_FALSE(read.film.has_value());
    EXPECT_TRUE(read.layers.empty());
    EXPECT_TRUE(read.metadata.empty());
}

std::string error_of_reading(const fs::path& path)
{
    const std::string error = error_of<ImageError>([&] { images::read_exr(path); });
    EXPECT_EQ(error.rfind(path.string() + ": ", 0), 0u) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos);
    return error.substr(std::min(error.size(), path.string().size() + 2));
}

TEST(ForeignExr, LosslessFilesOfEveryCompressionAreRead)
{
    const TemporaryFolder folder;
    for (const auto compression : {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION,
                                   Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        write_scan_lines<float>(folder / "float.exr", Imf::FLOAT, header(Imf::FLOAT, compression));
        expect_the_picture(folder / "float.exr");
        write_scan_lines<half>(folder / "half.exr", Imf::HALF, header(Imf::HALF, compression));
        expect_the_picture(folder / "half.exr");
    }
}

TEST(ForeignExr, RowsInDecreasingOrderAndTilesAreRead)
{
    const TemporaryFolder folder;
    Imf::Header upside_down = header(Imf::FLOAT);
    upside_down.lineOrder() = Imf::DECREASING_Y;
    write_scan_lines<float>(folder / "down.exr", Imf::FLOAT, upside_down);
    expect_the_picture(folder / "down.exr");

    Imf::Header tiled = header(Imf::HALF);
    tiled.setTileDescription(Imf::TileDescription(4, 4, Imf::ONE_LEVEL));
    {
        const Planes<half> planes(Imf::HALF);
        Imf::TiledOutputFile file((folder / "tiles.exr").c_str(), tiled);
        file.setFrameBuffer(planes.buffer);
        file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
    }
    expect_the_picture(folder / "tiles.exr");
}

TEST(ForeignExr, AttributesOfOthersAreNotOurMetadata)
{
    const TemporaryFolder folder;
    Imf::Header other = header(Imf::FLOAT);
    other.insert("comments", Imf::StringAttribute("by another program"));
    other.insert("plumblinelike", Imf::StringAttribute("no dot"));
    write_scan_lines<float>(folder / "a.exr", Imf::FLOAT, other);
    expect_the_picture(folder / "a.exr");
}

TEST(ForeignExr, SubsampledChannelsAreNamed)
{
    const TemporaryFolder folder;
    Imf::Header coarse(14, 8);
    for (const char* name : {"R", "G", "B"})
        coarse.channels().insert(name, Imf::Channel(Imf::HALF, *name == 'G' ? 2 : 1, 1));
    Imf::OutputFile((folder / "coarse.exr").c_str(), coarse);
    EXPECT_EQ(error_of_reading(folder / "coarse.exr"), "channel G is subsampled");
}

TEST(ForeignExr, OneOfSeveralLayersIsChosenByName)
{
    // The layout of renderers that write a picture for each kind of light, without R, G, B of their own.
    const TemporaryFolder folder;
    const fs::path path = folder / "layers.exr";
    Imf::Header header(2, 1);
    Imf::FrameBuffer buffer;
    std::vector<std::array<float, 2>> planes;
    planes.reserve(6);
    for (const char* name : {"View.Diffuse.R", "View.Diffuse.G", "View.Diffuse.B", "View.Gloss.R",
                             "View.Gloss.G", "View.Gloss.B"}) {
        const auto first = static_cast<float>(10 * planes.size());
        planes.push_back({first, first + 1.0f});
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, planes.back().data(), Imath::V2i(0), 2, 1));
    }
    {
        Imf::OutputFile file(path.c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    const ExrPicture gloss = images::read_exr(path, "View.Gloss");
    EXPECT_EQ(gloss.mean.at(0, 0), images::Rgb(30.0, 40.0, 50.0));
    EXPECT_EQ(gloss.mean.at(1, 0), images::Rgb(31.0, 41.0, 51.0));
    EXPECT_EQ(gloss.layers.size(), 2u);
    EXPECT_FALSE(gloss.film);
    EXPECT_EQ(error_of_reading(path),
              "has no R, G and B outside layers; choose one of its layers: View.Diffuse, View.Gloss");
    const std::string none = error_of<ImageError>([&] { images::read_exr(path, "Gloss"); });
    EXPECT_NE(
        none.find("has no layer Gloss of R, G and B; choose one of its layers: View.Diffuse, View."),
        std::string::npos)
        << none;
}

TEST(ForeignExr, DeepDataAreRefused)
{
    const TemporaryFolder folder;
    Imf::Header deep = header(Imf::FLOAT, Imf::ZIPS_COMPRESSION);
    deep.setType(Imf::DEEPSCANLINE);
    Imf::DeepScanLineOutputFile((folder / "deep.exr").c_str(), deep);
    EXPECT_EQ(error_of_reading(folder / "deep.exr"), "holds deep data; only flat pictures can be read");
}

TEST(ForeignExr, AnIncompleteStateIsAnErrorAndNoStateIsAllowed)
{
    const TemporaryFolder folder;
    Imf::Header partial = header(Imf::FLOAT);
    partial.channels().insert("state.000.mean.R.hi", Imf::Channel(Imf::UINT));
    write_scan_lines<float>(folder / "a.exr", Imf::FLOAT, partial);
    EXPECT_EQ(images::read_exr(folder / "a.exr").no_state, "holds no state to go on from");

    partial.insert("plumblineBatchRange", Imf::StringAttribute("3..2"));
    write_scan_lines<float>(folder / "a.exr", Imf::FLOAT, partial);
    EXPECT_EQ(error_of_reading(folder / "a.exr"), "'3..2' is no range of batches");

    partial.insert("plumblineBatchRange", Imf::StringAttribute("2..3"));
    write_scan_lines<float>(folder / "a.exr", Imf::FLOAT, partial);
    EXPECT_EQ(error_of_reading(folder / "a.exr"), "has no channel state.000.mean.R.lo");

    partial.channels().insert("state.000.mean.R.lo", Imf::Channel(Imf::FLOAT));
    write_scan_lines<float>(folder / "a.exr", Imf::FLOAT, partial);
    EXPECT_EQ(error_of_reading(folder / "a.exr"), "channel state.000.mean.R.lo is not of type UINT");
}

} // namespace
