// The page as text.

#include "tests/trade/sample_results.h"
#include "trade/page.h"

#include <gtest/gtest.h>

#include <cctype>

namespace {

using namespace trade_test;

/// The page without the content of its scripts and comments: what the browser would look into for other
/// files.
std::string markup(const std::string& page)
{
    std::string out;
    std::size_t at = 0;
    while (at < page.size()) {
        const bool comment = page.compare(at, 4, "<!--") == 0;
        const bool script = page.compare(at, 7, "<script") == 0;
        if (!comment && !script) {
            out += page[at++];
            continue;
        }
        const std::string end = comment ? "-->" : "</script>";
        if (script) out += page.substr(at, page.find('>', at) + 1 - at);
        at = std::min(page.find(end, at), page.size() - end.size()) + end.size();
    }
    return out;
}

std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

Json data_of(const std::string& page)
{
    const std::string tag = R"(<script id="data" type="application/json">)";
    const std::size_t begin = page.find(tag) + tag.size();
    return Json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(TradePage, NamesNoOtherFiles)
{
    const std::string text = markup(trade::page(sample_results()));
    EXPECT_GT(text.size(), 2000u);
    std::string plain; // in lower case, each white space a blank, none before "="
    for (const char c : text) {
        const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
        while (c == '=' && plain.ends_with(' ')) plain.pop_back();
        plain += blank ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    for (const char* reference : {" src=", " href=", " srcset=", " action=", " data=", " poster=",
                                  "<link", "<base", "<iframe", "<object", "<embed", "@import", "url("})
        EXPECT_EQ(plain.find(reference), std::string::npos) << reference;
    EXPECT_EQ(text.find("http"), std::string::npos);
}

TEST(TradePage, HoldsTheDataAsTheyAre)
{
    const Json results = sample_results();
    EXPECT_EQ(data_of(trade::page(results)), results);
}

TEST(TradePage, EveryMarkIsFilled)
{
    const std::string page = trade::page(sample_results());
    const std::string capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    for (std::size_t at = page.find('@'); at != std::string::npos; at = page.find('@', at + 1)) {
        const std::size_t end = page.find_first_not_of(capitals, at + 1);
        EXPECT_FALSE(end != std::string::npos && end > at + 1 && page[end] == '@')
            << page.substr(at, end - at + 1);
    }
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
