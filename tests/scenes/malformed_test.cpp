// The table of malformed files: one valid file, and for each kind of mistake the edit that produces it.

#include "scenes/read_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

const std::string valid_file = R"(<?xml version="1.0" encoding="utf-8"?>
<!-- One of everything. -->
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><up_axis>Z_UP</up_axis></asset>
  <library_cameras>
    <camera id="eye">
      <optics>
        <technique_common>
          <perspective>
            <xfov>40</xfov>
          </perspective>
        </technique_common>
      </optics>
    </camera>
  </library_cameras>
  <library_lights>
    <light id="bulb">
      <technique_common>
        <spot>
          <color>1 2 3</color>
          <falloff_angle>60</falloff_angle>
          <falloff_exponent>1</falloff_exponent>
        </spot>
      </technique_common>
    </light>
    <light id="panel">
      <extra>
        <technique profile="CMU462">
          <area>
            <color>4 4 4</color>
          </area>
        </technique>
      </extra>
    </light>
  </library_lights>
  <library_effects>
    <effect id="grey-effect">
      <profile_COMMON>
        <technique sid="common">
          <lambert>
            <diffuse>
              <color>0.5 0.5 0.5 1</color>
            </diffuse>
          </lambert>
        </technique>
      </profile_COMMON>
    </effect>
    <effect id="glass-effect">
      <extra>
        <technique profile="CMU462">
          <glass>
            <reflectance>0.9 0.9 0.9</reflectance>
            <transmittance>0.8 0.8 0.8</transmittance>
            <roughness>0</roughness>
            <ior>1.45</ior>
          </glass>
        </technique>
      </extra>
    </effect>
  </library_effects>
  <library_materials>
    <material id="grey">
      <instance_effect url="#grey-effect"/>
    </material>
    <material id="glass">
      <instance_effect url="#glass-effect"/>
    </material>
  </library_materials>
  <library_geometries>
    <geometry id="quad">
      <mesh>
        <source id="quad-positions">
          <float_array id="quad-array" count="12">0 0 0 1 0 0 1 1 0 0 1 0</float_array>
          <technique_common>
            <accessor source="#quad-array" count="4" stride="3">
              <param name="X" type="float"/>
              <param name="Y" type="float"/>
              <param name="Z" type="float"/>
            </accessor>
          </technique_common>
        </source>
        <vertices id="quad-vertices">
          <input semantic="POSITION" source="#quad-positions"/>
        </vertices>
        <polylist material="skin" count="2">
          <input semantic="VERTEX" source="#quad-vertices" offset="0"/>
          <input semantic="NORMAL" source="#quad-normals" offset="1"/>
          <vcount>3 4</vcount>
          <p>0 0 1 0 2 0 0 0 1 0 2 0 3 0</p>
        </polylist>
      </mesh>
    </geometry>
    <geometry id="ball">
      <extra>
        <technique profile="CMU462">
          <sphere>
            <radius>0.5</radius>
          </sphere>
        </technique>
      </extra>
    </geometry>
  </library_geometries>
  <library_nodes>
    <node id="pair">
      <instance_geometry url="#quad">
        <bind_material>
          <technique_common>
            <instance_material symbol="skin" target="#grey"/>
          </technique_common>
        </bind_material>
      </instance_geometry>
    </node>
  </library_nodes>
  <library_visual_scenes>
    <visual_scene id="scene">
      <node id="view">
        <lookat>0 -5 1 0 0 1 0 0 1</lookat>
        <instance_camera url="#eye"/>
      </node>
      <node id="lamps">
        <translate>0 0 3</translate>
        <instance_light url="#bulb"/>
        <instance_light url="#panel"/>
      </node>
      <node id="things">
        <matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>
        <rotate>0 0 1 30</rotate>
        <scale>2 2 2</scale>
        <instance_node url="#pair"/>
        <instance_geometry url="#ball">
          <bind_material>
            <technique_common>
              <instance_material symbol="any" target="#glass"/>
            </technique_common>
          </bind_material>
        </instance_geometry>
      </node>
    </visual_scene>
  </library_visual_scenes>
  <scene>
    <instance_visual_scene url="#scene"/>
  </scene>
</COLLADA>
)";

/// The message of the SceneError that `xml` raises; empty if it raises none. Other exceptions propagate.
std::string error_of(std::string_view xml)
{
    try {
        scenes::parse_scene(xml, "some/folder/bad.dae");
    } catch (const scenes::SceneError& error) {
        return error.what();
    }
    return "";
}

TEST(MalformedFiles, TheFileThatTheyAreMadeFromIsSound)
{
    const scenes::Scene scene = scenes::parse_scene(valid_file, "bad.dae");
    EXPECT_EQ(scene.triangles.size(), 5);
    EXPECT_EQ(scene.spheres.size(), 1);
    EXPECT_TRUE(scene.camera.has_value());
    EXPECT_TRUE(scene.notices.empty());
}

/// `from`, which the valid file contains once, becomes `to`. The expected message is `message`, preceded
/// by the file and the line of `where`, which the malformed file contains once.
struct Mistake {
    const char* name;
    std::string from;
    std::string to;
    std::string where;
    std::string message;
};

// NOLINTNEXTLINE(readability-identifier-naming): the name that GoogleTest calls
void PrintTo(const Mistake& mistake, std::ostream* stream)
{
    *stream << mistake.name;
}

