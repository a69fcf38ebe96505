#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <string>
#include <variant>

namespace {

using scenes::Vec3;

Vec3 area_vector(const scenes::Triangle& triangle)
{
    const auto& v = triangle.vertices;
    return glm::cross(v[1] - v[0], v[2] - v[0]);
}

std::string matrix_text(const glm::dmat3& linear, const Vec3& offset)
{
    std::string text = "<matrix>";
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column)
            text += transport_test::exactly(linear[column][row]) + " ";
        text += transport_test::exactly(offset[row]) + " ";
    }
    return text + "0 0 0 1</matrix>";
}

/// Whole-number entries: determinants and images of whole points are exact.
glm::dmat3 random_invertible()
{
    return *rc::gen::suchThat(rc::gen::exec([] {
                                  glm::dmat3 m(0.0);
                                  for (int i = 0; i < 3; ++i)
                                      for (int j = 0; j < 3; ++j) m[i][j] = *rc::gen::inRange(-9, 10);
                                  return m;
                              }),
                              [](const glm::dmat3& m) { return glm::determinant(m) != 0; });
}

transport_test::SceneText with_lamp()
{
    transport_test::SceneText text;
    transport_test::add_material(text, "lamp", "<emission><radiance>1 2 3</radiance></emission>");
    return text;
}

// Exact: all numbers are small whole ones.
RC_GTEST_PROP(MirroredNodes, TheFrontOfATriangleIsTheImageOfItsFront, ())
{
    const glm::dmat3 linear = random_invertible();
    transport_test::SceneText text = with_lamp();
    text.geometries = transport_test::triangle_mesh("t");
    text.nodes = transport_test::node(matrix_text(linear, Vec3(1, 2, 3)) +
                                      transport_test::instance_geometry("t", "lamp"));
    const scenes::Scene scene = text.parse();
    const scenes::Triangle& triangle = scene.triangles.at(0);
    const Vec3 before_front =
        linear * Vec3(0, 0, 1) + Vec3(1, 2, 3); // the local point (0, 0, 1) is in front
    RC_ASSERT(triangle.vertices[0] == Vec3(1, 2, 3));
    RC_ASSERT(glm::dot(area_vector(triangle), before_front - triangle.vertices[0]) > 0);
    // The corners are the same, in any order.
    RC_ASSERT(triangle.vertices[0] + triangle.vertices[1] + triangle.vertices[2] ==
              3.0 * Vec3(1, 2, 3) + linear[0] + linear[1]);
}

// Exact, except for the halves, which are exact as well.
RC_GTEST_PROP(AreaLights, TheSquareEmitsToTheImageOfItsNegativeZ, ())
{
    const glm::dmat3 linear = random_invertible();
    transport_test::SceneText text;
    text.lights = "<light id=\"a\"><extra><technique profile=\"CMU462\"><area><color>4 5 "
                  "6</color></area></technique>"
                  "</extra></light>";
    text.nodes =
        transport_test::node(matrix_text(linear, Vec3(1, 2, 3)) + "<instance_light url=\"#a\"/>");
    const scenes::Scene scene = text.parse();
    RC_ASSERT(scene.triangles.size() == 2U);
    for (const scenes::Triangle& triangle : scene.triangles) {
        RC_ASSERT(std::get<scenes::Emission>(scene.materials.at(triangle.material)).radiance ==
                  Vec3(4, 5, 6));
        RC_ASSERT(glm::dot(area_vector(triangle), linear * Vec3(0, 0, -1)) > 0);
        // Each half covers half of the parallelogram that is the image of the square.
        RC_ASSERT(area_vector(triangle) == area_vector(scene.triangles[0]));
        const Vec3 whole = glm::cross(linear[0], linear[1]);
        RC_ASSERT(area_vector(triangle) == whole || area_vector(triangle) == -whole);
    }
    Vec3 sum(0.0);
    for (const scenes::Triangle& triangle : scene.triangles)
        for (const Vec3& vertex : triangle.vertices) sum += vertex;
    RC_ASSERT(sum == 6.0 * Vec3(1, 2, 3)); // centred on the node's origin
}

TEST(AreaLights, ManyOfOneElementShareAMaterialNamedAfterIt)
{
    transport_test::SceneText text;
    text.lights = "<light id=\"a\"><extra><technique profile=\"CMU462\"><area><color>4 5 "
                  "6</color></area></technique>"
                  "</extra></light>";
    text.nodes = transport_test::node("<instance_light url=\"#a\"/>") +
                 transport_test::node("<instance_light url=\"#a\"/>");
    const scenes::Scene scene = text.parse();
    EXPECT_EQ(scene.triangles.size(), 4);
    EXPECT_EQ(scene.materials.size(), 1);
    EXPECT_EQ(scene.material_names, std::vector<std::string>{"a"});
    EXPECT_TRUE(scene.notices.empty());
}

