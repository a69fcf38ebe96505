#include "images/base64.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <stdexcept>

namespace {

// The examples of RFC 4648, section 10.
TEST(Base64, IsThatOfTheStandard)
{
    EXPECT_EQ(images::base64(""), "");
    EXPECT_EQ(images::base64("f"), "Zg==");
    EXPECT_EQ(images::base64("fo"), "Zm8=");
    EXPECT_EQ(images::base64("foo"), "Zm9v");
    EXPECT_EQ(images::base64("foobar"), "Zm9vYmFy");
}

RC_GTEST_PROP(Base64, GivesTheBytesBack, (const std::string& bytes))
{
    RC_ASSERT(images::from_base64(images::base64(bytes)) == bytes);
}

TEST(Base64, RefusesOtherTexts)
{
    for (const char* text : {"Zg=", "Zg", "Z===", "Zg==Zg==", "Z*==", "=g==", "Zm 9"})
        EXPECT_THROW(images::from_base64(text), std::invalid_argument) << text;
}

} // namespace