std::size_t position_of_only(const std::string& text, const std::string& part)
{
    const std::size_t position = text.find(part);
    if (position == std::string::npos || text.find(part, position + 1) != std::string::npos)
        throw std::logic_error("not there exactly once: " + part);
    return position;
}

/// The line of `part` in the valid file.
std::string line_of(const std::string& part)
{
    const auto position = static_cast<std::ptrdiff_t>(position_of_only(valid_file, part));
    return std::to_string(1 + std::count(valid_file.begin(), valid_file.begin() + position, '\n'));
}

class MalformedElement : public testing::TestWithParam<Mistake> {};

TEST_P(MalformedElement, RaisesAnErrorOfOneLineThatNamesFileLineAndElement)
{
    const Mistake& mistake = GetParam();
    std::string text = valid_file;
    text.replace(position_of_only(text, mistake.from), mistake.from.size(), mistake.to);
    const auto where = static_cast<std::ptrdiff_t>(position_of_only(text, mistake.where));
    const auto line = 1 + std::count(text.begin(), text.begin() + where, '\n');
    EXPECT_EQ(error_of(text), "bad.dae:" + std::to_string(line) + ": " + mistake.message);
}

const std::string corners = "<p>0 0 1 0 2 0 0 0 1 0 2 0 3 0</p>";
const std::string array =
    "<float_array id=\"quad-array\" count=\"12\">0 0 0 1 0 0 1 1 0 0 1 0</float_array>";
const std::string array_start = "<float_array id=\"quad-array\"";
const std::string accessor = "<accessor source=\"#quad-array\" count=\"4\" stride=\"3\">";
const std::string describe_accessor = "<accessor source=\"#quad-array\">: ";
const std::string vertex_input = "<input semantic=\"VERTEX\" source=\"#quad-vertices\" offset=\"0\"/>";
const std::string polylist = "<polylist material=\"skin\" count=\"2\">";
const std::string describe_polylist = "<polylist material=\"skin\">: ";
const std::string matrix = "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>";
const std::string spot =
    "<spot>\n          <color>1 2 3</color>\n          <falloff_angle>60</falloff_angle>\n"
    "          <falloff_exponent>1</falloff_exponent>\n        </spot>";
const std::string camera_kind = "<perspective>\n            <xfov>40</xfov>\n          </perspective>";

