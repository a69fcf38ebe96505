// `plumbline trade` finds what is known: the bias of short paths, equal configurations, no bias where
// there is none; it can be interrupted and go on; and it refuses bad input in one line.

#include "golden/golden.h"
#include "images/exr.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

namespace {

using namespace cli_test;
using Json = nlohmann::json;

std::string golden_file(const std::string& scene)
{
    return (std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "golden" / "renders" / (scene + ".exr"))
        .string();
}

/// A study of a scene beside its golden.
Arguments trade(const std::string& scene, const Arguments& more)
{
    return Arguments{"trade", scene_file(scene), "--truth", golden_file(scene)} + more;
}

Json results_of(const Arguments& arguments)
{
    const Outcome outcome = run(arguments + Arguments{"--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(outcome.out);
}

const Json& configuration(const Json& results, const std::string& name)
{
    const Json& all = results.at("configurations");
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const Json& one) { return one.at("name") == name; });
    if (found == all.end()) throw std::runtime_error("no configuration " + name);
    return *found;
}

/// Whether a configuration is biased: "biased", "none found", "undecided", or why it was not measured. A
/// study marks a right configuration in one of 200 cases, too often for a test that is run every day. So
/// here it takes a p-value of 1e-7; the samples depend on the speed of the machine, and so does it.
std::string finding(const Json& one)
{
    if (!one.contains("bias")) return one.at("problem");
    if (one.at("bias").at("p").get<double>() < 1e-7) return "biased";
    const std::string verdict = one.at("bias").at("verdict");
    return verdict == "biased" ? "none found" : verdict;
}

/// The findings of a knob by value. A study of few seconds may have too few samples on a slow machine or
/// with sanitizers. So while one that must be `biased` is not yet found to be so, or one is undecided,
/// the study is made again with more time. That one is biased is final.
std::map<std::string, std::string> findings(const std::string& scene, const std::string& knob,
                                            const std::function<bool(const std::string&)>& biased)
{
    std::map<std::string, std::string> found;
    for (const char* seconds : {"3", "6", "24", "96"}) {
        const Json results =
            results_of(trade(scene, {"--seconds", seconds, "--rounds", "4", "--knobs", knob}));
        bool again = false;
        for (const Json& value : results.at("knobs").at(0).at("values")) {
            const std::string name = value.at("value");
            found[name] = finding(configuration(results, value.at("configuration")));
            again = again || found[name] != (biased(name) ? "biased" : "none found");
            if (found[name] == "biased" && !biased(name)) return found;
        }
        if (!again) break;
    }
    return found;
}

// In the integrating sphere a path of 2 + j edges adds rho^(1 + j) I / (pi R^2) everywhere, j > 0 (see
// the head of the scene). The golden has paths of up to 6 edges.
TEST(TradeCommand, FindsTheBiasOfShortPathsInTheIntegratingSphere)
{
    const golden::Golden golden = golden::read_golden(golden_file("integrating_sphere"));
    double all = 0.0;
    for (const images::Rgb& pixel : golden.mean.pixels)
        all += (pixel.x + pixel.y + pixel.z) / static_cast<double>(golden.mean.pixels.size());
    const std::array rho = {0.5, 0.8, 0.2};
    const std::array intensity = {0.8, 0.4, 1.2};
    const auto lost = [&](int max_edges) { // light of longer paths
        double sum = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            for (int j = max_edges - 1; j <= 4; ++j)
                sum += std::pow(rho[c], 1 + j) * intensity[c] / std::numbers::pi;
        return sum;
    };
    const Json results = results_of(
        trade("integrating_sphere", {"--seconds", "2", "--rounds", "4", "--knobs", "max-edges"}));
    for (const int edges : {2, 3, 4}) {
        const std::string name = "max-edges=" + std::to_string(edges);
        const Json& bias = configuration(results, name).at("bias");
        EXPECT_EQ(finding(configuration(results, name)), "biased") << name;
        const double value = bias.at("whole").at("value");
        const double half_width =
            (bias.at("whole").at("high").get<double>() - bias.at("whole").at("low").get<double>()) / 2;
        // Three times the half width of an interval of 95%: six standard errors.
        EXPECT_NEAR(value, -lost(edges) / all, 3.0 * half_width) << name;
        EXPECT_LT(half_width, 0.02) << name;
    }
    EXPECT_EQ(finding(configuration(results, "base")), "none found");
    // Longer than the truth: not measured.
    EXPECT_EQ(results.dump().find("max-edges=10"), std::string::npos);
}

// Uniform weights count strategies that cannot happen: through glass they lack light.
TEST(TradeCommand, FindsThatUniformWeightsAreBiasedWhereThereIsGlassOnly)
{
    const auto uniform = [](const char* scene, bool biased) {
        return findings(scene, "heuristic=uniform",
                        [&](const std::string& value) { return biased && value == "uniform"; });
    };
    using Findings = std::map<std::string, std::string>;
    EXPECT_EQ(uniform("cornell_glass", true),
              (Findings{{"balance", "none found"}, {"uniform", "biased"}}));
    EXPECT_EQ(uniform("cornell_diffuse", false),
              (Findings{{"balance", "none found"}, {"uniform", "none found"}}));
}

// A family that is left out takes its weighted layer with it: the picture is biased exactly where the
// layer is not black. Over a plane a point light is not hit, and nothing joins two points of the plane.
// In the sphere with a lamp each family carries much light: a family with little takes many seconds to
// miss.
TEST(TradeCommand, FindsWhichFamiliesCarryLight)
{
    TemporaryFolder folder;
    for (const char* scene : {"point_over_plane", "integrating_sphere_lamp"}) {
        const std::string layers = (folder / "layers.exr").string();
        ASSERT_EQ(run({"render", scene_file(scene), "-o", (folder / "a.exr").string(), "--strategies",
                       layers, "--integrator", "bdpt", "--max-edges", "6", "--size", "16x16", "-q"})
                      .status,
                  0);
        const images::Layers pictures = images::read_exr(layers).layers;
        const auto carries_light = [&](const std::string& family) {
            for (const auto& [layer, picture] : pictures) {
                int s = 0;
                int t = 0;
                if (std::sscanf(layer.c_str(), "s%dt%d", &s, &t) != 2) continue;
                const std::string of_layer = t == 1   ? "light_image"
                                             : s == 0 ? "emission_hit"
                                             : s == 1 ? "next_event"
                                                      : "inner_connection";
                if (of_layer == family && picture != images::Image(16, 16)) return true;
            }
            return false;
        };
        const auto found = findings(scene, "without", carries_light);
        for (const auto& [family, of_family] : found)
            EXPECT_EQ(of_family, carries_light(family) ? "biased" : "none found")
                << scene << " without " << family;
        EXPECT_EQ(found.size(), 5U); // with "nothing"
    }
}

// Over a plane no path has more than two edges.
TEST(TradeCommand, ListsWhatTheSceneRequiresAndMeasuresTheGainOfLeavingOutTheRest)
{
    const Json results =
        results_of(trade("area_light_over_plane", {"--needs", "--seconds", "2", "--rounds", "4"}));
    const auto row = [&](const std::string& what) {
        for (const Json& one : results.at("requirements"))
            if (one.at("what") == what) return one;
        throw std::runtime_error("no row " + what);
    };
    EXPECT_EQ(row("shapes").at("has"), "triangle");
    EXPECT_EQ(row("bsdfs").at("left_out"), "mirror, glass");
    EXPECT_EQ(row("strategies").at("has"), "emission_hit, next_event, light_image");
    EXPECT_EQ(row("path length").at("has"), "at most 2 edges");
    for (const char* what : {"kernels", "tree levels", "strategy inner_connection", "path length"}) {
        const Json gain = row(what).at("gain");
        ASSERT_TRUE(gain.is_object()) << what;
        EXPECT_LE(gain.at("low"), gain.at("value")) << what;
        EXPECT_GT(gain.at("value"), 0.2) << what;
        EXPECT_LT(gain.at("value"), 50.0) << what;
    }
    // To leave out what carries nothing changes nothing.
    for (const Json& one : results.at("configurations"))
        EXPECT_NE(finding(one), "biased") << one.at("name");
}

TEST(TradeCommand, StatesTimesMemoryAndCommandsOfEachConfiguration)
{
    const Json results =
        results_of(trade("cornell_diffuse", {"--seconds", "1.5", "--base", "max-edges=6", "--knobs",
                                             "instructions=best,baseline"}));
    const Json& base = configuration(results, "base");
    EXPECT_NE(finding(base), "biased");
    EXPECT_NE(base.at("command").get<std::string>().find("--max-edges 6"), std::string::npos);
    const Json& baseline = configuration(results, "instructions=baseline");
    // The instructions change no bit: in each round the same samples, in another time. The numbers of
    // batches differ with the time that they take.
    EXPECT_EQ(results.at("knobs").at(0).at("reference"), "base");
    EXPECT_NE(finding(baseline), "biased");
    EXPECT_GT(baseline.at("memory").at("value"), 1e6);
    for (const char* field : {"build", "render"})
        for (const char* clock : {"wall", "cpu"})
            EXPECT_LE(baseline.at(field).at(clock).at("low"), baseline.at(field).at(clock).at("high"));
}

TEST(TradeCommand, WritesResultsAndAPageAndPrintsATable)
{
    TemporaryFolder folder;
    const std::string json = (folder / "t.json").string();
    const std::string html = (folder / "t.html").string();
    const Outcome outcome =
        run(trade("furnace", {"--seconds", "0.5", "--rounds", "2", "--knobs", "threads=1,2",
                              "integrator=path", "-o", json, "--report", html}));
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("threads=2"), std::string::npos);
    EXPECT_NE(outcome.out.find("time to equal noise"), std::string::npos);
    const Json written = Json::parse(read_bytes(json));
    EXPECT_EQ(written.at("format"), "plumbline trade 1");
    EXPECT_TRUE(written.at("complete"));
    EXPECT_NE(read_bytes(html).find("threads=2"), std::string::npos);
    EXPECT_NE(written.at("command").get<std::string>().find("--rounds 2"), std::string::npos);

