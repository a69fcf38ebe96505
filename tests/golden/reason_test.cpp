// The possible causes that are stated for a FAIL.

#include "golden/reason.h"
#include "tests/golden/simulated_golden.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace {

using golden::Comparison;
using images::Image;
using images::Metadata;
using images::Rgb;

class Reason : public golden_test::SimulatedGolden {
protected:
    static golden::Golden six_edges()
    {
        golden::Golden golden = reference();
        golden.metadata["max_edges"] = "6";
        return golden;
    }
    static std::string causes(const Image& image, const Metadata& candidate = {})
    {
        const golden::Golden golden = six_edges();
        const Comparison result = golden::compare_picture(golden, image, 1024.0);
        EXPECT_EQ(result.verdict, golden::Verdict::fail) << result.reason;
        return say_possible_causes(result, golden, candidate, image);
    }
};

TEST_F(Reason, OfABrighterPictureMayBeLongerPaths)
{
    const Image bright = picture(256, 7, {.everywhere = 1.125});
    EXPECT_NE(causes(bright).find("The golden's paths have at most 6 edges"), std::string::npos)
        << causes(bright);
    // A candidate whose metadata states its path length was already checked for it.
    EXPECT_EQ(causes(bright, {{"max_edges", "6"}}).find("edges"), std::string::npos);
    EXPECT_EQ(causes(picture(256, 7, {.everywhere = 0.9})).find("edges"), std::string::npos);
}

TEST_F(Reason, OfTheSameFactorEverywhereMayBeTheExposure)
{
    const std::string exposure = "the same factor everywhere";
    EXPECT_NE(causes(picture(256, 7, {.everywhere = 0.5})).find(exposure), std::string::npos);
    // A picture of few samples: each single tile may be right.
    const Image noisy = picture(1, 7, {.everywhere = 0.7});
    const golden::Golden golden = six_edges();
    const Comparison result = golden::compare_picture(golden, noisy, 4.0);
    EXPECT_EQ(result.verdict, golden::Verdict::fail) << result.reason;
    EXPECT_EQ(say_possible_causes(result, golden, {}, noisy).find(exposure), std::string::npos);
    EXPECT_EQ(causes(picture(256, 7, {.everywhere = 0.0})).find(exposure), std::string::npos);
    EXPECT_EQ(causes(picture(256, 7, {.in_caustic = 0.5, .in_shadow = 2.0})).find(exposure),
              std::string::npos);
}

TEST_F(Reason, OfAPictureUpsideDownIsTheOrderOfItsRows)
{
    const Image image = picture(256, 7);
    Image turned = image;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) turned.at(x, y) = image.at(x, image.height - 1 - y);
    EXPECT_NE(causes(turned).find("upside down"), std::string::npos);
    EXPECT_EQ(causes(picture(256, 7, {.everywhere = 0.5})).find("upside down"), std::string::npos);
}

TEST_F(Reason, IsNotGivenForAPass)
{
    const Image image = picture(256, 7);
    const golden::Golden golden = six_edges();
    const Comparison result =
        golden::compare_picture(golden, image, 1024.0, golden_test::for_small_pictures());
    EXPECT_EQ(say_possible_causes(result, golden, {}, image), "");
}

TEST_F(Reason, IsUnderstoodWithoutTheDocumentation)
{
    const auto reason = [](double factor, std::uint64_t seed) {
        const Image image = picture(256, seed, {.everywhere = factor});
        return golden::compare_picture(six_edges(), image, 1024.0).reason;
    };
    const std::string wrong = reason(0.5, 7);
    EXPECT_EQ(wrong.find("The picture is wrong: "), 0U) << wrong;
    EXPECT_NE(wrong.find("p < 1e-300. A right picture differs so much with a chance below 1e-08."),
              std::string::npos)
        << wrong;
    for (const char* jargon : {"matched", "plain", "bounded", "certainty level", "p = 0,"})
        EXPECT_EQ(wrong.find(jargon), std::string::npos) << wrong;
}

TEST(PlaceOfAFinding, IsNamedInWords)
{
    golden::Finding finding{};
    finding.channel = 1;
    const auto place = [&](golden::RegionKind kind) {
        finding.region = {kind, 2, 8, 16, 16, 24, 64};
        return describe_place(finding);
    };
    EXPECT_EQ(place(golden::RegionKind::whole), "green in the whole picture");
    EXPECT_EQ(place(golden::RegionKind::fine_tile), "green in the tile x 8..15, y 16..23");
    EXPECT_EQ(place(golden::RegionKind::luminance),
              "green in the pixels of luminance stratum 3 of 16 (1: the darkest)");
    EXPECT_EQ(place(golden::RegionKind::noise),
              "green in the pixels of noise stratum 3 of 16 (1: the least noise)");
}

} // namespace
