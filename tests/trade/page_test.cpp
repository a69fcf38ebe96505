// The page as text.

#include "tests/page_text.h"
#include "tests/trade/sample_results.h"
#include "trade/page.h"

#include <gtest/gtest.h>

namespace {

using namespace trade_test;
using namespace page_text;

TEST(TradePage, NamesNoOtherFiles)
{
    const std::string page = trade::page(sample_results());
    EXPECT_GT(markup(page).size(), 2000u);
    EXPECT_EQ(reference_to_a_file(page), "");
}

TEST(TradePage, HoldsTheDataAsTheyAre)
{
    const Json results = sample_results();
    EXPECT_EQ(data_of(trade::page(results)), results);
}

TEST(TradePage, EveryMarkIsFilled)
{
    const std::string page = trade::page(sample_results());
    EXPECT_EQ(unfilled_mark(page), "");
    EXPECT_NE(page.find("Michael Bostock"), std::string::npos); // the licence of D3 asks for it
}

TEST(TradePage, NamesCannotBecomeTags)
{
    const std::string evil = "</script><b>&<!--";
    Json results = sample_results();
    results["scene"]["name"] = evil;
    results["configurations"][1]["name"] = evil;
    results["knobs"][0]["what"] = evil;
    const std::string page = trade::page(results);
    EXPECT_EQ(page.find(evil), std::string::npos);
    EXPECT_EQ(count(page, "</script>"), count(trade::page(sample_results()), "</script>"));
    EXPECT_NE(page.find("<title>Speed against accuracy: &lt;/script&gt;&lt;b&gt;&amp;&lt;!--</title>"),
              std::string::npos);
    EXPECT_EQ(data_of(page), results);
}

TEST(TradePage, AcceptsAlmostNothingAndBytesThatAreNotText)
{
    EXPECT_NE(trade::page(Json::object()).find("<title>Speed against accuracy</title>"),
              std::string::npos);
    EXPECT_EQ(data_of(trade::page({{"scene", {{"name", nullptr}}}})).size(), 1u);
    Json results = sample_results();
    results["configurations"][2]["command"] = "plumbline render \xff.dae";
    EXPECT_EQ(data_of(trade::page(results))["configurations"][2]["command"],
              "plumbline render \xef\xbf\xbd.dae");
}

} // namespace
