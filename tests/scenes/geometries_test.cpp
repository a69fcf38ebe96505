#include "scenes/polygons/triangulate.h"
#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace {

using scenes::Vec3;

/// A mesh that varies everything that the format allows to vary.
struct RandomMesh {
    std::vector<Vec3> positions;
    std::vector<std::vector<std::uint32_t>> polygons;
};

rc::Gen<double> coordinate()
{
    return rc::gen::map(
        rc::gen::pair(rc::gen::inRange<std::int64_t>(-(1LL << 52), 1LL << 52),
                      rc::gen::inRange(-60, 10)),
        [](const auto& p) { return std::ldexp(static_cast<double>(p.first), p.second); });
}

RandomMesh random_mesh(bool only_triangles)
{
    RandomMesh mesh;
    const int points = *rc::gen::inRange(1, 12);
    for (int i = 0; i < points; ++i)
        mesh.positions.emplace_back(*coordinate(), *coordinate(), *coordinate());
    const int polygons = *rc::gen::inRange(0, 6);
    for (int i = 0; i < polygons; ++i) {
        const auto corners = static_cast<std::size_t>(only_triangles ? 3 : *rc::gen::inRange(3, 7));
        mesh.polygons.push_back(*rc::gen::container<std::vector<std::uint32_t>>(
            corners, rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(points))));
    }
    return mesh;
}

/// The positions in an array with a random accessor offset, stride and order of X, Y and Z. The numbers
/// between them differ from all coordinates, so that a wrong index is detected.
std::string source_text(const std::vector<Vec3>& positions)
{
    const auto stride = static_cast<std::size_t>(*rc::gen::inRange(3, 8));
    const auto offset = static_cast<std::size_t>(*rc::gen::inRange(0, 5));
    std::vector<int> places(stride, -1); // the axis at each place
    std::array<std::size_t, 3> place_of{};
    for (int axis = 0; axis < 3; ++axis) {
        auto place = static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(stride)));
        while (places[place] != -1) place = (place + 1) % stride;
        places[place] = axis;
        place_of[static_cast<std::size_t>(axis)] = place;
    }
    const std::size_t last = *std::max_element(place_of.begin(), place_of.end());
    // The array may end after the last coordinate, before the end of the stride.
    std::vector<double> values(offset + (positions.size() - 1) * stride + last + 1, 12345678.0);
    for (std::size_t i = 0; i < positions.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            values[offset + i * stride + place_of[axis]] = positions[i][static_cast<int>(axis)];

    std::string text =
        "<source id=\"p\"><float_array id=\"a\" count=\"" + std::to_string(values.size()) + "\">";
    for (const double value : values)
        text += transport_test::exactly(value) + (*rc::gen::element(" ", "\n", "  "));
    text += "</float_array><technique_common><accessor source=\"#a\" count=\"" +
            std::to_string(positions.size()) + "\" offset=\"" + std::to_string(offset) + "\" stride=\"" +
            std::to_string(stride) + "\">";
    for (const int axis : places)
        text += axis < 0 ? "<param type=\"float\"/>"
                         : "<param name=\"" + std::string(1, "XYZ"[axis]) + "\" type=\"float\"/>";
    return text + "</accessor></technique_common></source>";
}

/// <input> elements in random order, VERTEX at a random one of `stride` offsets; some share offsets.
struct Inputs {
    std::string text;
    std::size_t stride;
    std::size_t vertex;
};

Inputs random_inputs()
{
    const auto stride = static_cast<std::size_t>(*rc::gen::inRange(1, 5));
    const auto vertex = static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(stride)));
    std::vector<std::string> inputs;
    for (std::size_t i = 0; i < stride; ++i) {
        const std::string offset = "\" offset=\"" + std::to_string(i) + "\"/>";
        if (i == vertex)
            inputs.push_back("<input semantic=\"VERTEX\" source=\"#v" + offset);
        else
            inputs.push_back("<input semantic=\"TEXCOORD\" source=\"#none" + offset);
        if (*rc::gen::arbitrary<bool>())
            inputs.push_back("<input semantic=\"NORMAL\" source=\"#none" + offset);
    }
    std::string text;
    while (!inputs.empty()) {
        const auto next =
            static_cast<std::ptrdiff_t>(*rc::gen::inRange<int>(0, static_cast<int>(inputs.size())));
        text += inputs[static_cast<std::size_t>(next)];
        inputs.erase(inputs.begin() + next);
    }
    return {text, stride, vertex};
}

std::string corner_text(const std::vector<std::uint32_t>& polygon, const Inputs& inputs)
{
    std::string text;
    for (const std::uint32_t corner : polygon)
        for (std::size_t i = 0; i < inputs.stride; ++i)
            text += (i == inputs.vertex ? std::to_string(corner) : "4000000000") + " ";
    return text;
}