const Mistake mistakes[] = {
    // The document
    {"WrongRootVersion", "version=\"1.4.1\"", "version=\"1.5.0\"", "<COLLADA",
     "<COLLADA>: version \"1.5.0\" is not 1.4.1"},
    {"MissingVersion", " version=\"1.4.1\"", "", "<COLLADA",
     "<COLLADA>: attribute \"version\" is missing"},
    {"UnknownAtTheTop", "<library_nodes>", "<wishes/><library_nodes>", "<wishes",
     "<wishes>: not known inside <COLLADA>"},
    {"OtherEncoding", "encoding=\"utf-8\"", "encoding=\"iso-8859-1\"", "<?xml",
     "<?xml>: encoding \"iso-8859-1\" is not UTF-8"},
    {"DocumentType", "<!-- One of everything. -->", "<!DOCTYPE COLLADA>", "<!DOCTYPE",
     "<!DOCTYPE>: declarations are not allowed"},
    {"EntityBomb", "<!-- One of everything. -->",
     "<!DOCTYPE b [\n<!ENTITY a \"aaaaaaaaaa\">\n<!ENTITY b \"&a;&a;&a;&a;\">]>", "<!DOCTYPE",
     "<!DOCTYPE>: declarations are not allowed"},
    {"EntityInside", "<falloff_angle>60", "<!ENTITY a \"60\">\n<falloff_angle>&a;", "<!ENTITY",
     "<!ENTITY>: declarations are not allowed"},
    {"UndefinedEntity", "<radius>0.5", "<radius>&half;", "<radius>",
     "<radius>: \"&half;\" is not a number"},
    {"AttributeTwice", "symbol=\"any\"", "symbol=\"any\" symbol=\"none\"", "symbol=\"any\"",
     "not well-formed XML: parsing attribute"},
    {"IdOfTwo", "<geometry id=\"ball\">", "<geometry id=\"quad\" name=\"ball\">",
     "<instance_geometry url=\"#quad\">",
     "<instance_geometry url=\"#quad\">: two elements have the id \"quad\": the <geometry> in line " +
         line_of("<geometry id=\"quad\">") + " and the <geometry> in line " +
         line_of("<geometry id=\"ball\">")},
    {"IdOfTwoKinds", "<library_lights>", "<library_lights><light id=\"grey\"/>", "target=\"#grey\"",
     "<instance_material target=\"#grey\">: two elements have the id \"grey\": the <light> in line " +
         line_of("<library_lights>") + " and the <material> in line " +
         line_of("<material id=\"grey\">")},
    {"IdOfThree", "<library_lights>", "<extra><a id=\"pair\"/><b id=\"pair\"/></extra><library_lights>",
     "url=\"#pair\"",
     "<instance_node url=\"#pair\">: 3 elements have the id \"pair\": the <a> in line " +
         line_of("<library_lights>") + ", the <b> in line " + line_of("<library_lights>") +
         " and so on"},
    {"SecondScene", "<scene>", "<scene/><scene>", "<scene/>", "<scene>: a second <scene> in <COLLADA>"},
    {"NoScene", "<scene>\n    <instance_visual_scene url=\"#scene\"/>\n  </scene>", "", "<COLLADA",
     "<COLLADA>: no <scene> in it"},
    {"EmptyScene", "<instance_visual_scene url=\"#scene\"/>", "", "<scene>",
     "<scene>: no <instance_visual_scene> in it"},
    {"Physics", "<scene>", "<scene><instance_physics_scene url=\"#p\"/>", "<scene>",
     "<instance_physics_scene url=\"#p\">: not known inside <scene>"},
    // References
    {"MissingVisualScene", "url=\"#scene\"", "url=\"#scenery\"", "url=\"#scenery\"",
     "<instance_visual_scene url=\"#scenery\">: nothing has the id \"scenery\""},
    {"MissingGeometry", "url=\"#ball\"", "url=\"#bell\"", "url=\"#bell\"",
     "<instance_geometry url=\"#bell\">: nothing has the id \"bell\""},
    {"MissingMaterial", "target=\"#grey\"", "target=\"#gray\"", "target=\"#gray\"",
     "<instance_material target=\"#gray\">: nothing has the id \"gray\""},
    {"MissingEffect", "url=\"#grey-effect\"", "url=\"#gone\"", "url=\"#gone\"",
     "<instance_effect url=\"#gone\">: nothing has the id \"gone\""},
    {"MissingArray", "source=\"#quad-array\"", "source=\"#gone\"", "source=\"#gone\"",
     "<accessor source=\"#gone\">: nothing has the id \"gone\""},
    {"MissingSource", "source=\"#quad-positions\"", "source=\"#gone\"", "source=\"#gone\"",
     "<input semantic=\"POSITION\">: nothing has the id \"gone\""},
    {"WrongKindOfReference", "url=\"#eye\"", "url=\"#bulb\"", "<instance_camera",
     "<instance_camera url=\"#bulb\">: \"#bulb\" is a <light>, not a <camera>"},
    {"OtherFile", "url=\"#eye\"", "url=\"other.dae#eye\"", "<instance_camera",
     "<instance_camera url=\"other.dae#eye\">: url \"other.dae#eye\" is not of the form \"#id\": other "
     "files are not read"},
    {"EmptyReference", "url=\"#eye\"", "url=\"#\"", "<instance_camera",
     "<instance_camera url=\"#\">: url \"#\" is not of the form \"#id\": other files are not read"},
    {"MissingUrl", " url=\"#eye\"", "", "<instance_camera",
     "<instance_camera>: attribute \"url\" is missing"},
    {"CyclicNodes", "<node id=\"pair\">", "<node id=\"pair\"><instance_node url=\"#pair\"/>",
     "<node id=\"pair\">", "<node id=\"pair\">: contains an instance of itself"},
    {"CycleOfTwo", "<node id=\"pair\">", "<node id=\"pair\"><instance_node url=\"#things\"/>",
     "<node id=\"things\">", "<node id=\"things\">: contains an instance of itself"},
    // Nodes and transforms
    {"UnknownInNode", "<scale>2 2 2</scale>", "<twist>9</twist>", "<twist>",
     "<twist>: not known inside <node id=\"things\">"},
    {"Controller", "<instance_node url=\"#pair\"/>", "<instance_controller url=\"#c\"/>",
     "<instance_controller", "<instance_controller url=\"#c\">: not known inside <node id=\"things\">"},
    {"TextInNode", "<scale>2 2 2</scale>", "2 2 2", "<node id=\"things\">",
     "<node id=\"things\">: text \"2 2 2\" is not known here"},
    {"ShortMatrix", matrix, "<matrix>1 0 0 0 0 1 0 0 0 0 1 0</matrix>", "<matrix>",
     "<matrix>: 12 numbers where there should be 16"},
    {"MatrixOfFifteen", matrix, "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 1</matrix>", "<matrix>",
     "<matrix>: 15 numbers where there should be 16"},
    {"PerspectiveMatrix", matrix, "<matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1</matrix>", "<matrix>",
     "<matrix>: the last row is not 0 0 0 1: a perspective transform has no meaning here"},
    {"SingularMatrix", matrix, "<matrix>1 0 0 0 0 1 0 0 1 1 0 0 0 0 0 1</matrix>",
     "<instance_geometry url=\"#quad\">",
     "<instance_geometry url=\"#quad\">: the transform of its node has no inverse"},
    {"ScaleToNothing", "<scale>2 2 2</scale>", "<scale>0 0 0</scale>",
     "<instance_geometry url=\"#quad\">",
     "<instance_geometry url=\"#quad\">: the transform of its node has no inverse"},
    {"OverflowingTransform", "<scale>2 2 2</scale>",
     "<scale>1e300 1e300 1e300</scale><scale>1e300 1e300 1e300</scale>",
     "<instance_geometry url=\"#quad\">",
     "<instance_geometry url=\"#quad\">: the transform of its node has no inverse"},
    {"VertexAtInfinity", matrix, "<matrix>5e307 0 0 1.7e308 0 5e307 0 0 0 0 5e307 0 0 0 0 1</matrix>",
     "<instance_geometry url=\"#quad\">",
     "<instance_geometry url=\"#quad\">: the transform of its node takes a vertex to infinity"},
    {"LightAtInfinity", "<translate>0 0 3</translate>",
     "<translate>0 0 1.7e308</translate><translate>0 0 1.7e308</translate>",
     "<instance_light url=\"#bulb\"/>",
     "<instance_light url=\"#bulb\">: the transform of its node takes it to infinity"},
    {"RotationAboutNothing", "<rotate>0 0 1 30</rotate>", "<rotate>0 0 0 30</rotate>", "<rotate>",
     "<rotate>: the axis has no direction"},
    {"LookingNowhere", "<lookat>0 -5 1 0 0 1 0 0 1</lookat>", "<lookat>0 -5 1 0 -5 1 0 0 1</lookat>",
     "<lookat>", "<lookat>: the view has no direction, or up points along it"},
    {"UpAlongTheView", "<lookat>0 -5 1 0 0 1 0 0 1</lookat>", "<lookat>0 -5 1 0 0 1 0 2 0</lookat>",
     "<lookat>", "<lookat>: the view has no direction, or up points along it"},
    {"Skew", "<rotate>0 0 1 30</rotate>", "<skew>30 1 0 0 0 1 0</skew>", "<skew>",
     "<skew>: not supported: write it as a <matrix>"},
    {"Ellipsoid", "<scale>2 2 2</scale>", "<scale>2 2 3</scale>", "<instance_geometry url=\"#ball\">",
     "<instance_geometry url=\"#ball\">: an ellipsoid: the transform of its node stretches a sphere by "
     "2.000000, 2.000000, 3.000000"},
    {"EvaluateScene", "<node id=\"view\">", "<evaluate_scene/><node id=\"view\">", "<evaluate_scene/>",
     "<evaluate_scene>: not known inside <visual_scene id=\"scene\">"},
    // Numbers
    {"NaN", array, "<float_array id=\"quad-array\" count=\"12\">0 0 NaN 1 0 0 1 1 0 0 1 0</float_array>",
     array_start, "<float_array id=\"quad-array\">: \"NaN\" is not a finite number"},
    {"Infinity", array,
     "<float_array id=\"quad-array\" count=\"12\">0 0 -inf 1 0 0 1 1 0 0 1 0</float_array>", array_start,
     "<float_array id=\"quad-array\">: \"-inf\" is not a finite number"},
    {"TooLargeForADouble", array,
     "<float_array id=\"quad-array\" count=\"12\">0 0 1e400 1 0 0 1 1 0 0 1 0</float_array>",
     array_start, "<float_array id=\"quad-array\">: \"1e400\" is out of the range of a double"},
    {"DecimalComma", array,
     "<float_array id=\"quad-array\" count=\"12\">0 0 0,5 1 0 0 1 1 0 0 1 0</float_array>", array_start,
     "<float_array id=\"quad-array\">: \"0,5\" is not a number"},
    {"NoNumber", "<xfov>40</xfov>", "<xfov/>", "<xfov/>", "<xfov>: 0 numbers where there should be 1"},
    // Meshes
    {"WrongArrayCount", array_start + " count=\"12\"", array_start + " count=\"11\"", array_start,
     "<float_array id=\"quad-array\">: count is 11, but it holds 12 numbers"},
    {"HugeArrayCount", array_start + " count=\"12\"", array_start + " count=\"1000000000\"", array_start,
     "<float_array id=\"quad-array\">: count is 1000000000, but it holds 12 numbers"},
    {"MissingArrayCount", array_start + " count=\"12\"", array_start, array_start,
     "<float_array id=\"quad-array\">: attribute \"count\" is missing"},
    {"HugeAccessorCount", accessor,
     "<accessor source=\"#quad-array\" count=\"1000000000\" stride=\"3\">", "<accessor",
     describe_accessor + "it reaches beyond the 12 numbers of its array"},
    {"HugeStride", accessor,
     "<accessor source=\"#quad-array\" count=\"4294967295\" stride=\"4294967295\">", "<accessor",
     describe_accessor + "it reaches beyond the 12 numbers of its array"},
    {"HugeOffset", accessor,
     "<accessor source=\"#quad-array\" count=\"1\" offset=\"4294967295\" stride=\"3\">", "<accessor",
     describe_accessor + "it reaches beyond the 12 numbers of its array"},
    {"OneNumberTooFew", accessor,
     "<accessor source=\"#quad-array\" count=\"4\" stride=\"3\" offset=\"1\">", "<accessor",
     describe_accessor + "it reaches beyond the 12 numbers of its array"},
    {"StrideBelowParams", accessor, "<accessor source=\"#quad-array\" count=\"4\" stride=\"2\">",
     "<accessor", describe_accessor + "stride is 2, less than its <param>s"},
    {"StrideZero", accessor, "<accessor source=\"#quad-array\" count=\"4\" stride=\"0\">", "<accessor",
     describe_accessor + "stride is 0, less than its <param>s"},
    {"CountNoNumber", accessor, "<accessor source=\"#quad-array\" count=\"four\" stride=\"3\">",
     "<accessor", describe_accessor + "\"four\" is not a whole number"},
    {"CountNegative", accessor, "<accessor source=\"#quad-array\" count=\"-4\" stride=\"3\">",
     "<accessor", describe_accessor + "\"-4\" is negative"},
    {"CountOfTwoWords", accessor, "<accessor source=\"#quad-array\" count=\"4 4\" stride=\"3\">",
     "<accessor", describe_accessor + "attribute \"count\" is not one number"},
    {"NoZ", "<param name=\"Z\" type=\"float\"/>", "", "<accessor",
     describe_accessor + "no <param name=\"Z\">: not positions in space"},
    {"TwoX", "<param name=\"Z\" type=\"float\"/>", "<param name=\"X\" type=\"float\"/><!-- here -->",
     "<!-- here -->", "<param name=\"X\">: a second one of that name"},
    {"NamesForNumbers", "<param name=\"Z\" type=\"float\"/>", "<param name=\"Z\" type=\"Name\"/>",
     "type=\"Name\"", "<param name=\"Z\">: its type is neither float nor double"},
    {"NoPositions", "<input semantic=\"POSITION\" source=\"#quad-positions\"/>", "", "<vertices",
     "<vertices id=\"quad-vertices\">: no <input semantic=\"POSITION\"> in it"},
    {"NoVertexInput", vertex_input, "", "<polylist",
     describe_polylist + "no <input semantic=\"VERTEX\"> in it"},
    {"TwoVertexInputs", vertex_input,
     vertex_input + "\n<input semantic=\"VERTEX\" source=\"#other\" offset=\"0\"/>", "#other",
     "<input semantic=\"VERTEX\">: a second one of that semantic"},
    {"VertexInputElsewhere", "source=\"#quad-vertices\"", "source=\"#quad-positions\" set=\"7\"",
     "set=\"7\"", "<input semantic=\"VERTEX\">: \"#quad-positions\" is a <source>, not a <vertices>"},
    {"NoOffset", "source=\"#quad-vertices\" offset=\"0\"", "source=\"#quad-vertices\"", "\"VERTEX\"",
     "<input semantic=\"VERTEX\">: attribute \"offset\" is missing"},
    {"HugeInputOffset", "offset=\"1\"", "offset=\"1000000000\"", "\"NORMAL\"",
     "<input semantic=\"NORMAL\">: offset 1000000000 is not below 1000"},
    {"IndexOutOfRange", corners, "<p>0 0 1 0 2 0 0 0 1 0 2 0 4 0</p>", "<p>",
     "<p>: vertex index 4 is out of range: there are 4 vertices"},
    {"NegativeIndex", corners, "<p>0 0 1 0 2 0 0 0 1 0 2 0 -1 0</p>", "<p>", "<p>: \"-1\" is negative"},
    {"HugeIndex", corners, "<p>0 0 1 0 2 0 0 0 1 0 2 0 99999999999 0</p>", "<p>",
     "<p>: \"99999999999\" is too large"},
    {"FractionalIndex", corners, "<p>0 0 1 0 2 0 0 0 1 0 2 0 1.5 0</p>", "<p>",
     "<p>: \"1.5\" is not a whole number"},
    {"TooFewIndices", corners, "<p>0 0 1 0 2 0 0 0 1 0 2 0</p>", "<polylist",
     describe_polylist + "<vcount> asks for 7 corners, but <p> lists 6"},
    {"TooManyIndices", corners, "<p>0 0 1 0 2 0 0 0 1 0 2 0 3 0 3 0</p>", "<polylist",
     describe_polylist + "<vcount> asks for 7 corners, but <p> lists 8"},
    {"HalfACorner", corners, "<p>0 0 1 0 2 0 0 0 1 0 2 0 3</p>", "<p>",
     "<p>: 13 indices are no multiple of the 2 that each corner takes"},
    {"NoIndices", corners, "", "<polylist",
     describe_polylist + "<vcount> asks for 7 corners, but <p> lists 0"},
    {"TwoListsOfIndices", corners, corners + "\n<p />", "<p />",
     "<p>: a second <p> in <polylist material=\"skin\">"},
    {"WrongPolygonCount", polylist, "<polylist material=\"skin\" count=\"3\">", "<polylist",
     describe_polylist + "count is 3, but it holds 2 polygons"},
    {"HugePolygonCount", polylist, "<polylist material=\"skin\" count=\"1000000000\">", "<polylist",
     describe_polylist + "count is 1000000000, but it holds 2 polygons"},
    {"HugeVcount", "<vcount>3 4</vcount>", "<vcount>3 1000000000</vcount>", "<polylist",
     describe_polylist + "<vcount> asks for 1000000003 corners, but <p> lists 7"},
    {"NoVcount", "<vcount>3 4</vcount>", "", "<polylist",
     describe_polylist + "count is 2, but it holds 0 polygons"},
    {"Holes", "<vcount>3 4</vcount>", "<ph/>", "<ph/>",
     "<ph>: not known inside <polylist material=\"skin\">"},
    {"Strips", "<polylist material=\"skin\"", "<tristrips count=\"0\"/><polylist material=\"skin\"",
     "<tristrips", "<tristrips>: not known inside <mesh>"},
    {"ConvexHull", "<geometry id=\"quad\">", "<geometry id=\"quad\"><convex_mesh/>", "<convex_mesh/>",
     "<convex_mesh>: not known inside <geometry id=\"quad\">"},
    {"NoMesh",
     "<extra>\n        <technique profile=\"CMU462\">\n          <sphere>\n            "
     "<radius>0.5</radius>\n          </sphere>\n        </technique>\n      </extra>",
     "", "<geometry id=\"ball\">", "<geometry id=\"ball\">: no <mesh> in it"},
    // Spheres
    {"ZeroRadius", "<radius>0.5</radius>", "<radius>0</radius>", "<radius>",
     "<radius>: a radius is positive"},
    {"NegativeRadius", "<radius>0.5</radius>", "<radius>-1</radius>", "<radius>",
     "<radius>: a radius is positive"},
    {"NoRadius", "<radius>0.5</radius>", "", "<sphere>", "<sphere>: no <radius> in it"},
    {"UnknownShape", "<sphere>\n            <radius>0.5</radius>\n          </sphere>", "<torus/>",
     "<torus/>", "<torus>: not known inside <technique>"},
    // Materials
    {"SphereOfTwoMaterials", "<instance_material symbol=\"any\" target=\"#glass\"/>",
     "<instance_material symbol=\"any\" target=\"#glass\"/><instance_material symbol=\"other\" "
     "target=\"#grey\" sid=\"2\"/>",
     "<instance_geometry url=\"#ball\">",
     "<instance_geometry url=\"#ball\">: a sphere takes one material, not 2"},
    {"SymbolTwice", "<instance_material symbol=\"any\" target=\"#glass\"/>",
     "<instance_material symbol=\"any\" target=\"#glass\"/>\n<instance_material symbol=\"any\" "
     "target=\"#grey\" sid=\"2\"/>",
     "sid=\"2\"", "<instance_material target=\"#grey\">: binds its symbol a second time"},
    {"Texture", "<color>0.5 0.5 0.5 1</color>", "<texture texture=\"wood\"/>", "<texture",
     "<texture>: textures are not supported"},
    {"BrightAlbedo", "<color>0.5 0.5 0.5 1</color>", "<color>0.5 1.5 0.5 1</color>", "<color>0.5",
     "<color>: greater than 1: no surface reflects more than it receives"},
    {"NegativeAlbedo", "<color>0.5 0.5 0.5 1</color>", "<color>0.5 -0.5 0.5 1</color>", "<color>0.5",
     "<color>: a negative colour"},
    {"ShortColour", "<color>0.5 0.5 0.5 1</color>", "<color>0.5 0.5</color>", "<color>0.5",
     "<color>: 2 numbers where there should be 3"},
    {"ParameterReference", "<color>0.5 0.5 0.5 1</color>", "<param ref=\"c\"/>", "<param ref",
     "<param>: not known inside <diffuse>"},
    {"NoDiffuseColour", "<diffuse>\n              <color>0.5 0.5 0.5 1</color>\n            </diffuse>",
     "", "<lambert>", "<lambert>: no <diffuse> in it, and no material of the CMU462 profile"},
    {"NoShader",
     "<lambert>\n            <diffuse>\n              <color>0.5 0.5 0.5 1</color>\n            "
     "</diffuse>\n          </lambert>",
     "", "<technique sid=\"common\">",
     "<technique>: no <phong>, <lambert>, <blinn> or <constant> in it"},
    {"TwoShaders", "<lambert>", "<phong/><lambert>", "<lambert>",
     "<lambert>: a second shader beside <phong>"},
    {"RoughGlass", "<roughness>0</roughness>", "<roughness>0.1</roughness>", "<roughness>",
     "<roughness>: only smooth glass (roughness 0) is supported"},
    {"Refraction", "<glass>", "<refraction/><glass>", "<glass>",
     "<glass>: a second material beside <refraction>"},
    {"NoIndexOfRefraction", "<ior>1.45</ior>", "", "<glass>", "<glass>: no <ior> in it"},
    {"ZeroIndexOfRefraction", "<ior>1.45</ior>", "<ior>0</ior>", "<ior>",
     "<ior>: an index of refraction is positive"},
    {"NegativeIndexOfRefraction", "<ior>1.45</ior>", "<ior>-1.45</ior>", "<ior>",
     "<ior>: an index of refraction is positive"},
    {"BrightGlass", "<transmittance>0.8 0.8 0.8<", "<transmittance>1.8 0.8 0.8<", "<transmittance>",
     "<transmittance>: greater than 1: no surface reflects more than it receives"},
    {"UnknownMaterial", "<glass>", "<velvet/><glass>", "<velvet/>",
     "<velvet>: not known inside <technique>"},
    {"UnknownInGlass", "<roughness>0</roughness>", "<haze>0</haze>", "<haze>",
     "<haze>: not known inside <glass>"},
    {"ProfileInTheWrongPlace", "<mesh>",
     "<mesh><extra><technique profile=\"CMU462\"><fur/></technique></extra>", "<fur/>",
     "<fur>: the CMU462 profile does not apply to <mesh>"},
    {"ProfileOutsideExtra", "<light id=\"panel\">",
     "<light id=\"panel\"><technique profile=\"CMU462\"/>", "<light id=\"panel\">",
     "<technique>: the CMU462 profile belongs in an <extra>"},
    {"ProfileTwice", "<light id=\"panel\">",
     "<light id=\"panel\"><extra><technique profile=\"CMU462\"><point/></technique></extra>",
     "<technique profile=\"CMU462\">\n          <area>",
     "<technique>: a second CMU462 profile for <light id=\"panel\">"},
    {"ChangedParameter", "<instance_effect url=\"#grey-effect\"/>",
     "<instance_effect url=\"#grey-effect\"><setparam/></instance_effect>", "<setparam/>",
     "<setparam>: not known inside <instance_effect url=\"#grey-effect\">"},
    // Lights
    {"UnknownLight", spot, "<laser/>", "<light id=\"bulb\">",
     "<light id=\"bulb\">: unknown kind <laser>"},
    {"SecondLight", spot, spot + "\n<point/>", "<point/>",
     "<point>: a second kind of light beside <spot>"},
    {"AreaInTheCommonProfile", spot, "<area><color>1 2 3</color></area>", "<light id=\"bulb\">",
     "<light id=\"bulb\">: unknown kind <area>"},
    {"LightWithoutColour", "<color>1 2 3</color>", "", "<spot>", "<spot>: no <color> in it"},
    {"UnknownInLight", "<color>1 2 3</color>", "<color>1 2 3</color><cookie/>", "<cookie/>",
     "<cookie>: not known inside <spot>"},
    {"NoLight", "<area>\n            <color>4 4 4</color>\n          </area>", "",
     "<light id=\"panel\">", "<light id=\"panel\">: no <technique_common> in it"},
    {"NegativeLight", "<color>1 2 3</color>", "<color>1 -2 3</color>", "<color>1 -2",
     "<color>: a negative colour"},
    {"LightWithAlpha", "<color>1 2 3</color>", "<color>1 2 3 1</color>", "<color>1 2 3 1",
     "<color>: 4 numbers where there should be 3"},
    {"ZeroFalloffAngle", "<falloff_angle>60</falloff_angle>", "<falloff_angle>0</falloff_angle>",
     "<spot>", "<spot>: <falloff_angle>: not in (0, 360] degrees"},
    {"TooWideFalloffAngle", "<falloff_angle>60</falloff_angle>", "<falloff_angle>361</falloff_angle>",
     "<spot>", "<spot>: <falloff_angle>: not in (0, 360] degrees"},
    {"TinyFalloffAngle", "<falloff_angle>60</falloff_angle>", "<falloff_angle>1e-9</falloff_angle>",
     "<spot>", "<spot>: <falloff_angle>: too narrow to be told from nothing"},
    {"NegativeFalloffExponent", "<falloff_exponent>1</falloff_exponent>",
     "<falloff_exponent>-1</falloff_exponent>", "<spot>", "<spot>: <falloff_exponent>: negative"},
    {"FlatSpot", "<translate>0 0 3</translate>", "<scale>1 1 0</scale>",
     "<instance_light url=\"#bulb\"/>",
     "<instance_light url=\"#bulb\">: the transform of its node leaves it no direction"},
    {"FlatPanel", "<translate>0 0 3</translate>", "<scale>1 0 1</scale>",
     "<instance_light url=\"#panel\"/>",
     "<instance_light url=\"#panel\">: the transform of its node has no inverse"},
    // Cameras
    {"ZeroFieldOfView", "<xfov>40</xfov>", "<xfov>0</xfov>", "<xfov>",
     "<xfov>: not between 0 and 180 degrees"},
    {"StraightFieldOfView", "<xfov>40</xfov>", "<xfov>180</xfov>", "<xfov>",
     "<xfov>: not between 0 and 180 degrees"},
    {"NegativeFieldOfView", "<xfov>40</xfov>", "<yfov>-40</yfov>", "<yfov>",
     "<yfov>: not between 0 and 180 degrees"},
    {"NoFieldOfView", "<xfov>40</xfov>", "<aspect_ratio>1.5</aspect_ratio>", "<perspective>",
     "<perspective>: neither <xfov> nor <yfov> in it"},
    {"Orthographic", camera_kind, "<orthographic/>", "<orthographic/>",
     "<orthographic>: not known inside <technique_common>"},
    {"FlatCamera", "<lookat>0 -5 1 0 0 1 0 0 1</lookat>", "<scale>1 1 0</scale>", "<instance_camera",
     "<instance_camera url=\"#eye\">: the transform of its node has no inverse"},
    {"ShearedCamera", "<lookat>0 -5 1 0 0 1 0 0 1</lookat>",
     "<matrix>1 0.1 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix>", "<instance_camera",
     "<instance_camera url=\"#eye\">: the transform of its node shears the camera"},
};