    const std::string again = (folder / "again.html").string();
    const Outcome shown = run({"trade", "--from", json, "--report", again});
    EXPECT_EQ(shown.status, 0) << shown.err;
    EXPECT_EQ(shown.out, outcome.out);
    EXPECT_EQ(read_bytes(again), read_bytes(html));
}

TEST(TradeCommand, RendersItsTruthOnceAndKeepsIt)
{
    TemporaryFolder folder;
    const std::string cache = (folder / "cache").string();
    const Arguments command = {
        "trade", scene_file("furnace"), "--size", "8x8",      "--cache", cache,     "--truth-seconds",
        "0.2",   "--seconds",           "0.3",    "--rounds", "2",       "--knobs", "threads=1"};
    ASSERT_EQ(run(command).status, 0);
    const auto first = std::filesystem::directory_iterator(cache);
    ASSERT_NE(first, std::filesystem::directory_iterator());
    const std::filesystem::path truth = first->path();
    const std::string bytes = read_bytes(truth);
    const auto time = std::filesystem::last_write_time(truth);
    ASSERT_EQ(run(command).status, 0);
    EXPECT_EQ(std::filesystem::last_write_time(truth), time);
    EXPECT_TRUE(read_bytes(truth) == bytes);
}

TEST(TradeCommand, KeepsAnUnfinishedTruthAndGoesOnWithIt)
{
    TemporaryFolder folder;
    const std::string cache = (folder / "cache").string();
    const Arguments command = {
        "trade", scene_file("furnace"), "--size", "8x8",      "--cache", cache,     "--truth-seconds",
        "3",     "--seconds",           "0.3",    "--rounds", "2",       "--knobs", "threads=1"};
    Process process(command);
    ASSERT_TRUE(eventually([&] { return process.catches(SIGINT) && process.used() > 60; })); // 0.6 s
    process.send(SIGINT);
    EXPECT_EQ(process.finish().status, 130);
    const std::filesystem::path truth = std::filesystem::directory_iterator(cache)->path();
    const images::ExrPicture unfinished = images::read_exr(truth);
    ASSERT_TRUE(unfinished.film);
    ASSERT_EQ(run(command).status, 0);
    const images::ExrPicture finished = images::read_exr(truth);
    EXPECT_FALSE(finished.film);
    EXPECT_EQ(finished.metadata.at("batch_size"), unfinished.metadata.at("batch_size"));
    EXPECT_EQ(finished.metadata.at("samples"),
              std::to_string(256 * std::stoi(unfinished.metadata.at("batch_size"))));
}

