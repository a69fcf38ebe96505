// Files that were cut short or altered: each gives a picture or an error message of one line.

#include "images/exr.h"
#include "images/image_error.h"
#include "tests/images/foreign_exr.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <sys/resource.h>

#include <algorithm>

namespace {

using images::Image;
using images::ImageError;
using namespace images_test;

/// A small file of ours that uses every feature of the format that we write.
const std::string& sound_file()
{
    static const std::string bytes = [] {
        const TemporaryFolder folder;
        Image image(9, 35); // three blocks of ZIP's 16 rows
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = images::Rgb(1.0 / static_cast<double>(i + 1), static_cast<double>(i), 0.5);
        images::write_exr(folder / "a.exr", film_of(image), {{"scene", "cornell"}}, {{"s1t2", image}});
        return read_bytes(folder / "a.exr");
    }();
    return bytes;
}

/// The error message of the reader for these bytes; empty if it reads a picture.
std::string verdict(const std::string& bytes)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a.exr", bytes);
    const std::string error = error_of<ImageError>([&] { images::read_exr(folder / "a.exr"); });
    if (error.empty()) return error;
    const std::string prefix = (folder / "a.exr").string() + ": ";
    EXPECT_EQ(error.substr(0, prefix.size()), prefix);
    EXPECT_TRUE(std::all_of(error.begin(), error.end(), [](unsigned char c) { return c >= ' '; }))
        << error;
    return error.substr(std::min(error.size(), prefix.size()));
}

TEST(DamagedExr, TheSoundFileIsRead)
{
    EXPECT_EQ(verdict(sound_file()), "");
}

TEST(DamagedExr, WhatIsNoExrIsCalledSo)
{
    EXPECT_EQ(verdict(""), "not an OpenEXR file");
    EXPECT_EQ(verdict("v/1"), "not an OpenEXR file");
    EXPECT_EQ(verdict("\x89PNG\r\n\x1a\n0000000000000000000000"), "not an OpenEXR file");
}

TEST(DamagedExr, EveryTruncationIsAnError)
{
    const std::string& sound = sound_file();
    // Every length within the header, where the format is intricate, and one in seven of the others.
    for (std::size_t length = 0; length < sound.size(); length += length < 1500 ? 1 : 7)
        EXPECT_NE(verdict(sound.substr(0, length)), "") << length << " of " << sound.size() << " bytes";
    EXPECT_NE(verdict(sound.substr(0, sound.size() - 1)), "");
}

