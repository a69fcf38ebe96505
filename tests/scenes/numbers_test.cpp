#include "scenes/collada/numbers.h"

#include "scenes/read_scene.h"
#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <locale>

namespace {

using scenes::collada::Document;

std::string error_from(const std::string& text, void (*read)(const scenes::collada::Element&))
{
    const Document document("<v>" + text + "</v>", "n.xml");
    try {
        read(document.root());
    } catch (const scenes::SceneError& error) {
        return error.what();
    }
    return "";
}

std::string error_from_numbers(const std::string& text)
{
    return error_from(text, [](const scenes::collada::Element& e) { scenes::collada::numbers(e); });
}

std::string error_from_indices(const std::string& text)
{
    return error_from(text, [](const scenes::collada::Element& e) { scenes::collada::indices(e); });
}

RC_GTEST_PROP(Numbers, EveryFiniteDoubleReadsBackExactly, ())
{
    const auto values = *rc::gen::container<std::vector<double>>(
        rc::gen::suchThat(rc::gen::map(rc::gen::arbitrary<std::uint64_t>(),
                                       [](std::uint64_t bits) { return std::bit_cast<double>(bits); }),
                          [](double value) { return std::isfinite(value); }));
    const char* const gaps[] = {" ", "\n", "\t ", "\r\n", "<!-- 7 --> "};
    std::string text;
    for (const double value : values)
        text += transport_test::exactly(value) + gaps[*rc::gen::inRange(0, 5)];
    const Document document("<v>" + text + "</v>", "n.xml");
    RC_ASSERT(scenes::collada::numbers(document.root()) == values);
}

RC_GTEST_PROP(Numbers, EveryIndexReadsBackExactly, (const std::vector<std::uint32_t>& values))
{
    std::string text;
    for (const std::uint32_t value : values) text += std::to_string(value) + "\n";
    const Document document("<v>" + text + "</v>", "n.xml");
    RC_ASSERT(scenes::collada::indices(document.root()) == values);
}

TEST(Numbers, APlusSignIsPartOfANumber)
{
    const Document document("<v>+1.5 +2 -3 +1e+2</v>", "n.xml");
    EXPECT_EQ(scenes::collada::numbers(document.root()), (std::vector<double>{1.5, 2, -3, 100}));
}

TEST(Numbers, TextGoesOnBehindACommentAndIntoCdata)
{
    const Document document("<v>1<!-- 5 -->2 <![CDATA[3 4]]></v>", "n.xml");
    EXPECT_EQ(scenes::collada::numbers(document.root()), (std::vector<double>{12, 3, 4}));
}

struct CommaForPoint : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
};

TEST(Numbers, TheLocaleHasNoSay)
{
    const std::locale before = std::locale::global(std::locale(std::locale(), new CommaForPoint));
    const Document document("<v>1.25</v>", "n.xml");
    const std::vector<double> values = scenes::collada::numbers(document.root());
    const std::string comma = error_from_numbers("1,25");
    std::locale::global(before);
    EXPECT_EQ(values, std::vector<double>{1.25});
    EXPECT_EQ(comma, "n.xml:1: <v>: \"1,25\" is not a number");
}

TEST(Numbers, WhatIsNotAFiniteNumberIsRefused)
{
    for (const char* text :
         {"1 two 3", "1.2.3", "1e", "0x10", "--1", "+-1", "+", "-", ".", "1 2,", "1d0", "e5", "1_000"})
        EXPECT_NE(error_from_numbers(text).find("is not a number"), std::string::npos) << text;
    for (const char* text : {"nan", "NaN", "-nan", "inf", "-INF", "+inf", "infinity", "nan(1)"})
        EXPECT_NE(error_from_numbers(text).find("is not a finite number"), std::string::npos) << text;
    for (const char* text : {"1e309", "-1e999", "1e-999"})
        EXPECT_NE(error_from_numbers(text).find("is out of the range"), std::string::npos) << text;
}

TEST(Numbers, WhatIsNotAnIndexIsRefused)
{
    EXPECT_EQ(error_from_indices("1 -2"), "n.xml:1: <v>: \"-2\" is negative");
    EXPECT_EQ(error_from_indices("4294967296"), "n.xml:1: <v>: \"4294967296\" is too large");
    for (const char* text : {"1.0", "1e3", "+1", "0x1", "one", "-"})
        EXPECT_NE(error_from_indices(text).find("is not a whole number"), std::string::npos) << text;
}

TEST(Numbers, AnElementAmongNumbersIsRefused)
{
    EXPECT_EQ(error_from_numbers("1 <b>2</b> 3"), "n.xml:1: <b>: not known inside <v>");
}

} // namespace