TEST(TradeCommand, KeepsWhatIsMeasuredAndGoesOn)
{
    TemporaryFolder folder;
    const std::string json = (folder / "t.json").string();
    const Arguments command =
        trade("furnace", {"--seconds", "4", "--rounds", "40", "--knobs", "threads=1,2", "-o", json});
    Process process(command);
    ASSERT_TRUE(eventually([&] {
        return std::filesystem::exists(json) &&
               Json::parse(read_bytes(json)).at("configurations").at(0).at("raw").size() >= 2;
    }));
    process.send(SIGINT);
    const Outcome stopped = process.finish();
    EXPECT_EQ(stopped.status, 130);
    EXPECT_NE(stopped.err.find("--resume goes on"), std::string::npos) << stopped.err;
    const Json before = Json::parse(read_bytes(json));
    EXPECT_FALSE(before.at("complete"));
    const std::size_t rounds = before.at("configurations").at(0).at("raw").size();
    ASSERT_GE(rounds, 2U);
    ASSERT_LT(rounds, 40U);

    const Outcome resumed = run(command + Arguments{"--resume"});
    ASSERT_EQ(resumed.status, 0) << resumed.err;
    const Json after = Json::parse(read_bytes(json));
    EXPECT_TRUE(after.at("complete"));
    const Json& raw = after.at("configurations").at(0).at("raw");
    EXPECT_EQ(raw.size(), 40U);
    for (std::size_t r = 0; r < rounds; ++r)
        EXPECT_EQ(raw.at(r), before.at("configurations").at(0).at("raw").at(r)) << r;
}

