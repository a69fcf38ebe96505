// `plumbline extremes` walks the axes that it is told, keeps what it has done, and refuses bad input in
// one line.

#include "cuda/launch/device.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace {

using namespace cli_test;

TEST(ExtremesCommand, WritesResultsAndAPageAndPrintsATable)
{
    TemporaryFolder folder;
    const std::string json = (folder / "e.json").string();
    const std::string page = (folder / "e.html").string();
    const Outcome outcome = run(
        {"extremes", "ior", "--cases", "50", "-o", json, "--report", page, "--methods", "ref", "host"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("first failures"), std::string::npos);
    const auto results = nlohmann::json::parse(read_bytes(json));
    EXPECT_EQ(results.at("format"), "plumbline extremes 1");
    EXPECT_TRUE(results.at("complete"));
    ASSERT_EQ(results.at("axes").size(), 1U);
    EXPECT_EQ(results.at("axes").at(0).at("methods").size(), 2U);
    EXPECT_NE(read_bytes(page).find("<title>The extremes"), std::string::npos);

    const Outcome printed = run({"extremes", "ior", "--cases", "50", "--json", "-t", "1"});
    ASSERT_EQ(printed.status, 0) << printed.err;
    const auto again = nlohmann::json::parse(printed.out);
    EXPECT_EQ(again.at("axes").at(0).at("methods").at(0), results.at("axes").at(0).at("methods").at(0));
}

TEST(ExtremesCommand, AnAxisHasANameAndANumber)
{
    const Outcome by_number = run({"extremes", "8", "--list"});
    EXPECT_EQ(by_number.status, 0);
    EXPECT_NE(by_number.out.find("ior"), std::string::npos);
    EXPECT_EQ(by_number.out.find("gap"), std::string::npos);
    const Outcome all = run({"extremes", "--list"});
    EXPECT_NE(all.out.find("ior"), std::string::npos);
}

TEST(ExtremesCommand, KeepsWhatItHasDoneAndGoesOn)
{
    TemporaryFolder folder;
    const std::string json = (folder / "e.json").string();
    const std::string whole = (folder / "whole.json").string();
    const Arguments walk = {"extremes", "ior", "--methods", "ref", "--cases", "1000"};
    Process process(walk + Arguments{"-o", json});
    ASSERT_TRUE(eventually([&] { return process.catches(SIGINT); }));
    process.send(SIGINT);
    const Outcome stopped = process.finish();
    EXPECT_EQ(stopped.status, 130) << stopped.err;
    EXPECT_NE(stopped.err.find("--resume goes on from here"), std::string::npos) << stopped.err;
    EXPECT_FALSE(nlohmann::json::parse(read_bytes(json)).at("complete"));

    ASSERT_EQ(run(walk + Arguments{"-o", json, "--resume"}).status, 0);
    ASSERT_EQ(run(walk + Arguments{"-o", whole}).status, 0);
    EXPECT_EQ(nlohmann::json::parse(read_bytes(json)).at("axes"),
              nlohmann::json::parse(read_bytes(whole)).at("axes"));
}

/// A walk that is kept without what is 0 or empty, as in docs/results/.
TEST(ExtremesCommand, ShowsEarlierResultsWithoutAWalk)
{
    TemporaryFolder folder;
    const std::string json = (folder / "e.json").string();
    const std::string first = (folder / "first.html").string();
    const std::string second = (folder / "second.html").string();
    const Outcome walked =
        run({"extremes", "gap", "--cases", "3", "-o", json, "--report", first, "--markdown"});
    auto kept = nlohmann::ordered_json::parse(read_bytes(json));
    for (auto& method : kept.at("axes").at(0).at("methods")) {
        method = {{"name", method.at("name")}, {"points", method.at("points")}};
        for (auto& point : method.at("points"))
            for (const char* key : {"errors", "median", "largest", "failures", "not_walked"})
                if (point.at(key).empty() || point.at(key) == 0) point.erase(key);
    }
    write_bytes(json, kept.dump());
    const Outcome shown = run({"extremes", "--from", json, "--report", second, "--markdown"});
    EXPECT_EQ(shown.status, walked.status) << shown.err;
    EXPECT_EQ(shown.out, walked.out);
    EXPECT_NE(shown.out.find("(`gap`)"), std::string::npos);
    EXPECT_EQ(read_bytes(second), read_bytes(first));

    const std::string ior = (folder / "ior.json").string();
    ASSERT_EQ(run({"extremes", "ior", "--methods", "ref", "--cases", "3", "-q", "-o", ior}).status, 0);
    const Outcome both = run({"extremes", "--from", ior, json, "--markdown"});
    for (const char* name : {"(`gap`)", "(`ior`)"})
        EXPECT_NE(both.out.find(name), std::string::npos) << both.out;

    kept["program"] = "0.0.1";
    write_bytes(json, kept.dump());
    const Outcome versions = run({"extremes", "--from", ior, json, "--json"});
    EXPECT_EQ(nlohmann::json::parse(versions.out).at("program"),
              std::string(nlohmann::json::parse(read_bytes(ior)).at("program")) + ", 0.0.1");
    kept["cases"] = 4;
    write_bytes(json, kept.dump());
    EXPECT_NE(run({"extremes", "--from", ior, json}).err.find("its cases is 4, and not 3"),
              std::string::npos);
    kept["cases"] = 3;
    write_bytes(json, kept.dump());

    const Outcome other = run({"extremes", "ior", "--from", json});
    EXPECT_EQ(other.status, 2);
    EXPECT_NE(other.err.find("it has no point of these axes"), std::string::npos) << other.err;
    EXPECT_EQ(run({"extremes", "--from", json, "--resume"}).status, 2);
    write_bytes(json, "{}");
    const Outcome empty = run({"extremes", "--from", json});
    EXPECT_EQ(empty.status, 2);
    EXPECT_EQ(std::ranges::count(empty.err, '\n'), 1) << empty.err;
    EXPECT_NE(empty.err.find("--from " + json + ": it is no result"), std::string::npos) << empty.err;
}

struct BadExtremes {
    const char* name;
    Arguments more;
    const char* message; // a part of it
};

class ExtremesRefuses : public testing::TestWithParam<BadExtremes> {};

INSTANTIATE_TEST_SUITE_P(
    BadInput, ExtremesRefuses,
    testing::Values(BadExtremes{"UnknownAxis", {"depth-of-field"}, "no such axis"},
                    BadExtremes{"UnknownMethod", {"--methods", "magic"}, "no such method"},
                    BadExtremes{"NoCases", {"--cases", "0"}, "--cases"},
                    BadExtremes{"NoWord", {"--cases", "many"}, "--cases"},
                    BadExtremes{"UnwritableReport", {"--report", "/no/such/folder/e.html"}, "/no/such"},
                    BadExtremes{"UnwritableResults", {"-o", "/no/such/folder/e.json"}, "/no/such"},
                    BadExtremes{"ReportByAnotherName", {"--report", "e.txt"}, ".html"},
                    BadExtremes{"ResumeOfNothing", {"--resume"}, "--resume needs -o"}),
    [](const auto& bad) { return bad.param.name; });

TEST_P(ExtremesRefuses, InOneLineAndWritesNothing)
{
    const Outcome outcome = run(Arguments{"extremes"} + GetParam().more);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
}

TEST(ExtremesCommand, SaysWhyThereIsNoMethodOfAGpu)
{
    const fast::Device device = fast::find_device();
    if (device.usable) GTEST_SKIP() << "there is one: " << device.description;
    for (const char* method : {"cuda", "cuda, hploc63"}) {
        const Outcome outcome = run({"extremes", "tree-size", "--methods", method});
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(outcome.err, "plumbline: " + std::string(method) + ": no such method (" +
                                   device.description + ")\n");
    }
}

TEST(ExtremesCommand, RefusesResultsOfSomethingElse)
{
    TemporaryFolder folder;
    const std::string json = (folder / "e.json").string();
    write_bytes(json, "{\"format\": \"plumbline trade 1\"}");
    const Outcome outcome = run({"extremes", "ior", "-o", json, "--resume"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("its format is another one"), std::string::npos) << outcome.err;
    EXPECT_EQ(read_bytes(json), "{\"format\": \"plumbline trade 1\"}");
}

} // namespace
