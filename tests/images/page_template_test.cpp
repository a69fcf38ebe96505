// Text, data and marks in HTML pages, and pictures as text.

#include "images/base64.h"
#include "images/page_template.h"

#include <gtest/gtest.h>

#include <array>

namespace {

TEST(Base64, FollowsTheExamplesOfTheStandard) // [RFC 4648, sec. 10]
{
    EXPECT_EQ(images::base64(""), "");
    EXPECT_EQ(images::base64("f"), "Zg==");
    EXPECT_EQ(images::base64("fo"), "Zm8=");
    EXPECT_EQ(images::base64("foo"), "Zm9v");
    EXPECT_EQ(images::base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(images::base64("\xff\xff\xfe"), "///+");
}

TEST(PageTemplate, TextCannotBeginATagOrAnEntity)
{
    EXPECT_EQ(images::html_text("a < b & c > d"), "a &lt; b &amp; c &gt; d");
}

TEST(PageTemplate, DataCannotEndTheScriptElement)
{
    EXPECT_EQ(images::script_data(R"({"a":"</script><b>"})"), R"({"a":"\u003c/script>\u003cb>"})");
}

TEST(PageTemplate, MarksAreReplacedOnceAndOtherSignsStay)
{
    const std::array<images::Mark, 2> marks = {{{"@A@", "1 @B@"}, {"@B@", "2"}}};
    EXPECT_EQ(images::fill("@A@ @B@ @A@@B@ a@b.org @C@ @", marks), "1 @B@ 2 1 @B@2 a@b.org @C@ @");
    EXPECT_EQ(images::fill("", marks), "");
}

} // namespace