std::string primitives_text(const std::string& kind, const RandomMesh& mesh)
{
    const Inputs inputs = random_inputs();
    std::string text = "<" + kind + " material=\"m\" count=\"" + std::to_string(mesh.polygons.size()) +
                       "\">" + inputs.text;
    std::string sizes;
    std::string all;
    for (const auto& polygon : mesh.polygons) {
        sizes += std::to_string(polygon.size()) + " ";
        if (kind == "polygons")
            text += "<p>" + corner_text(polygon, inputs) + "</p>";
        else
            all += corner_text(polygon, inputs);
    }
    if (kind == "polylist") text += "<vcount>" + sizes + "</vcount>";
    if (kind != "polygons") text += "<p>" + all + "</p>";
    return text + "</" + kind + ">";
}

RC_GTEST_PROP(Geometries, WhateverTheLayoutTheTrianglesAreThoseOfThePolygons, ())
{
    const std::string kind = *rc::gen::element<std::string>("triangles", "polylist", "polygons");
    const RandomMesh mesh = random_mesh(kind == "triangles");
    transport_test::SceneText text;
    text.geometries = "<geometry id=\"g\"><mesh>" + source_text(mesh.positions) +
                      "<vertices id=\"v\"><input semantic=\"NORMAL\" source=\"#none\"/>"
                      "<input semantic=\"POSITION\" source=\"#p\"/></vertices>" +
                      primitives_text(kind, mesh) + "</mesh></geometry>";
    text.nodes = transport_test::node(transport_test::instance_geometry("g"));
    const scenes::Scene scene = text.parse();

    scenes::polygons::Polygons polygons;
    for (const auto& polygon : mesh.polygons) {
        polygons.sizes.push_back(static_cast<std::uint32_t>(polygon.size()));
        polygons.corners.insert(polygons.corners.end(), polygon.begin(), polygon.end());
    }
    std::vector<scenes::polygons::Corners> expected;
    scenes::polygons::PolygonFaults faults;
    triangulate(polygons, mesh.positions, expected, faults);
    RC_ASSERT(scene.triangles.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        RC_ASSERT(scene.triangles[i].vertices == expected[i]);
}

/// The notices about polygons of a mesh with one polygon per <p>.
std::vector<std::string> notices_of(const std::string& positions, std::size_t points,
                                    const std::vector<std::string>& polygons)
{
    transport_test::SceneText text;
    std::string primitives = "<polygons material=\"m\" count=\"" + std::to_string(polygons.size()) +
                             "\"><input semantic=\"VERTEX\" source=\"#g-v\" offset=\"0\"/>";
    for (const std::string& p : polygons) primitives += "<p>" + p + "</p>";
    text.geometries = transport_test::mesh("g", positions, points, primitives + "</polygons>");
    text.lights = "<light id=\"l\"><technique_common><ambient><color>1 1 "
                  "1</color></ambient></technique_common></light>";
    text.nodes =
        transport_test::node(transport_test::instance_geometry("g") +
                             transport_test::instance_geometry("g") + "<instance_light url=\"#l\"/>");
    return text.parse().notices;
}

const std::string place_of_g = "test.dae:1: <geometry id=\"g\">: ";

TEST(PolygonFaults, APlanarConvexPolygonHasNone)
{
    EXPECT_EQ(notices_of("0 0 0 1 0 0 1 1 0 0 1 0", 4, {"0 1 2 3", "3 2 1 0", "0 1 2"}),
              std::vector<std::string>());
}

TEST(PolygonFaults, SevenDigitsAreEnoughToBePlanar)
{
    // A square of size 0.01 far out, tilted, each coordinate rounded to seven digits.
    EXPECT_EQ(
        notices_of("100.0000 200.0000 300.0000 100.0100 200.0000 300.0033 100.0100 200.0100 300.0067 "
                   "100.0000 200.0100 300.0033",
                   4, {"0 1 2 3"}),
        std::vector<std::string>());
}

TEST(PolygonFaults, NonPlanarPolygonsAreCountedInOneNoticePerGeometry)
{
    EXPECT_EQ(notices_of("0 0 0 1 0 0 1 1 0.01 0 1 0", 4, {"0 1 2 3", "1 2 3 0", "0 1 2"}),
              std::vector<std::string>{
                  place_of_g +
                  "2 polygon(s) are not planar: cut into triangles as their projection on the "
                  "mean plane"});
}

TEST(PolygonFaults, AConcavePolygonHasNoneWhicheverCornerComesFirst)
{
    const std::string dart = "0 0 0 4 1 0 1 1 0 1 4 0"; // concave at corner 2
    EXPECT_EQ(notices_of(dart, 4, {"2 3 0 1", "0 1 2 3", "1 2 3 0", "3 2 1 0"}),
              std::vector<std::string>());
}

TEST(PolygonFaults, PolygonsThatCrossThemselvesAreCounted)
{
    EXPECT_EQ(notices_of("0 0 0 4 4 0 4 0 0 0 3 0", 4, {"0 1 2 3", "0 2 1 3"}),
              std::vector<std::string>{
                  place_of_g + "1 polygon(s) cross themselves or their holes: cut into triangles "
                               "around the first corner, which cover a different area"});
}

TEST(PolygonFaults, ZeroAreaTrianglesAreKeptAndSmallerPolygonsDropped)
{
    EXPECT_EQ(
        notices_of("0 0 0 1 0 0 2 0 0 0 1 0", 4, {"0 1 2", "0 0 3", "0 1 3"}),
        std::vector<std::string>{
            place_of_g + "2 triangle(s) of zero area: kept, but they neither stop a ray nor emit"});
    EXPECT_EQ(
        notices_of("0 0 0 1 0 0 2 0 0 0 1 0", 4, {"0 1", "0", "", "0 1 3"}),
        std::vector<std::string>{place_of_g + "3 polygon(s) with fewer than three corners: dropped"});
}

// A square of area 9 x 9 with a triangular hole of half of 2 x 2, between two other polygons.
const std::string with_hole_positions = "0 0 0 9 0 0 9 9 0 0 9 0 2 2 0 4 2 0 2 4 0";

scenes::Scene with_hole(const std::string& ph)
{
    transport_test::SceneText text;
    text.geometries =
        transport_test::mesh("g", with_hole_positions, 7,
                             "<polygons material=\"m\" count=\"3\"><input semantic=\"VERTEX\" "
                             "source=\"#g-v\" offset=\"0\"/><p>0 1 4</p>" +
                                 ph + "<p>3 2 1</p></polygons>");
    text.nodes = transport_test::node(transport_test::instance_geometry("g"));
    return text.parse();
}

TEST(Geometries, HolesStayOpen)
{
    for (const std::string hole : {"4 5 6", "6 5 4"}) { // in either direction
        const scenes::Scene scene = with_hole("<ph><p>0 1 2 3</p><h>" + hole + "</h></ph>");
        ASSERT_EQ(scene.triangles.size(), 1 + 7 + 1);
        EXPECT_EQ(scene.triangles[0].vertices[2], Vec3(2, 2, 0));
        EXPECT_EQ(scene.triangles[8].vertices[0], Vec3(0, 9, 0)); // polygons keep their order
        double area = 0;
        for (std::size_t i = 1; i < 8; ++i) {
            const auto& v = scene.triangles[i].vertices;
            const double one =
                (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x);
            EXPECT_GE(one, 0);
            area += one / 2;
        }
        EXPECT_EQ(area, 81 - 2);
    }
}

TEST(Geometries, APhWithoutItsOutlineIsAnError)
{
    EXPECT_THROW(with_hole("<ph><h>4 5 6</h></ph>"), scenes::SceneError);
    EXPECT_THROW(with_hole("<ph><p>0 1 2 3</p><p>4 5 6</p></ph>"), scenes::SceneError);
    EXPECT_THROW(with_hole("<ph><p>0 1 2 3</p><h>4 5 7</h></ph>"), scenes::SceneError);
    EXPECT_THROW(with_hole("<ph><p>0 1 2 3</p><hole>4 5 6</hole></ph>"), scenes::SceneError);
}

TEST(Geometries, LinesAreIgnoredWithANotice)
{
    transport_test::SceneText text;
    text.geometries = transport_test::mesh("g", "0 0 0 1 0 0", 2,
                                           "<lines count=\"1\"><input semantic=\"VERTEX\" "
                                           "source=\"#g-v\" offset=\"0\"/><p>0 1</p></lines>");
    text.nodes = transport_test::node("<instance_geometry url=\"#g\"/>");
    const scenes::Scene scene = text.parse();
    EXPECT_TRUE(scene.triangles.empty());
    ASSERT_EQ(scene.notices.size(), 2); // no emitter, either
    EXPECT_EQ(scene.notices[0], "test.dae:1: <lines>: ignored: lines have no area");
}

TEST(Geometries, ASphereOfTheCmu462ProfileTakesThePlaceOfAMesh)
{
    transport_test::SceneText text;
    std::string both = transport_test::triangle_mesh("g");
    both.insert(both.rfind("</geometry>"),
                "<extra><technique profile=\"CMU462\"><sphere><radius>.3</radius></sphere>"
                "</technique></extra>");
    text.geometries = both;
    text.nodes = transport_test::node(transport_test::instance_geometry("g"));
    const scenes::Scene scene = text.parse();
    EXPECT_TRUE(scene.triangles.empty());
    ASSERT_EQ(scene.spheres.size(), 1);
    EXPECT_EQ(scene.spheres[0].radius, 0.3);
}

} // namespace
