#include "extremes/results.h"
#include "tests/extremes/sample_walk.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace extremes {

using namespace extremes_test;

TEST(ExtremesResults, StateFirstFailuresAndSafeRanges)
{
    const Json json = sample_results();
    const Json& host = json.at("axes").at(0).at("methods").at(1);
    EXPECT_EQ(host.at("name"), "host");
    EXPECT_EQ(host.at("format"), "float");
    EXPECT_EQ(host.at("first_failures"), Json::parse(R"([{"kind":"leaked","below":null,"above":100.0},
                              {"kind":"refused","below":0.001,"above":null}])"));
    EXPECT_EQ(host.at("safe"), Json::parse("[0.01,10.0]"));
    EXPECT_EQ(host.at("points").at(0).at("refusal"), "size.dae: too small");
    EXPECT_EQ(host.at("points").at(0).at("errors"), 0);
    EXPECT_EQ(host.at("points").at(6).at("notice"), "a notice");
    const Json& limit = json.at("axes").at(0).at("limits").at(1);
    EXPECT_EQ(limit.at("bound"), Json::parse("[[1.0,1e-7],[10.0,1e-7]]"));
    EXPECT_EQ(limit.at("contradiction"), "");
}

TEST(ExtremesResults, ContradictionsNameAxisAndMethod)
{
    std::vector<WalkedAxis> walked = sample_walk();
    EXPECT_TRUE(contradictions(walked).empty());
    walked[0].axis.limits[1].safe = 100.0;
    ASSERT_EQ(contradictions(walked).size(), 1u);
    EXPECT_EQ(contradictions(walked)[0].find("size, host: "), 0u);
}

TEST(ExtremesResults, AreReadBackAsTheyWere)
{
    const Json json = sample_results();
    std::vector<WalkedAxis> empty = sample_walk();
    for (WalkedAxis& axis : empty)
        for (WalkedAxis::Of& of : axis.methods) of.points.clear();
    restore(Json::parse(json.dump()), sample_description(), empty);
    EXPECT_EQ(results(sample_description(), empty), json);
}

TEST(ExtremesResults, SayWhatWasNotWalkedAndTryItAgain)
{
    std::vector<WalkedAxis> walked = sample_walk();
    Point& last = walked[0].methods[0].points.back();
    Point point;
    point.parameter = last.parameter;
    point.not_walked = "needs 17 GiB";
    last = point;
    const Json json = results(sample_description(), walked);
    EXPECT_EQ(json.at("axes").at(0).at("methods").at(0).at("safe"), Json::parse("[0.001,100.0]"));
    EXPECT_NE(table(json).find("none; not walked at 1e+03: needs 17 GiB"), std::string::npos)
        << table(json);
    for (WalkedAxis& axis : walked)
        for (WalkedAxis::Of& of : axis.methods) of.points.clear();
    restore(json, sample_description(), walked);
    EXPECT_EQ(walked[0].methods[0].points.size(), 6u);
    EXPECT_EQ(walked[0].methods[1].points.size(), 7u);
}

TEST(ExtremesResults, OfSomethingElseAreRefused)
{
    std::vector<WalkedAxis> walked = sample_walk();
    const auto refuse = [&](const Json& json) {
        EXPECT_THROW(restore(json, sample_description(), walked), std::invalid_argument) << json;
    };
    refuse(Json::array());
    refuse({{"format", "plumbline trade 1"}});
    for (const char* key : {"program", "cases", "seed"}) {
        Json json = sample_results();
        json[key] = "other";
        refuse(json);
    }
    Json json = sample_results();
    json["axes"][0]["methods"][0]["points"][0]["failures"]["melted"] = 3;
    refuse(json);
    json["axes"][0]["methods"][0]["points"][0] = 7;
    refuse(json);
}

TEST(ExtremesResults, TheTableNamesMethodsFailuresAndLimits)
{
    const std::string text = table(sample_results());
    for (const char* part :
         {"1 size: Size of a scene (size, in metres)", "leaked at 100; refused at 0.001",
          "host is safe up to 10, because a reason", "0.01 to 10", "2 share"})
        EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
    EXPECT_EQ(text.find("CONTRADICTED"), std::string::npos);
}

TEST(ExtremesResults, MarkdownHasARowForEachLimitAndASectionForEachAxis)
{
    const std::string text = markdown(sample_results());
    EXPECT_EQ(text.find(limits_in_markdown(sample_results())), 0u);
    for (const char* part :
         {"| size | host | up to 10 | 1e-07 | leaked at 100 |\n", "## 1. Size of a scene (`size`)\n",
          "](../images/extremes_size.png)\n", "- **host** is safe up to 10, because a reason\n",
          "## 2. Share of something (`share`)\n"})
        EXPECT_NE(text.find(part), std::string::npos) << part << '\n' << text;
}

} // namespace extremes
