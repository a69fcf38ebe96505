// `plumbline export`: files are written completely or not at all, and bad input is one line.

#include "scenes/read_scene.h"
#include "tests/cli/run_program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace {

using namespace cli_test;

TEST(Export, WritesEveryFormatAtOnceAndListsItsFiles)
{
    const TemporaryFolder folder;
    const auto in_folder = [&](const std::string& name) { return (folder / name).string(); };
    const Outcome outcome =
        run({"export", scene_file("point_over_plane"), "-o", in_folder("a.xml"), "-o",
             in_folder("a.pbrt"), "-o", in_folder("b.GLTF"), "-o", in_folder("c.glb"), "--size", "32x16",
             "--max-edges", "6", "-s", "9", "--json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const auto json = nlohmann::json::parse(outcome.out);
    std::vector<std::string> files = json["files"];
    std::sort(files.begin(), files.end());
    EXPECT_EQ(files, (std::vector<std::string>{in_folder("a.ground_0.ply"), in_folder("a.pbrt"),
                                               in_folder("a.xml"), in_folder("b.GLTF"),
                                               in_folder("b.bin"), in_folder("c.glb")}));
    EXPECT_EQ(folder.entries(), files.size());
    EXPECT_EQ(json["triangles"], 2);
    EXPECT_EQ(json["notices"].size(), 1u); // of pbrt, about colours
    EXPECT_TRUE(outcome.err.starts_with(in_folder("a.pbrt") + ": ")) << outcome.err;
    const std::string xml = read_bytes(folder / "a.xml");
    for (const char* text :
         {R"("width" value="32")", R"("height" value="16")", R"("max_depth" value="6")",
          R"("sample_count" value="9")", R"(filename" value="a.ground_0.ply")"})
        EXPECT_NE(xml.find(text), std::string::npos) << text;
}

TEST(Export, KeepsTheUnitsOfTheFileAndMovesTheCameraWithFrame)
{
    const TemporaryFolder folder;
    // Its plane is 20 wide; other commands scale it to about one unit.
    const scenes::Scene scene = scenes::read_scene(scene_file("point_over_plane"));
    const auto exported = [&](const Arguments& options) {
        const Outcome outcome = run(Arguments{"export", scene_file("point_over_plane"), "-q", "-o",
                                              (folder / "a.xml").string()} +
                                    options);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err + outcome.out, "");
        return read_bytes(folder / "a.xml");
    };
    const std::string as_it_stands = exported({});
    EXPECT_NE(as_it_stands.find(R"("intensity" value="9, 6, 3")"), std::string::npos);
    EXPECT_NE(as_it_stands.find(" 2.22 "), std::string::npos) << "the eye's x";
    EXPECT_EQ(exported({"--frame"}).find(" 2.22 "), std::string::npos);
}

TEST(Export, WarnsOfSurfacesThatTouch)
{
    const TemporaryFolder folder;
    const std::string message = "other renderers decide by rounding what touches";
    for (const auto& [scene, touches] : {std::pair("flush_lights", true), {"near_occluder", false}}) {
        const Outcome outcome = run({"export", scene_file(scene), "-o", (folder / "a.glb").string()});
        EXPECT_EQ(outcome.status, 0);
        EXPECT_EQ(outcome.err.find(message) != std::string::npos, touches) << outcome.err;
    }
}

struct BadExport {
    const char* name;
    Arguments arguments; // FOLDER stands for one
    std::string message; // its beginning, after "plumbline: "
};

class ExportCommandRefuses : public testing::TestWithParam<BadExport> {};

INSTANTIATE_TEST_SUITE_P(
    Export, ExportCommandRefuses,
    testing::Values(
        BadExport{"AnotherEnding",
                  {scene_file("furnace"), "-o", "FOLDER/a.obj"},
                  "-o FOLDER/a.obj: its name must end in"},
        BadExport{"WhatTheFormatCannotSay",
                  {scene_file("spot_over_plane"), "-o", "FOLDER/a.xml"},
                  "spot_over_plane: spot light 1: Mitsuba has no spot light"},
        BadExport{"AllFilesIfOneFormatCannotSayIt",
                  {scene_file("furnace"), "-o", "FOLDER/a.xml", "-o", "FOLDER/a.glb"},
                  "furnace: sphere 1 of 3: glTF has no spheres"},
        BadExport{"AnIntegratorForGltf",
                  {scene_file("near_occluder"), "-o", "FOLDER/a.gltf", "--max-edges", "3"},
                  "--max-edges has no effect without an .xml or .pbrt"},
        BadExport{
            "AMissingFolder", {scene_file("furnace"), "-o", "FOLDER/none/a.xml"}, "FOLDER/none/a.xml: "},
        BadExport{"OneFileTwice",
                  {scene_file("near_occluder"), "-o", "FOLDER/a.gltf", "-o", "FOLDER/a.gltf"},
                  "-o FOLDER/a.gltf FOLDER/a.bin and -o FOLDER/a.gltf FOLDER/a.bin are the same file"},
        BadExport{"AMissingScene", {"FOLDER/none.dae", "-o", "FOLDER/a.xml"}, ""},
        BadExport{
            "NoSize", {scene_file("furnace"), "-o", "FOLDER/a.xml", "--size", "big"}, "--size big: "}),
    [](const auto& bad) { return std::string(bad.param.name); });

TEST_P(ExportCommandRefuses, InOneLineAndLeavesNoFile)
{
    const TemporaryFolder folder;
    const auto filled = [&](std::string text) {
        for (std::size_t at = 0; (at = text.find("FOLDER")) != std::string::npos;)
            text.replace(at, 6, folder.path().string());
        return text;
    };
    Arguments arguments = {"export"};
    for (const std::string& argument : GetParam().arguments) arguments.push_back(filled(argument));
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("plumbline: " + filled(GetParam().message))) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(folder.entries(), 0u);
}

TEST(Export, AFullDiskLeavesNoNewFileAndKeepsOldOnes)
{
    const TemporaryFolder folder;
    write_bytes(folder / "a.xml", "old");
    const Outcome outcome =
        run({"export", scene_file("cornell_diffuse"), "-o", (folder / "a.xml").string()},
            Surroundings{.largest_file = 1000}); // enough for each .ply, not for the .xml
    EXPECT_EQ(outcome.status, 2);
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(read_bytes(folder / "a.xml"), "old");
    EXPECT_EQ(folder.entries(), 1u);
}

} // namespace