INSTANTIATE_TEST_SUITE_P(Table, MalformedElement, testing::ValuesIn(mistakes),
                         [](const auto& tested) { return std::string(tested.param.name); });

// Files that are wrong as a whole.

std::string as_utf16(std::string_view text)
{
    std::string result = "\xFF\xFE";
    for (const char c : text) result += {c, '\0'};
    return result;
}

std::string repeated(const std::string& text, int times)
{
    std::string result;
    for (int i = 0; i < times; ++i) result += text;
    return result;
}

TEST(MalformedFiles, WhatIsNoXmlAtAllIsRefused)
{
    EXPECT_EQ(error_of(""), "bad.dae:1: the file is empty");
    EXPECT_EQ(error_of(" \n\n"), "bad.dae:1: not well-formed XML: empty document");
    EXPECT_EQ(error_of("v 0 0 0\nf 1 1 1\n"), "bad.dae:1: not well-formed XML: parsing text");
    EXPECT_EQ(error_of("<!-- nothing -->"), "bad.dae:1: no <COLLADA> element in the file");
    EXPECT_EQ(error_of("<?xml version=\"1.0\"?>\n<svg/>"), "bad.dae:2: <svg>: not a COLLADA file");
    EXPECT_EQ(error_of("<COLLADA>\n<asset>\n</COLLADA>"),
              "bad.dae:2: not well-formed XML: mismatched element");
    EXPECT_EQ(error_of("<COLLADA>\n</COLLADA>\n<COLLADA/>"),
              "bad.dae:3: <COLLADA>: a second element beside <COLLADA>");
    EXPECT_EQ(error_of("\n<COLLADA/>and more"), "bad.dae:2: not well-formed XML: parsing text");
    EXPECT_EQ(error_of("\nbefore it <COLLADA/>"), "bad.dae:2: text outside of <COLLADA>");
}

