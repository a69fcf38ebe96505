// Data windows, tiles and parts of other programs' files.

#include "images/exr.h"
#include "images/image_error.h"
#include "tests/images/foreign_exr.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>

namespace {

using images::Image;
using images::Rgb;
using namespace images_test;

/// Red is 10 x + y of each pixel's place in the coordinates of the file, green and blue 1 and 2 more.
ForeignChannels places(const Imath::Box2i& data)
{
    ForeignChannels channels;
    for (int y = data.min.y; y <= data.max.y; ++y)
        for (int x = data.min.x; x <= data.max.x; ++x) {
            const auto value = static_cast<float>(10 * x + y);
            channels["R"].push_back(value);
            channels["G"].push_back(value + 1.0f);
            channels["B"].push_back(value + 2.0f);
        }
    return channels;
}

/// The picture in the `display` window of a file that has `data`.
Image displayed(const Imath::Box2i& display, const Imath::Box2i& data)
{
    Image image(display.max.x - display.min.x + 1, display.max.y - display.min.y + 1);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const Imath::V2i place(x + display.min.x, y + display.min.y);
            const double value = 10.0 * place.x + place.y;
            if (data.intersects(place)) image.at(x, y) = Rgb(value, value + 1.0, value + 2.0);
        }
    return image;
}

std::string error_of_file(const std::filesystem::path& path, const std::string& layer = "")
{
    const std::string error = error_of<images::ImageError>([&] { images::read_exr(path, layer); });
    EXPECT_EQ(error.find('\n'), std::string::npos);
    EXPECT_EQ(error.rfind(path.string() + ": ", 0), 0u) << error;
    return error.substr(std::min(error.size(), path.string().size() + 2));
}

TEST(ForeignExrWindow, ThePictureIsTheDisplayWindow)
{
    const TemporaryFolder folder;
    const Imath::Box2i display = box(10, 20, 16, 24);
    for (const Imath::Box2i& data : {
             box(10, 20, 16, 24), // the same
             box(12, 21, 13, 22), // a part
             box(5, 10, 30, 40),  // more than it, as with overscan
             box(8, 22, 12, 30),  // across its left and lower edge
             box(14, 15, 20, 20), // across its right and upper edge
         }) {
        write_foreign(folder / "a.exr", Imf::Header(display, data), places(data));
        EXPECT_EQ(images::read_exr(folder / "a.exr").mean, displayed(display, data))
            << data.min.x << ' ' << data.min.y << ' ' << data.max.x << ' ' << data.max.y;
    }
}

TEST(ForeignExrWindow, AWindowOutsideThePictureIsAnError)
{
    const TemporaryFolder folder;
    const Imath::Box2i data = box(7, 0, 9, 1);
    write_foreign(folder / "a.exr", Imf::Header(box(0, 0, 6, 4), data), places(data));
    EXPECT_EQ(
        error_of_file(folder / "a.exr"),
        "has no pixel in its display window: its data window is (7, 0) to (9, 1), its display window "
        "(0, 0) to (6, 4)");
}

TEST(ForeignExrWindow, TheFinestLevelOfTilesIsRead)
{
    const TemporaryFolder folder;
    const Imath::Box2i display = box(-3, -2, 12, 9);
    const Imath::Box2i data = box(-5, -2, 7, 8);
    for (const Imf::LevelMode mode : {Imf::ONE_LEVEL, Imf::MIPMAP_LEVELS, Imf::RIPMAP_LEVELS}) {
        Imf::Header header(display, data);
        header.setTileDescription(Imf::TileDescription(4, 3, mode));
        {
            const ForeignPixels pixels(header, places(data), Imf::HALF);
            Imf::TiledOutputFile file((folder / "a.exr").c_str(), header);
            file.setFrameBuffer(pixels.buffer); // coarser levels get the upper left corner: other values
            for (int j = 0; j < file.numYLevels(); ++j)
                for (int i = 0; i < file.numXLevels(); ++i)
                    if (mode == Imf::RIPMAP_LEVELS || i == j)
                        file.writeTiles(0, file.numXTiles(i) - 1, 0, file.numYTiles(j) - 1, i, j);
        }
        EXPECT_EQ(images::read_exr(folder / "a.exr").mean, displayed(display, data)) << mode;
    }
}

Imf::Header part(const std::string& name, const Imath::Box2i& display, const Imath::Box2i& data)
{
    Imf::Header header(display, data);
    header.setName(name);
    return header;
}

/// Channels with `prefix` before their names.
ForeignChannels in_layer(const std::string& prefix, const ForeignChannels& channels)
{
    ForeignChannels result;
    for (const auto& [name, values] : channels) result[prefix + name] = values;
    return result;
}

TEST(ForeignExrParts, TheFirstPartWithAPictureIsRead)
{
    const TemporaryFolder folder;
    const Imath::Box2i display = box(0, 0, 5, 3);
    const Imath::Box2i small = box(1, 1, 2, 2);
    const Imath::Box2i whole = box(0, 0, 5, 3);
    const std::vector<float> depth(24, 7.0f);
    write_foreign_parts(
        folder / "a.exr",
        {part("depth", display, whole), part("left", display, small), part("right", display, whole)},
        {{{"Z", depth}}, places(small), places(whole)});
    EXPECT_EQ(images::read_exr(folder / "a.exr").mean, displayed(display, small));
    // A part may be asked for by its name.
    EXPECT_EQ(images::read_exr(folder / "a.exr", "right").mean, displayed(display, whole));
    EXPECT_EQ(error_of_file(folder / "a.exr", "middle"),
              "has no layer middle of R, G and B; choose one of its layers: left, right");
}

TEST(ForeignExrParts, LayersOfAllPartsAreKnown)
{
    const TemporaryFolder folder;
    const Imath::Box2i display = box(0, 0, 5, 3);
    const ForeignChannels channels = places(display);
    const std::vector<float> depth(24, 7.0f);
    write_foreign_parts(folder / "one.exr", {part("a", display, display), part("b", display, display)},
                        {{{"Z", depth}}, in_layer("Beauty.", channels)});
    const images::ExrPicture picture = images::read_exr(folder / "one.exr");
    EXPECT_EQ(picture.mean, displayed(display, display));
    EXPECT_EQ(picture.layer, "Beauty");

    write_foreign_parts(folder / "two.exr", {part("a", display, display), part("b", display, display)},
                        {in_layer("Gloss.", channels), in_layer("Beauty.", channels)});
    EXPECT_EQ(error_of_file(folder / "two.exr"),
              "has no R, G and B outside layers; choose one of its layers: Gloss, Beauty");
    EXPECT_EQ(images::read_exr(folder / "two.exr", "Beauty").mean, displayed(display, display));

    write_foreign_parts(folder / "none.exr", {part("a", display, display), part("b", display, display)},
                        {{{"Z", depth}}, {{"A", depth}}});
    EXPECT_EQ(error_of_file(folder / "none.exr"), "has the channels Z, A; wanted: R, G, B, or Y");
}

} // namespace
