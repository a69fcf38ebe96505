// Animations are not followed: those that would move or change the picture give a notice.

#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using Notices = std::vector<std::string>;

const std::string transforms_stand = "the animation is not followed: the nodes' own transforms are used";

std::string channel(const std::string& target)
{
    return "<channel source=\"#gone\" target=\"" + target + "\"/>";
}

/// The notices of a room whose file has these <animation>s, and of each kind of element one in use and
/// one not in use.
Notices notices_with(const std::string& animations)
{
    transport_test::SceneText text;
    text.cameras = "<camera id=\"eye\"><optics><technique_common><perspective><xfov>40</xfov>"
                   "</perspective></technique_common></optics></camera><camera id=\"spare-eye\"/>";
    text.lights = "<light id=\"bulb\"><technique_common><point><color sid=\"c\">1 1 1</color></point>"
                  "</technique_common></light><light id=\"spare-bulb\"/>";
    transport_test::add_material(text, "spare", "<velvet/>");
    text.geometries = transport_test::triangle_mesh("t") + transport_test::triangle_mesh("spare-t");
    text.library_nodes = "<node id=\"shared\">" + transport_test::instance_geometry("t") +
                         "</node><node id=\"spare-node\">" +
                         transport_test::instance_geometry("spare-t") + "</node>";
    text.nodes = "<node id=\"outer\"><node id=\"inner\"><translate sid=\"location\">0 0 1</translate>"
                 "<instance_node url=\"#shared\"/><instance_light url=\"#bulb\"/></node></node>"
                 "<node id=\"with.dot\"/><node id=\"twin\"/><node id=\"twin\"><instance_camera "
                 "url=\"#eye\"/></node>";
    std::string xml = text.str();
    xml.insert(xml.find("<library_cameras>"),
               "\n<library_animations>\n" + animations + "</library_animations>");
    return scenes::parse_scene(xml, "test.dae").notices;
}

std::string notice(const std::string& target, const std::string& what)
{
    return "test.dae:3: <channel target=\"" + target + "\">: " + what;
}

TEST(Animations, OfNodesInThePictureAreNoticed)
{
    for (const char* target : {"outer/matrix", "inner/location.X", "inner/location(0)", "shared/scale",
                               "twin/rotateX.ANGLE", "scene/sid/location", "inner", "with.dot",
                               "with.dot.X", "with.dot(3)(0)", "with.dot/location.X"})
        EXPECT_EQ(notices_with("<animation>" + channel(target) + "</animation>"),
                  Notices{notice(target, transforms_stand)});
}

TEST(Animations, OfOtherThingsInThePictureAreNoticed)
{
    const auto values_stand = [](const std::string& element) {
        return "the animation is not followed: the values in " + element + " are used";
    };
    for (const auto& [target, element] :
         {std::pair{"eye/xfov", "<camera id=\"eye\">"}, std::pair{"bulb/c.R", "<light id=\"bulb\">"},
          std::pair{"grey/x", "<material id=\"grey\">"},
          std::pair{"grey-effect/common/diffuse", "<effect id=\"grey-effect\">"},
          std::pair{"t/x", "<geometry id=\"t\">"}, std::pair{"t-a(3)", "<float_array id=\"t-a\">"}})
        EXPECT_EQ(notices_with("<animation>" + channel(target) + "</animation>"),
                  Notices{notice(target, values_stand(element))});
}

TEST(Animations, OfWhatIsNotInThePictureNeedNoWord)
{
    for (const char* target :
         {"spare-node/location.X", "spare-eye/xfov", "spare-bulb/c", "spare/x", "spare-effect/common",
          "spare-t/x", "spare-t-a(3)", "gone/location", "", "/", "./location", "(0)", "ou",
          "outer2/matrix", "with", "with/location.X", "with.X"})
        EXPECT_EQ(notices_with("<animation>" + channel(target) + "</animation>"), Notices{}) << target;
    EXPECT_EQ(notices_with("<animation><channel/></animation><twist/>"), Notices{});
}

TEST(Animations, AreFoundInsideOneAnother)
{
    EXPECT_EQ(notices_with("<animation><animation><source/>" + channel("outer/matrix") +
                           "</animation></animation>"),
              Notices{notice("outer/matrix", transforms_stand)});
}

TEST(Animations, AreNoticedOncePerTarget)
{
    EXPECT_EQ(notices_with("<animation>" + channel("outer/location.X") + channel("outer/location.Y") +
                           "</animation><animation>" + channel("outer/location.Z") +
                           channel("eye/xfov") + "</animation>")
                  .size(),
              2);
}

} // namespace
