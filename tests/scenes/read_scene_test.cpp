#include "scenes/read_scene.h"

#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace {

TEST(ReadScene, TheNameIsThatOfTheFileWithoutFolderAndEnding)
{
    const std::string xml = transport_test::SceneText().str();
    EXPECT_EQ(scenes::parse_scene(xml, "a/b/corn.ell.dae").name, "corn.ell");
    EXPECT_EQ(scenes::parse_scene(xml, "plain").name, "plain");
}

TEST(ReadScene, TheHashIsThatOfTheBytes)
{
    // The value of XXH3 (64 bits, seed 0) of this text is not known independently. The hash must differ
    // between files, be the same for the same bytes, and have 16 digits.
    const std::string xml = transport_test::SceneText().str();
    const std::string hash = scenes::parse_scene(xml, "a.dae").hash;
    EXPECT_EQ(hash, scenes::parse_scene(xml, "b.dae").hash);
    EXPECT_NE(hash, scenes::parse_scene(xml + "\n", "a.dae").hash);
    EXPECT_EQ(hash.size(), 16);
    EXPECT_EQ(hash.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(ReadScene, AFileReadsAsItsBytesParse)
{
    transport_test::SceneText text;
    text.geometries = transport_test::triangle_mesh("t");
    text.nodes = transport_test::node(transport_test::instance_geometry("t"));
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "plumbline-read.dae";
    std::ofstream(path, std::ios::binary) << text.str();
    const scenes::Scene read = scenes::read_scene(path);
    std::filesystem::remove(path);
    const scenes::Scene parsed = text.parse();
    EXPECT_EQ(read.name, "plumbline-read");
    EXPECT_EQ(read.hash, parsed.hash);
    ASSERT_EQ(read.triangles.size(), 1);
    EXPECT_EQ(read.triangles[0].vertices, parsed.triangles[0].vertices);
}

TEST(ReadScene, WhatAnEditorAddsIsIgnored)
{
    const std::string xml =
        "<COLLADA version=\"1.4.1\"><asset><unit name=\"inch\" "
        "meter=\"0.0254\"/><up_axis>X_UP</up_axis></asset>"
        "<library_images><image id=\"i\"><init_from>wood.png</init_from></image></library_images>"
        "<library_controllers/><library_animations/><library_physics_scenes/>"
        "<library_visual_scenes><visual_scene id=\"s\"><asset/><node id=\"n\" type=\"JOINT\" "
        "layer=\"1\"><extra>"
        "<technique profile=\"editor\"><colour>red</colour></technique></extra></node>"
        "<extra><technique profile=\"CMU462\"/></extra></visual_scene></library_visual_scenes>"
        "<scene><instance_visual_scene url=\"#s\"/><extra/></scene><extra/></COLLADA>";
    EXPECT_EQ(scenes::primitive_count(scenes::parse_scene(xml, "a.dae")), 0);
}

TEST(ReadScene, OnlyTheSceneThatIsInstancedCounts)
{
    std::string xml = transport_test::SceneText().str();
    const std::string other =
        "<visual_scene id=\"other\"><node><instance_geometry url=\"#gone\"/></node></visual_scene>";
    xml.insert(xml.find("<visual_scene"), other);
    EXPECT_EQ(scenes::primitive_count(scenes::parse_scene(xml, "a.dae")), 0);
}

} // namespace
