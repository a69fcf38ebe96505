#include "images/whole_number.h"

#include <gtest/gtest.h>

namespace {

using images::whole_number;

TEST(WholeNumber, IsDigitsAndNothingElse)
{
    EXPECT_EQ(whole_number("0"), 0u);
    EXPECT_EQ(whole_number("0042"), 42u);
    EXPECT_EQ(whole_number("18446744073709551615"), ~std::uint64_t{0});
    for (const char* text : {"", "-1", "+1", " 1", "1 ", "1.0", "1e3", "0x10", "18446744073709551616"})
        EXPECT_FALSE(whole_number(text)) << text;
}

} // namespace