struct Bad {
    const char* name;
    Arguments more;
    const char* message; // a part of it
};

class TradeRefuses : public testing::TestWithParam<Bad> {};

const std::array bad_input = {
    Bad{"UnknownKnob", {"--knobs", "colour"}, "no such knob"},
    Bad{"EmptyValue", {"--knobs", "threads=1,,2"}, "empty value"},
    Bad{"EmptyList", {"--knobs", "threads="}, "empty value"},
    Bad{"KnobTwice", {"--knobs", "threads=1", "threads=2"}, "named twice"},
    Bad{"UnknownValue", {"--knobs", "integrator=magic"}, "magic"},
    Bad{"NoNumber", {"--knobs", "max-edges=many"}, "many"},
    Bad{"UnknownBase", {"--base", "colour=red"}, "colour"},
    Bad{"BaseWithoutValue", {"--base", "integrator"}, "OPTION=VALUE"},
    Bad{"NoTime", {"--seconds", "0"}, "--seconds"},
    Bad{"OneRound", {"--rounds", "1"}, "--rounds"},
    Bad{"NoWord", {"--seconds", "soon"}, "--seconds"},
    Bad{"UnwritableReport", {"--report", "/no/such/folder/t.html"}, "/no/such/folder"},
    Bad{"UnwritableResults", {"-o", "/no/such/folder/t.json"}, "/no/such/folder"},
    Bad{"ReportByAnotherName", {"--report", "t.txt"}, ".html"},
    Bad{"ResumeOfNothing", {"--resume"}, "--resume needs -o"},
    Bad{"SizeOfAnotherTruth", {"--size", "8x8"}, "size"},
};

INSTANTIATE_TEST_SUITE_P(BadInput, TradeRefuses, testing::ValuesIn(bad_input),
                         [](const auto& bad) { return bad.param.name; });

TEST_P(TradeRefuses, InOneLineAndWritesNothing)
{
    TemporaryFolder folder;
    const Outcome outcome = run(trade("furnace", GetParam().more));
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    EXPECT_NE(outcome.err.find(GetParam().message), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("plumbline: ")) << outcome.err;
}

TEST(TradeCommand, RefusesTruthsAndResultsOfSomethingElse)
{
    TemporaryFolder folder;
    const std::string json = (folder / "t.json").string();
    const auto refused = [&](const Arguments& arguments, const char* message) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << outcome.err;
        EXPECT_NE(outcome.err.find(message), std::string::npos) << outcome.err;
        EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
    };
    refused({"trade", scene_file("furnace"), "--truth", golden_file("cornell_glass")}, "scene_hash");
    refused({"trade", scene_file("furnace"), "--truth", scene_file("furnace")}, "furnace.dae");
    refused({"trade", "-", "--truth", golden_file("furnace")}, "trade -");
    // Before the truth is rendered: its minute is not waited for.
    refused({"trade", scene_file("furnace"), "--cache", "/proc/no/folder", "--truth-seconds", "1e6"},
            "/proc/no/folder");
    for (const char* text : {"", "{", "[]", "{\"format\": 3}"}) {
        write_bytes(json, text);
        refused(trade("furnace", {"-o", json, "--resume"}), json.c_str());
        EXPECT_EQ(read_bytes(json), text);
        refused({"trade", "--from", json}, ("--from " + json).c_str());
    }
    refused({"trade"}, "scene is required");
    refused({"trade", scene_file("furnace"), "--from", json}, "--from");
}

} // namespace
