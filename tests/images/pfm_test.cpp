#include "images/image_error.h"
#include "images/pfm.h"
#include "tests/images/picture_generators.h"
#include "tests/images/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstdlib>
#include <string>

namespace {

using images::Image;
using images::ImageError;
using images::Rgb;
using namespace images_test;
using namespace std::string_literals;

std::string error_of_reading(const std::string& bytes)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a.pfm", bytes);
    return error_of<ImageError>([&] { images::read_pfm(folder / "a.pfm"); });
}

RC_GTEST_PROP(Pfm, EveryFloatSurvivesARoundTrip, ())
{
    const TemporaryFolder folder;
    const Image image = any_image(any_float());
    images::write_pfm(folder / "a.pfm", image);
    RC_ASSERT(same_values(images::read_pfm(folder / "a.pfm"), image));
}

TEST(Pfm, TheBottomRowComesFirstAndBytesAreLittleEndian)
{
    const TemporaryFolder folder;
    Image image(1, 2);
    image.at(0, 0) = Rgb(1.0, 2.0, 3.0);  // 0x3f800000, 0x40000000, 0x40400000
    image.at(0, 1) = Rgb(0.5, 0.0, -1.0); // 0x3f000000, 0, 0xbf800000
    images::write_pfm(folder / "a.pfm", image);
    EXPECT_EQ(read_bytes(folder / "a.pfm"), "PF\n1 2\n-1.0\n"
                                            "\0\0\0\x3f\0\0\0\0\0\0\x80\xbf"
                                            "\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40"s);
}

TEST(Pfm, BigEndianAndGreyFilesAreRead)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a.pfm", "Pf 2\t1\r\n1.0\n\x3f\x80\0\0\x40\0\0\0"s);
    const Image image = images::read_pfm(folder / "a.pfm");
    ASSERT_EQ(image.width, 2);
    ASSERT_EQ(image.height, 1);
    EXPECT_EQ(image.at(0, 0), Rgb(1.0));
    EXPECT_EQ(image.at(1, 0), Rgb(2.0));
}

TEST(Pfm, ValuesAreTimesTheSizeOfTheScale)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a.pfm", "Pf\n2 1\n0.5\n\x3f\x80\0\0\x40\0\0\0"s);
    EXPECT_EQ(images::read_pfm(folder / "a.pfm").at(0, 0), Rgb(0.5));
    EXPECT_EQ(images::read_pfm(folder / "a.pfm").at(1, 0), Rgb(1.0));
    write_bytes(folder / "a.pfm", "PF\n1 1\n-2.5e1\n\0\0\x80\x3f\0\0\0\x40\0\0\x80\xbf"s);
    EXPECT_EQ(images::read_pfm(folder / "a.pfm").at(0, 0), Rgb(25.0, 50.0, -25.0));
}

TEST(Pfm, AFirstPixelThatLooksLikeWhiteSpaceBelongsToThePixels)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a.pfm", "Pf\n1 1\n-1\n\n\n\n\n"s);
    EXPECT_EQ(images::read_pfm(folder / "a.pfm").at(0, 0).r,
              static_cast<double>(std::bit_cast<float>(0x0a0a0a0au)));
}

TEST(Pfm, MalformedFilesAreErrorsThatSayWhatIsWrong)
{
    const std::string pixel(12, '\0');
    const auto expect = [](const std::string& bytes, const std::string& part) {
        const std::string error = error_of_reading(bytes);
        EXPECT_NE(error.find("a.pfm: "), std::string::npos) << bytes;
        EXPECT_NE(error.find(part), std::string::npos) << "'" << error << "' should contain " << part;
        EXPECT_EQ(error.find('\n'), std::string::npos);
    };
    expect("", "does not begin with PF");
    expect("P6\n1 1\n255\n" + pixel, "does not begin with PF");
    expect("PFX\n1 1\n-1\n" + pixel, "does not begin with PF");
    expect("PF", "header is not complete");
    expect("PF\n1 1", "header is not complete");
    expect("PF\n1 1\n-1", "header is not complete");
    expect("PF\n" + std::string(100, '1'), "header is not complete");
    expect("PF\n1x 1\n-1\n" + pixel, "'1x' in the PFM header is no number");
    expect("PF\n1 1\n-1.0f\n" + pixel, "'-1.0f' in the PFM header is no number");
    expect("PF\n99999999999 1\n-1\n" + pixel, "is no number");
    expect("PF\n0 1\n-1\n", "absurd size 0x1");
    expect("PF\n-1 1\n-1\n" + pixel, "absurd size -1x1");
    expect("PF\n1000000000 1\n-1\n" + pixel, "absurd size 1000000000x1");
    expect("PF\n65536 65536\n-1\n" + pixel, "absurd size 65536x65536");
    expect("PF\n65536 4096\n-1\n" + pixel, "truncated: 12 bytes of pixels instead of 3221225472");
    expect("PF\n1 1\n0\n" + pixel, "scale is 0, and must be a finite number other than 0");
    expect("PF\n1 1\nnan\n" + pixel, "scale is nan, and must be a finite number other than 0");
    expect("PF\n1 1\n-1\n" + pixel.substr(1), "truncated: 11 bytes");
    expect("PF\n1 1\n-1\n" + pixel + " ", "too long: 13 bytes");
}

RC_GTEST_PROP(Pfm, ArbitraryBytesNeverCrashTheReader, ())
{
    std::string bytes = *rc::gen::element("PF\n2 1\n-1\n"s, "Pf 1 1 1 "s, ""s);
    bytes += *rc::gen::arbitrary<std::string>();
    const auto flip = *rc::gen::inRange<std::size_t>(0, bytes.size() + 1);
    if (flip < bytes.size()) bytes[flip] = *rc::gen::arbitrary<char>();
    const TemporaryFolder folder;
    write_bytes(folder / "a.pfm", bytes);
    try {
        const Image image = images::read_pfm(folder / "a.pfm");
        RC_ASSERT(image.pixels.size() * 4 <= bytes.size());
    } catch (const ImageError&) {
        // Bytes that are no picture are refused.
    }
}

TEST(Pfm, ThePictureOfAnotherRendererIsRead)
{
    const char* const named = std::getenv("PLUMBLINE_SHARED");
    const std::filesystem::path shared =
        named != nullptr ? named : std::filesystem::path(PLUMBLINE_SOURCE_DIR).parent_path() / "shared";
    const auto path = shared / "pbrt" / "CBspheres_lambertian_a6.pfm";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const Image image = images::read_pfm(path);
    EXPECT_EQ(image.width, 240);
    EXPECT_EQ(image.height, 160);
    Rgb sum(0.0);
    for (const Rgb& pixel : image.pixels) sum += pixel;
    // The mean that its makers state, to the last digit given, with their error of 2e-5.
    const Rgb mean = sum / static_cast<double>(image.pixels.size());
    EXPECT_NEAR(mean.r, 0.10918, 2e-5);
    EXPECT_NEAR(mean.g, 0.08058, 2e-5);
    EXPECT_NEAR(mean.b, 0.10782, 2e-5);
}

} // namespace