TEST(MalformedFiles, WhatIsNotUtf8IsRefused)
{
    EXPECT_EQ(error_of("<COLLADA>\n<!-- caf\xE9 --></COLLADA>"),
              "bad.dae:2: byte 18 is not part of a text in UTF-8");
    EXPECT_EQ(error_of(as_utf16(valid_file)), "bad.dae:1: byte 0 is not part of a text in UTF-8");
    EXPECT_EQ(error_of(valid_file + std::string(1, '\0')),
              "bad.dae:" + std::to_string(1 + std::count(valid_file.begin(), valid_file.end(), '\n')) +
                  ": byte " + std::to_string(valid_file.size()) + " is not part of a text in UTF-8");
    EXPECT_EQ(error_of("\xEF\xBB\xBF" + valid_file), ""); // a byte order mark is allowed
}

TEST(MalformedFiles, DeepNestingIsRefusedBeforeItFillsTheStack)
{
    EXPECT_EQ(error_of(repeated("<a>", 1000000)), "bad.dae:1: elements nested deeper than 98");
    EXPECT_EQ(error_of(repeated("<a>\n", 99) + repeated("</a>", 99)),
              "bad.dae:99: elements nested deeper than 98");
    EXPECT_EQ(error_of(repeated("<a>\n", 98) + repeated("</a>", 98)),
              "bad.dae:1: <a>: not a COLLADA file");
}

