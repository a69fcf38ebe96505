// Files that were cut short or altered: each gives a picture or an error message of one line.

#include "images/exr.h"
#include "images/image_error.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

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

RC_GTEST_PROP(DamagedExr, AlteredBytesNeverCrashTheReader, ())
{
    std::string bytes = sound_file();
    const int alterations = *rc::gen::inRange(1, 6);
    // Half of the changes hit the header: most of the file is compressed pixels.
    const std::size_t range = *rc::gen::element<std::size_t>(1200, bytes.size());
    for (int i = 0; i < alterations; ++i) {
        const auto place = *rc::gen::inRange<std::size_t>(0, range);
        bytes[place] = *rc::gen::resize(100, rc::gen::arbitrary<char>());
    }
    verdict(bytes);
}

} // namespace