TEST(DamagedExr, AHeaderThatClaimsAnAbsurdSizeIsRefusedBeforeMemoryIsAskedFor)
{
    const auto with_corner = [](std::int32_t x, std::int32_t y) {
        std::string bytes = sound_file();
        for (const char* name : {"dataWindow", "displayWindow"}) {
            // name, zero, "box2i", zero, size (4 bytes), then x_min, y_min, x_max, y_max
            const std::size_t corner = bytes.find(name) + std::string(name).size() + 1 + 6 + 4 + 8;
            for (unsigned i = 0; i < 4; ++i) {
                bytes[corner + i] = static_cast<char>(static_cast<std::uint32_t>(x) >> (8 * i));
                bytes[corner + 4 + i] = static_cast<char>(static_cast<std::uint32_t>(y) >> (8 * i));
            }
        }
        return verdict(bytes);
    };
    ASSERT_EQ(with_corner(8, 34), ""); // the true corner: the edit reaches the right bytes
    EXPECT_EQ(with_corner(100'000, 34), "absurd size 100001x35");
    EXPECT_NE(with_corner(30'000, 34).find("cannot hold 30001x35 pixels"), std::string::npos);
    EXPECT_NE(with_corner(1'000'000'000, 34), "");
    EXPECT_NE(with_corner(8, 1'000'000'000), "");
    EXPECT_NE(with_corner(-1, 34), "");
}

/// Small files of other programs: tiles of several levels; several parts; other windows and primaries.
const std::vector<std::string>& foreign_files()
{
    static const std::vector<std::string> files = [] {
        const TemporaryFolder folder;
        const Imath::Box2i display = box(-4, 3, 12, 20);
        const Imath::Box2i data = box(-2, 5, 14, 18);
        const std::vector<float> values(17 * 14, 0.5f);
        const ForeignChannels colours = {{"R", values}, {"G", values}, {"B", values}};
        std::vector<std::string> bytes;
        Imf::Header tiled(display, data);
        tiled.setTileDescription(Imf::TileDescription(4, 4, Imf::MIPMAP_LEVELS));
        {
            const ForeignPixels pixels(tiled, colours, Imf::FLOAT);
            Imf::TiledOutputFile file((folder / "a.exr").c_str(), tiled);
            file.setFrameBuffer(pixels.buffer);
            for (int i = 0; i < file.numLevels(); ++i)
                file.writeTiles(0, file.numXTiles(i) - 1, 0, file.numYTiles(i) - 1, i);
        }
        bytes.push_back(read_bytes(folder / "a.exr"));
        std::vector<Imf::Header> parts(2, Imf::Header(display, data));
        parts[0].setName("depth");
        parts[1].setName("colour");
        write_foreign_parts(folder / "a.exr", parts, {{{"Z", values}}, colours});
        bytes.push_back(read_bytes(folder / "a.exr"));
        Imf::Header other(display, data);
        other.insert("comments", Imf::StringAttribute("by another program"));
        Imf::addChromaticities(other, Imf::Chromaticities({0.7f, 0.3f}));
        write_foreign(folder / "a.exr", other, colours, Imf::HALF);
        bytes.push_back(read_bytes(folder / "a.exr"));
        return bytes;
    }();
    return files;
}

/// `bytes` with these words behind the name and the type of an attribute and its size, from word `first`
/// on; of two attributes of the name the last. Word -1 is the size.
std::string with_words(std::string bytes, const std::string& name_and_type, int first,
                       const std::vector<std::uint32_t>& words)
{
    std::size_t place = bytes.rfind(name_and_type + std::string(1, '\0'));
    EXPECT_NE(place, std::string::npos);
    place += name_and_type.size() + 1 + 4 + static_cast<std::size_t>(4 * first);
    for (const std::uint32_t word : words)
        for (unsigned i = 0; i < 4; ++i) bytes[place++] = static_cast<char>(word >> (8 * i));
    return bytes;
}

TEST(DamagedExr, NoStatedSizeMakesTheReaderAllocateMuch)
{
    using namespace std::string_literals;
    const std::string& tiles = foreign_files()[0];
    const std::string& parts = foreign_files()[1];
    const std::string& plain = foreign_files()[2];
    for (const std::string& file : foreign_files()) ASSERT_EQ(verdict(file), "");
    const auto peak = [] {
        rusage usage{};
        getrusage(RUSAGE_SELF, &usage);
        return usage.ru_maxrss; // KiB
    };
    const auto before = peak();
    const auto expect = [&](const std::string& bytes, const std::string& part) {
        const std::string error = verdict(bytes);
        EXPECT_NE(error.find(part), std::string::npos) << error;
    };
    const std::string data = "dataWindow\0box2i"s;
    const std::string display = "displayWindow\0box2i"s;
    expect(with_words(plain, data, 2, {0x7fffffff, 0x7fffffff}), "absurd size 2147483650x2147483643");
    expect(with_words(plain, data, 0, {0x80000000, 0x80000000, 0x7fffffff, 0x7fffffff}),
           "absurd size 4294967296x4294967296");
    expect(with_words(plain, data, 2, {60000, 18}), "cannot hold 60003x14 pixels");
    expect(with_words(plain, data, 0, {5, 5, 4, 4}), "absurd size 0x0");
    expect(with_words(plain, display, 2, {0x7fffffff, 20}), "absurd size 2147483652x18");
    expect(with_words(plain, display, 2, {16000, 16000}), "absurd display window of 16005x15998 pixels");
    expect(with_words(plain, "comments\0string"s, -1, {0x7fffffff}),
           "attribute comments of 2147483647 bytes");
    expect(with_words(plain, "comments\0string"s, -1, {0xffffffff}),
           "attribute comments of 4294967295 bytes");
    expect(with_words(tiles, "tiles\0tiledesc"s, 0, {0x40000000, 0x40000000}),
           "absurd tiles of 1073741824x1073741824 pixels");
    expect(with_words(with_words(tiles, data, 0, {0, 0, 8000, 8000}), "tiles\0tiledesc"s, 0, {1, 1}),
           "cannot hold 8001x8001 pixels");
    expect(with_words(parts, "chunkCount\0int"s, 0, {0x7fffffff}), "cannot hold 17x14 pixels");
    expect(with_words(parts, "chunkCount\0int"s, 0, {0xffffffff}), "");
    EXPECT_LT(peak() - before, 100'000);
}

TEST(DamagedExr, ATruncatedForeignFileIsAnErrorOrLacksOnlyWhatIsNotRead)
{
    const TemporaryFolder folder;
    for (const std::string& file : foreign_files()) {
        write_bytes(folder / "whole.exr", file);
        const Image whole = images::read_exr(folder / "whole.exr").mean;
        std::size_t read = 0;
        for (std::size_t length = 0; length < file.size(); ++length) {
            if (!verdict(file.substr(0, length)).empty()) continue;
            write_bytes(folder / "cut.exr", file.substr(0, length));
            EXPECT_EQ(images::read_exr(folder / "cut.exr").mean, whole) << length;
            ++read;
        }
        // Coarser levels of tiles are behind the finest. Parts and scan lines end with the picture.
        EXPECT_EQ(read > 0, &file == foreign_files().data());
    }
}

RC_GTEST_PROP(DamagedExr, AlteredBytesNeverCrashTheReader, ())
{
    std::string bytes =
        *rc::gen::element(sound_file(), foreign_files()[0], foreign_files()[1], foreign_files()[2]);
    const int alterations = *rc::gen::inRange(1, 6);
    // Half of the changes hit the header: most of the file is compressed pixels.
    const std::size_t range = std::min(bytes.size(), *rc::gen::element<std::size_t>(1200, bytes.size()));
    for (int i = 0; i < alterations; ++i) {
        const auto place = *rc::gen::inRange<std::size_t>(0, range);
        bytes[place] = *rc::gen::resize(100, rc::gen::arbitrary<char>());
    }
    verdict(bytes);
}

} // namespace
