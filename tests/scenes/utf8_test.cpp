#include "scenes/collada/utf8.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace {

using scenes::collada::first_bad_byte;

/// UTF-8 by its definition: six bits a byte from the end [Unicode 15, table 3-6].
std::string encode(std::uint32_t code)
{
    const auto byte = [](std::uint32_t bits) {
        return static_cast<char>(static_cast<unsigned char>(bits));
    };
    const auto tail = [&](std::uint32_t shift) { return byte(0x80U | ((code >> shift) & 0x3FU)); };
    if (code < 0x80) return {byte(code)};
    if (code < 0x800) return {byte(0xC0U | (code >> 6U)), tail(0)};
    if (code < 0x10000) return {byte(0xE0U | (code >> 12U)), tail(6), tail(0)};
    return {byte(0xF0U | (code >> 18U)), tail(12), tail(6), tail(0)};
}

TEST(Utf8, EveryCodePointIsTextButSurrogatesAndControlCharacters)
{
    for (std::uint32_t code = 0; code < 0x200000; ++code) {
        const bool control = code < 0x20 && code != '\t' && code != '\n' && code != '\r';
        const bool surrogate = code >= 0xD800 && code < 0xE000;
        const bool is_text = !control && !surrogate && code <= 0x10FFFF;
        const std::string bytes = encode(code) + "x";
        ASSERT_EQ(first_bad_byte(bytes), is_text ? bytes.size() : 0) << "code point " << code;
    }
}

TEST(Utf8, ASequenceThatIsTooLongForItsCodePointIsBad)
{
    for (const std::string_view bytes : {"\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xE0\x9F\xBF",
                                         "\xF0\x80\x80\x80", "\xF0\x8F\xBF\xBF"})
        EXPECT_EQ(first_bad_byte(bytes), 0);
}

TEST(Utf8, ATruncatedSequenceIsBadWhereItBegins)
{
    const std::string good = "ab\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80";
    EXPECT_EQ(first_bad_byte(good), good.size());
    EXPECT_EQ(first_bad_byte(good.substr(0, 3)), 2);
    EXPECT_EQ(first_bad_byte(good.substr(0, 6)), 4);
    EXPECT_EQ(first_bad_byte(good.substr(0, 10)), 7);
    EXPECT_EQ(first_bad_byte("a\xE2\x82"
                             "b"),
              1);
    EXPECT_EQ(first_bad_byte("\x80"), 0);
    EXPECT_EQ(first_bad_byte(""), 0);
}

} // namespace