transport_test::SceneText lamp_and_area_lights(const std::string& lamp, const std::string& geometry)
{
    transport_test::SceneText text;
    transport_test::add_material(text, "lamp", lamp);
    text.geometries = geometry;
    text.lights = "<light id=\"a\"><extra><technique profile=\"CMU462\"><area><color>4 5 "
                  "6</color></area></technique>"
                  "</extra></light>";
    text.nodes = transport_test::node("<instance_light url=\"#a\"/><instance_light url=\"#a\"/>" +
                                      transport_test::instance_geometry("g", "lamp"));
    return text;
}

TEST(AreaLights, AreSkippedWithOneNoticeWhereGeometryEmits)
{
    for (const std::string& geometry :
         {transport_test::triangle_mesh("g"), transport_test::sphere_geometry("g", "1")}) {
        const scenes::Scene scene =
            lamp_and_area_lights("<emission><radiance>0 0 1</radiance></emission>", geometry).parse();
        EXPECT_EQ(scene.triangles.size() + scene.spheres.size(), 1);
        ASSERT_EQ(scene.notices.size(), 1);
        EXPECT_EQ(scene.notices[0],
                  "test.dae:1: <instance_light url=\"#a\">: skipped, like every area light: the scene "
                  "has emissive geometry, of which they are a second description");
    }
}

TEST(AreaLights, AreKeptWhereGeometryOnlySeemsToEmit)
{
    const std::string line =
        transport_test::mesh("g", "0 0 0 1 0 0 2 0 0", 3,
                             "<triangles material=\"m\" count=\"1\"><input semantic=\"VERTEX\" "
                             "source=\"#g-v\" offset=\"0\"/><p>0 1 2</p></triangles>");
    EXPECT_EQ(lamp_and_area_lights("<emission><radiance>0 0 0</radiance></emission>",
                                   transport_test::triangle_mesh("g"))
                  .parse()
                  .triangles.size(),
              5);
    EXPECT_EQ(lamp_and_area_lights("<emission><radiance>1 1 1</radiance></emission>", line)
                  .parse()
                  .triangles.size(),
              5);
}

TEST(Spheres, TakeSimilarityTransforms)
{
    transport_test::SceneText text;
    text.geometries = transport_test::sphere_geometry("s", "0.5");
    // A turn by 3-4-5, a mirroring and a scale of 4, in seven digits as from a file.
    text.nodes = transport_test::node("<matrix>2.4 3.2 0 1 3.2 -2.400001 0 2 0 0 4 3 0 0 0 1</matrix>" +
                                      transport_test::instance_geometry("s"));
    const scenes::Scene scene = text.parse();
    ASSERT_EQ(scene.spheres.size(), 1);
    EXPECT_EQ(scene.spheres[0].center, Vec3(1, 2, 3));
    EXPECT_NEAR(scene.spheres[0].radius, 2, 1e-6); // the digits of the matrix
}

TEST(Spheres, AnEllipsoidIsAnErrorThatSaysSo)
{
    for (const std::string transform :
         {"<scale>1 1 2</scale>", "<scale>1 1 1.0001</scale>",
          "<matrix>1 0.001 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>",
          "<rotate>0 0 1 45</rotate><scale>1 2 1</scale><rotate>0 0 1 -45</rotate>"}) {
        transport_test::SceneText text;
        text.geometries = transport_test::sphere_geometry("s", "0.5");
        text.nodes = transport_test::node(transform + transport_test::instance_geometry("s"));
        EXPECT_EQ(transport_test::error_of(text).find(
                      "test.dae:1: <instance_geometry url=\"#s\">: an ellipsoid:"),
                  0)
            << transform;
    }
}

TEST(Instances, OneGeometryCanStandInManyPlacesWithManyMaterials)
{
    transport_test::SceneText text = with_lamp();
    text.geometries = transport_test::triangle_mesh("t") + transport_test::sphere_geometry("s", "1");
    text.nodes = transport_test::node(transport_test::instance_geometry("t") +
                                      transport_test::instance_geometry("s", "lamp")) +
                 transport_test::node("<translate>5 0 0</translate>" +
                                      transport_test::instance_geometry("t", "lamp") +
                                      transport_test::instance_geometry("s"));
    const scenes::Scene scene = text.parse();
    EXPECT_EQ(scene.material_names, (std::vector<std::string>{"grey", "lamp"}));
    ASSERT_EQ(scene.triangles.size(), 2);
    EXPECT_EQ(scene.triangles[1].vertices[0], Vec3(5, 0, 0));
    EXPECT_EQ(scene.triangles[0].material, 0);
    EXPECT_EQ(scene.triangles[1].material, 1);
    ASSERT_EQ(scene.spheres.size(), 2);
    EXPECT_EQ(scene.spheres[0].material, 1);
    EXPECT_EQ(scene.spheres[1].center, Vec3(5, 0, 0));
    EXPECT_EQ(scene.spheres[1].material, 0);
}

