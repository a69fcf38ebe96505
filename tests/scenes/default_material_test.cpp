// The material of surfaces without a bound material.

#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace {

using Notices = std::vector<std::string>;

const std::string stands_in = "the default, Lambertian with albedo 0.5, is used";

std::string mesh_of(const std::string& parts)
{
    return transport_test::mesh("g", "0 0 0 1 0 0 0 1 0", 3, parts);
}

std::string part(const std::string& symbol, const std::string& corners = "0 1 2")
{
    return "\n<triangles " + symbol + " count=\"" + (corners.empty() ? "0" : "1") +
           "\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/><p>" + corners +
           "</p></triangles>";
}

/// The scene as read, with a lamp, so that there is no notice of a scene without an emitter.
scenes::Scene lit(transport_test::SceneText text)
{
    text.lights = "<light id=\"l\"><technique_common><point><color>1 1 1</color></point>"
                  "</technique_common></light>";
    text.nodes += "<node><instance_light url=\"#l\"/></node>";
    return text.parse();
}

void expect_default(const scenes::Scene& scene, std::uint32_t material)
{
    EXPECT_EQ(scene.material_names.at(material), "default");
    const auto* lambertian = std::get_if<scenes::Lambertian>(&scene.materials.at(material));
    ASSERT_NE(lambertian, nullptr);
    EXPECT_EQ(lambertian->albedo, scenes::Rgb(0.5));
}

TEST(DefaultMaterial, IsThatOfPartsThatNameNone)
{
    transport_test::SceneText text;
    text.geometries = mesh_of(part("") + part("material=\"m\"") + part("name=\"last\""));
    text.nodes = transport_test::node(transport_test::instance_geometry("g"));
    const scenes::Scene scene = lit(text);
    ASSERT_EQ(scene.triangles.size(), 3);
    expect_default(scene, scene.triangles[0].material);
    EXPECT_EQ(scene.material_names.at(scene.triangles[1].material), "grey");
    EXPECT_EQ(scene.triangles[2].material, scene.triangles[0].material);
    EXPECT_EQ(scene.notices,
              (Notices{"test.dae:2: <triangles>: no material: " + stands_in,
                       "test.dae:4: <triangles name=\"last\">: no material: " + stands_in}));
}

TEST(DefaultMaterial, IsThatOfSymbolsThatAnInstanceDoesNotBind)
{
    transport_test::SceneText text;
    text.geometries = mesh_of(part("material=\"m\""));
    text.nodes = transport_test::node(transport_test::instance_geometry("g")) +
                 "\n<node><instance_geometry url=\"#g\"/></node>";
    const scenes::Scene scene = lit(text);
    ASSERT_EQ(scene.triangles.size(), 2);
    EXPECT_EQ(scene.material_names.at(scene.triangles[0].material), "grey");
    expect_default(scene, scene.triangles[1].material);
    EXPECT_EQ(scene.notices,
              Notices{"test.dae:2: <triangles material=\"m\">: no material: the instance in line 3 "
                      "binds none to its symbol: " +
                      stands_in});
}

TEST(DefaultMaterial, IsThatOfSpheresWithoutABoundMaterial)
{
    transport_test::SceneText text;
    text.geometries = transport_test::sphere_geometry("s", "1");
    text.nodes = "<node><instance_geometry url=\"#s\"/>" + transport_test::instance_geometry("s") +
                 "<instance_geometry url=\"#s\"><bind_material><technique_common/></bind_material>"
                 "</instance_geometry></node>";
    const scenes::Scene scene = lit(text);
    ASSERT_EQ(scene.spheres.size(), 3);
    expect_default(scene, scene.spheres[0].material);
    EXPECT_EQ(scene.material_names.at(scene.spheres[1].material), "grey");
    EXPECT_EQ(scene.spheres[2].material, scene.spheres[0].material);
    EXPECT_EQ(
        scene.notices,
        Notices{"test.dae:1: <geometry id=\"s\">: no material: the instance in line 1 binds none: " +
                stands_in});
}

TEST(DefaultMaterial, IsNoticedOncePerPartHoweverManyTheInstances)
{
    transport_test::SceneText text;
    text.geometries = mesh_of(part("") + part("material=\"m\"") + part("material=\"x\""));
    for (int i = 0; i < 5; ++i)
        text.nodes += transport_test::node(transport_test::instance_geometry("g"));
    const scenes::Scene scene = lit(text);
    EXPECT_EQ(scene.triangles.size(), 15);
    EXPECT_EQ(scene.materials.size(), 2);
    EXPECT_EQ(scene.notices.size(), 2);
}

TEST(DefaultMaterial, IsNotNeededByPartsWithoutTriangles)
{
    transport_test::SceneText text;
    text.geometries = mesh_of(part("", "") + part("material=\"m\""));
    text.nodes = transport_test::node(transport_test::instance_geometry("g"));
    const scenes::Scene scene = lit(text);
    EXPECT_EQ(scene.materials.size(), 1);
    EXPECT_TRUE(scene.notices.empty());
}

TEST(DefaultMaterial, StandsBesideAMaterialOfThatNameInTheFile)
{
    transport_test::SceneText text;
    transport_test::add_material(text, "default", "<mirror><reflectance>1 1 1</reflectance></mirror>");
    text.geometries = mesh_of(part("") + part("material=\"m\""));
    text.nodes = transport_test::node(transport_test::instance_geometry("g", "default"));
    const scenes::Scene scene = lit(text);
    expect_default(scene, scene.triangles.at(0).material);
    EXPECT_TRUE(
        std::holds_alternative<scenes::Mirror>(scene.materials.at(scene.triangles.at(1).material)));
}

TEST(DefaultMaterial, IsThatOfTheCeilingInARoomWhoseFileGivesItNone)
{
    const scenes::Scene scene = scenes::read_scene(std::filesystem::path(PLUMBLINE_SOURCE_DIR) /
                                                   "tests/fuzz/corpus/no_material.dae");
    ASSERT_EQ(scene.triangles.size(), 12);
    expect_default(scene, scene.triangles[0].material);
    EXPECT_EQ(scene.material_names, (std::vector<std::string>{"default", "lamp", "white"}));
    EXPECT_EQ(scene.notices, Notices{"no_material.dae:1: <polylist>: no material: " + stands_in});
}

} // namespace