TEST(MalformedFiles, LongAndOddNamesAreCutAndCleanedInMessages)
{
    std::string text = valid_file;
    const std::string url = "url=\"#pair\"";
    text.replace(position_of_only(text, url), url.size(),
                 "url=\"#&#10;" + std::string(10000, 'x') + "\"");
    const std::string error = error_of(text);
    EXPECT_LT(error.size(), 300);
    EXPECT_EQ(error.find('\n'), std::string::npos);
    EXPECT_NE(error.find("<instance_node url=\"#?xxx"), std::string::npos);
}

TEST(MalformedFiles, EveryTruncationIsNoticed)
{
    const std::string_view whole(valid_file.data(), valid_file.rfind('>') + 1);
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::string error = error_of(whole.substr(0, length));
        ASSERT_EQ(error.find("bad.dae:"), 0) << "the first " << length << " bytes";
        ASSERT_EQ(error.find('\n'), std::string::npos);
    }
    EXPECT_EQ(error_of(whole), "");
}

// For any bytes: a scene, or an error of one line that begins with the file's name.
RC_GTEST_PROP(MalformedFiles, RandomDamageIsSurvived, ())
{
    std::string text = valid_file;
    const int damages = *rc::gen::inRange(1, 6);
    for (int i = 0; i < damages; ++i) {
        const auto at =
            static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(text.size())));
        const auto length =
            std::min(text.size() - at, static_cast<std::size_t>(*rc::gen::inRange(0, 20)));
        const std::string junk =
            *rc::gen::element<std::string>("", "0", "-", "9999999999", "<", ">", "/", "\"", "<p>",
                                           "<extra/>", "\xFF", "nan", "#", "&", "<!--", " ");
        const auto from =
            static_cast<std::size_t>(*rc::gen::inRange<int>(0, static_cast<int>(text.size())));
        text.replace(at, length, *rc::gen::arbitrary<bool>() ? junk : text.substr(from, length));
    }
    const std::string error = error_of(text);
    RC_ASSERT(error.empty() || (error.find("bad.dae:") == 0 && error.find('\n') == std::string::npos));
}

std::string error_from_path(const std::filesystem::path& path)
{
    try {
        scenes::read_scene(path);
    } catch (const scenes::SceneError& error) {
        return error.what();
    }
    return "";
}

TEST(MalformedFiles, WhatIsNoFileIsRefused)
{
    const std::filesystem::path folder =
        std::filesystem::path(testing::TempDir()) / "plumbline-malformed.dae";
    std::filesystem::create_directory(folder);
    EXPECT_EQ(error_from_path(folder), "plumbline-malformed.dae: not a regular file");
    EXPECT_EQ(error_from_path(folder / "gone.dae"), "gone.dae: no such file");
    EXPECT_EQ(error_from_path(""), ": no such file");
    EXPECT_EQ(error_from_path("/dev/null"), "null: not a regular file");
    std::filesystem::remove(folder);
}

} // namespace