TEST(Instances, PartsOfAMeshTakeTheMaterialsOfTheirSymbols)
{
    transport_test::SceneText text = with_lamp();
    const std::string input = "<input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/>";
    text.geometries = transport_test::mesh("g", "0 0 0 1 0 0 0 1 0", 3,
                                           "<triangles material=\"one\" count=\"1\">" + input +
                                               "<p>0 1 2</p></triangles>"
                                               "<polylist material=\"two\" count=\"1\">" +
                                               input +
                                               "<vcount>3</vcount><p>2 1 0</p></polylist>"
                                               "<triangles material=\"unbound\" count=\"0\">" +
                                               input + "</triangles>");
    text.nodes = transport_test::node("<instance_geometry url=\"#g\"><bind_material><technique_common>"
                                      "<instance_material symbol=\"two\" target=\"#grey\"/>"
                                      "<instance_material symbol=\"one\" target=\"#lamp\"/>"
                                      "</technique_common></bind_material></instance_geometry>");
    const scenes::Scene scene = text.parse();
    ASSERT_EQ(scene.triangles.size(), 2);
    EXPECT_EQ(scene.material_names[scene.triangles[0].material], "lamp");
    EXPECT_EQ(scene.material_names[scene.triangles[1].material], "grey");
}

TEST(Instances, NodesOfTheLibraryCanBeInstancedBelowOneAnother)
{
    transport_test::SceneText text;
    text.geometries = transport_test::triangle_mesh("t");
    text.library_nodes =
        "<node id=\"leaf\"><translate>0 0 1</translate>" + transport_test::instance_geometry("t") +
        "</node>"
        "<node id=\"pair\"><instance_node url=\"#leaf\"/><node><translate>0 10 0</translate>"
        "<instance_node url=\"#leaf\"/></node></node>";
    text.nodes = transport_test::node("<scale>2 2 2</scale><instance_node url=\"#pair\"/>") +
                 "<node><instance_node url=\"#pair\"/></node>";
    const scenes::Scene scene = text.parse();
    ASSERT_EQ(scene.triangles.size(), 4);
    EXPECT_EQ(scene.triangles[0].vertices[0], Vec3(0, 0, 2));
    EXPECT_EQ(scene.triangles[1].vertices[0], Vec3(0, 20, 2));
    EXPECT_EQ(scene.triangles[2].vertices[0], Vec3(0, 0, 1));
    EXPECT_EQ(scene.triangles[3].vertices[0], Vec3(0, 10, 1));
}

TEST(Instances, NodesThatMultiplyThemselvesAreStopped)
{
    // 60 nodes, each with two instances of the next: 2^60 triangles, or as many visits of empty nodes.
    for (const std::string& leaf : {transport_test::instance_geometry("t"), std::string()}) {
        transport_test::SceneText text;
        text.geometries = transport_test::triangle_mesh("t");
        for (int i = 0; i < 60; ++i) {
            const std::string next = "<instance_node url=\"#n" + std::to_string(i + 1) + "\"/>";
            text.library_nodes += "<node id=\"n" + std::to_string(i) + "\">" + next + next + "</node>";
        }
        text.library_nodes += "<node id=\"n60\">" + leaf + "</node>";
        text.nodes = transport_test::node("<instance_node url=\"#n0\"/>");
        EXPECT_NE(transport_test::error_of(text).find(": more than "), std::string::npos);
    }
}

TEST(Instances, ChainsOfNodesAreStoppedBeforeTheStackIs)
{
    transport_test::SceneText text;
    for (int i = 0; i < 100000; ++i)
        text.library_nodes += "<node id=\"n" + std::to_string(i) + "\"><instance_node url=\"#n" +
                              std::to_string(i + 1) + "\"/></node>";
    text.nodes = transport_test::node("<instance_node url=\"#n0\"/>");
    EXPECT_EQ(transport_test::error_of(text),
              "test.dae:1: <node id=\"n199\">: nested deeper than 200 nodes");
}

} // namespace
