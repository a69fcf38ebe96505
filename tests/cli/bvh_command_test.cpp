// `plumbline bvh`: options without effect are refused, and the precision of measured times is reported.

#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace {

using namespace cli_test;

struct Idle {
    const char* name;
    Arguments options; // PNG and SVG stand for files
    std::string message;
};

class BvhRefuses : public testing::TestWithParam<Idle> {};

INSTANTIATE_TEST_SUITE_P(
    Bvh, BvhRefuses,
    testing::Values(
        Idle{"BuilderOfTheFastPath",
             {"--device", "host", "--builder", "sah"},
             "--builder sah has no effect with --device host"},
        Idle{"ShowWithoutPicture", {"--show", "boxes"}, "--show boxes has no effect without --picture"},
        Idle{"LevelWithoutPicture", {"--level", "3"}, "--level 3 has no effect without --picture"},
        Idle{"LevelOfAFigure",
             {"--builder", "morton30", "--tree", "SVG", "--level", "3"},
             "--level 3 has no effect without --picture"},
        Idle{"LevelOfVisits",
             {"--picture", "PNG", "--show", "visits", "--level", "4"},
             "--level 4 has no effect with --show visits"},
        Idle{
            "SizeOfAFigure", {"--tree", "SVG", "--size", "8x8"}, "--size 8x8 has no effect with --tree"},
        Idle{"SizeOfBuildTimes",
             {"--device", "host", "--size", "8x8"},
             "--size 8x8 has no effect with --device host"},
        Idle{"FrameOfAFigure", {"--tree", "SVG", "--frame"}, "--frame has no effect with --tree"},
        Idle{"FrameOfBuildTimes",
             {"--device", "host", "--frame"},
             "--frame has no effect with --device host"},
        Idle{"RepeatsOfAPicture",
             {"--picture", "PNG", "--repeats", "3"},
             "--repeats 3 has no effect with --picture"},
        Idle{"ThreadsOfTheReference", {"-t", "1"}, "--threads 1 has no effect without --device host"},
        Idle{"ThreadsOfAGpu",
             {"--device", "cuda", "-t", "2"},
             "--threads 2 has no effect with --device cuda"}),
    [](const auto& idle) { return std::string(idle.param.name); });

TEST_P(BvhRefuses, AnOptionWithoutEffectAndNamesWhatMakesItSo)
{
    const TemporaryFolder folder;
    Arguments options = GetParam().options;
    std::ranges::replace(options, "PNG", (folder / "a.png").string());
    std::ranges::replace(options, "SVG", (folder / "a.svg").string());
    const Outcome outcome = run(Arguments{"bvh", scene_file("cornell_diffuse")} + options);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("plumbline: " + GetParam().message)) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.svg"));
}

TEST(Bvh, TakesTheSameOptionsWhereTheyHaveAnEffect)
{
    const TemporaryFolder folder;
    const std::string png = (folder / "a.png").string();
    const std::string scene = scene_file("cornell_diffuse");
    for (const Arguments& options :
         {Arguments{"--picture", png, "--show", "boxes", "--level", "2", "--size", "8x8", "--frame"},
          {"--picture", png, "--builder", "sah", "--device", "host", "-t", "1", "--repeats", "1"},
          {"--picture", png, "--json", "--repeats", "1", "--size", "8x8", "--builder", "sah"}}) {
        const Outcome outcome = run(Arguments{"bvh", scene, "-q"} + options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
    }
}

// A scene of one triangle. The required precision is reached after a few repetitions, without measuring
// for a second.
TEST(Bvh, TellsHowPreciselyItTimedRays)
{
    const TemporaryFolder folder;
    write_bytes(
        folder / "one.dae",
        "<COLLADA version=\"1.4.1\"><library_geometries><geometry id=\"g\"><mesh><source id=\"p\">"
        "<float_array id=\"a\" count=\"9\">0 0 0 1 0 0 0 1 0</float_array><technique_common>"
        "<accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/>"
        "<param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor>"
        "</technique_common></source><vertices id=\"v\"><input semantic=\"POSITION\" "
        "source=\"#p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" "
        "source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
        "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node>"
        "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes>"
        "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>");
    const Outcome outcome = run({"bvh", (folder / "one.dae").string(), "--json", "-q"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const auto report = nlohmann::json::parse(outcome.out);
    EXPECT_EQ(report["primitives"], 1);
    ASSERT_EQ(report["builders"].size(), 4u);
    for (const auto& builder : report["builders"]) {
        const auto error = builder["camera_relative_standard_error"].get<double>();
        EXPECT_GE(error, 0);
        EXPECT_LT(error, 0.5); // 2%, unless one second is too short on a busy machine
    }
}

} // namespace
