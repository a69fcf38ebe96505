// Elements that the picture does not need are not read, so their errors are not reported.

#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace {

/// A triangle without camera and lights: the picture needs a geometry and a material.
transport_test::SceneText with_triangle()
{
    transport_test::SceneText text;
    text.geometries = transport_test::triangle_mesh("t");
    text.nodes = transport_test::node(transport_test::instance_geometry("t"));
    return text;
}

/// The file of with_triangle(), with `library` before its <scene>.
std::string with_library(const std::string& library)
{
    std::string xml = with_triangle().str();
    return xml.insert(xml.find("<scene>"), library);
}

/// The error in `xml`, or "" if it gives the one triangle and only the notice that there is no emitter.
std::string fault_of(const std::string& xml)
{
    try {
        const scenes::Scene scene = scenes::parse_scene(xml, "test.dae");
        if (scene.triangles.size() != 1) return "other than one triangle";
        if (scene.notices.size() != 1) return scene.notices.back();
    } catch (const scenes::SceneError& error) {
        return error.what();
    }
    return "";
}

TEST(Unused, LibrariesOfAnyKindAreNotRead)
{
    EXPECT_EQ(fault_of(with_library("")), "");
    for (const char* library :
         {"<library_images><image><init_from>gone.png</init_from><a/></image></library_images>",
          "<library_animations><animation/>text<twist/></library_animations>",
          "<library_animation_clips><animation_clip start=\"x\"/></library_animation_clips>",
          "<library_controllers><controller><skin source=\"#gone\"/></controller></library_controllers>",
          "<library_materials><material/><material><twist/></material></library_materials>",
          "<library_effects><effect><profile_COMMON><technique><lambert><diffuse><texture/></diffuse>"
          "</lambert></technique></profile_COMMON></effect></library_effects>",
          "<library_cameras><camera><optics><technique_common><orthographic/></technique_common>"
          "</optics></camera></library_cameras>",
          "<library_lights><light><laser/></light></library_lights>",
          "<library_geometries><geometry><spline/></geometry></library_geometries>",
          "<library_nodes><node><skew>1</skew><instance_geometry url=\"#gone\"/></node></library_nodes>",
          "<library_visual_scenes><visual_scene><evaluate_scene/></visual_scene>"
          "</library_visual_scenes>",
          "<library_kinematics_models><kinematics_model/></library_kinematics_models>",
          "<library_wishes>more light</library_wishes>"})
        EXPECT_EQ(fault_of(with_library(library)), "") << library;
}

TEST(Unused, IdsMayBeDoubledWhereNothingRefersToThem)
{
    EXPECT_EQ(fault_of(with_library("<library_images><image id=\"i\"/><image id=\"i\"/><image id=\"\"/>"
                                    "<image id=\"\"/></library_images>")),
              "");
    transport_test::SceneText text = with_triangle();
    text.nodes = "<node id=\"n\">" + transport_test::instance_geometry("t") + "</node><node id=\"n\"/>";
    EXPECT_EQ(fault_of(text.str()), "");
    // A reference in an element that is not used itself does not count.
    text.library_nodes = "<node><instance_node url=\"#n\"/></node>";
    EXPECT_EQ(fault_of(text.str()), "");
    text.nodes += "<node><instance_node url=\"#n\"/></node>";
    EXPECT_EQ(fault_of(text.str()), "test.dae:1: <instance_node url=\"#n\">: two elements have the id "
                                    "\"n\": the <node> in line 1 and the <node> in line 1");
}

TEST(Unused, MaterialsBoundToSymbolsOfNoPartAreNotRead)
{
    const auto bound_beside = [](const std::string& more) {
        transport_test::SceneText text = with_triangle();
        transport_test::add_material(text, "odd", "<velvet/>");
        text.materials += "<material id=\"two\"/><material id=\"two\"/>";
        text.nodes.insert(text.nodes.find("<instance_material"), more);
        return text.str();
    };
    for (const std::string target : {"gone", "odd", "two", "t"}) {
        const std::string bound = "\" target=\"#" + target + "\"/>";
        const std::string fault = fault_of(bound_beside("<instance_material symbol=\"x" + bound +
                                                        "<instance_material symbol=\"x" + bound));
        EXPECT_EQ(fault, "") << target;
    }
    EXPECT_NE(fault_of(bound_beside("<instance_material symbol=\"m\" target=\"#odd\"/>")), "");
}

TEST(Unused, CamerasAfterTheFirstAreNotRead)
{
    transport_test::SceneText text = with_triangle();
    text.cameras = "<camera id=\"c\"><optics><technique_common><perspective><xfov>40</xfov>"
                   "</perspective></technique_common></optics></camera>";
    text.nodes += "<node><instance_camera url=\"#c\"/><instance_camera url=\"#gone\"/></node>";
    const scenes::Scene scene = text.parse();
    EXPECT_TRUE(scene.camera.has_value());
    EXPECT_EQ(scene.notices.at(0), "test.dae:1: <instance_camera url=\"#gone\">: ignored, like every "
                                   "camera but the first");
}

/// A file like those that common programs write: one of those that the fuzzer starts from.
scenes::Scene real_file(const std::string& name)
{
    return scenes::read_scene(std::filesystem::path(PLUMBLINE_SOURCE_DIR) / "tests/fuzz/corpus" / name);
}

TEST(Unused, FilesLikeThoseInUseAreReadWithoutAWord)
{
    for (const char* name : {"two_nodes_one_id.dae", "unused_images_and_animation.dae"}) {
        const scenes::Scene scene = real_file(name);
        EXPECT_EQ(scene.triangles.size(), 12) << name;
        EXPECT_EQ(scene.materials.size(), 2) << name;
        EXPECT_TRUE(scene.notices.empty()) << name << ": " << scene.notices.front();
    }
}

} // namespace
