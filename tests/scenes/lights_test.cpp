#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace {

using scenes::Rgb;
using scenes::Vec3;

scenes::Scene with_light(const std::string& light, const std::string& transform = "")
{
    transport_test::SceneText text;
    text.lights = "<light id=\"l\">" + light + "</light>";
    text.nodes = transport_test::node(transform + "<instance_light url=\"#l\"/>");
    return text.parse();
}

std::string common(const std::string& kind)
{
    return "<technique_common>" + kind + "</technique_common>";
}

std::string cmu462(const std::string& kind)
{
    return "<extra><technique profile=\"CMU462\">" + kind + "</technique></extra>";
}

TEST(Lights, APointLightStandsAtItsNodeAndItsAttenuationIsIgnored)
{
    const scenes::Scene scene = with_light(
        common("<point><color>1 2 "
               "3</color><constant_attenuation>1</constant_attenuation><linear_attenuation>0"
               "</linear_attenuation><quadratic_attenuation>7</quadratic_attenuation></point>"),
        "<translate>4 5 6</translate><scale>0 0 0</scale>"); // a point: a singular transform is allowed
    ASSERT_EQ(scene.point_lights.size(), 1);
    EXPECT_EQ(scene.point_lights[0].position, Vec3(4, 5, 6));
    EXPECT_EQ(scene.point_lights[0].intensity, Rgb(1, 2, 3));
    EXPECT_TRUE(scene.notices.empty());
}

TEST(Lights, ADirectionalLightTravelsAlongLocalMinusZWithUnitDirection)
{
    const scenes::Scene scene = with_light(common("<directional><color>1 2 3</color></directional>"),
                                           "<matrix>1 0 3 9 0 1 0 9 0 0 -4 9 0 0 0 1</matrix>");
    ASSERT_EQ(scene.directional_lights.size(), 1);
    EXPECT_EQ(scene.directional_lights[0].direction, Vec3(-0.6, 0, 0.8));
    EXPECT_EQ(scene.directional_lights[0].irradiance, Rgb(1, 2, 3));
}

TEST(Lights, ASpotsAngleIsThatOfItsWholeCone)
{
    const scenes::Scene scene = with_light(
        common("<spot><color>1 2 3</color><falloff_angle>120</falloff_angle><falloff_exponent>2.5"
               "</falloff_exponent></spot>"),
        "<translate>4 5 6</translate><scale>2 2 3</scale>");
    ASSERT_EQ(scene.spot_lights.size(), 1);
    const scenes::SpotLight& spot = scene.spot_lights[0];
    EXPECT_EQ(spot.position, Vec3(4, 5, 6));
    EXPECT_EQ(spot.direction, Vec3(0, 0, -1));
    EXPECT_EQ(spot.intensity, Rgb(1, 2, 3));
    EXPECT_NEAR(spot.cos_cutoff, 0.5, 0x1p-52); // ulps(1) of the angle, ulps(1) of the cosine
    EXPECT_EQ(spot.exponent, 2.5);
}

TEST(Lights, ASpotDefaultsToAHemisphereOfConstantIntensity)
{
    const scenes::Scene scene = with_light(common("<spot><color>1 1 1</color></spot>"));
    ASSERT_EQ(scene.spot_lights.size(), 1);
    EXPECT_NEAR(scene.spot_lights[0].cos_cutoff, 0, 0x1p-53); // rounding of pi / 2
    EXPECT_EQ(scene.spot_lights[0].exponent, 0);
}

TEST(Lights, ASpotCanShineAllAround)
{
    const scenes::Scene scene =
        with_light(common("<spot><color>1 1 1</color><falloff_angle>360</falloff_angle></spot>"));
    EXPECT_EQ(scene.spot_lights.at(0).cos_cutoff, -1);
}

TEST(Lights, AmbientLightsAddUpToTheEnvironment)
{
    EXPECT_FALSE(with_light(common("<point><color>1 1 1</color></point>")).environment.has_value());
    transport_test::SceneText text;
    text.lights = "<light id=\"l\">" + common("<ambient><color>1 2 3</color></ambient>") + "</light>";
    text.nodes = transport_test::node("<scale>7 7 0</scale><instance_light url=\"#l\"/>") +
                 transport_test::node("<instance_light url=\"#l\"/>");
    EXPECT_EQ(text.parse().environment.value(), Rgb(2, 4, 6));
}

TEST(Lights, TheCmu462ProfileGoesBeforeTheCommonOne)
{
    const scenes::Scene scene = with_light(common("<point><color>9 9 9</color></point>") +
                                           cmu462("<directional><color>1 2 3</color></directional>"));
    EXPECT_TRUE(scene.point_lights.empty());
    EXPECT_EQ(scene.directional_lights.size(), 1);
    EXPECT_EQ(with_light(cmu462("<area><color>1 1 1</color></area>")).triangles.size(), 2);
    EXPECT_EQ(with_light(cmu462("<spot><color>1 1 1</color></spot>")).spot_lights.size(), 1);
    EXPECT_EQ(with_light(cmu462("<point><color>1 1 1</color></point>")).point_lights.size(), 1);
    EXPECT_TRUE(with_light(cmu462("<ambient><color>1 1 1</color></ambient>")).environment.has_value());
}

TEST(Lights, OtherProfilesAndAnEmptyOneAreIgnored)
{
    const scenes::Scene scene = with_light(
        common("<point><color>1 1 1</color></point>") +
        "<extra><technique profile=\"blender\"><area><color>nonsense</color></area></technique>"
        "<technique profile=\"CMU462\"><!-- <area/> --></technique></extra>");
    EXPECT_EQ(scene.point_lights.size(), 1);
}

TEST(Lights, ASceneWithoutAnyIsNoticed)
{
    const std::string notice = "test.dae:1: <COLLADA>: no emitter: the picture will be black";
    EXPECT_EQ(transport_test::SceneText().parse().notices, std::vector<std::string>{notice});
    for (const char* kind : {"point", "directional", "spot", "ambient"}) {
        const std::string name = kind;
        EXPECT_EQ(with_light(common("<" + name + "><color>0 0 0</color></" + name + ">")).notices,
                  std::vector<std::string>{notice});
        EXPECT_TRUE(
            with_light(common("<" + name + "><color>0 1 0</color></" + name + ">")).notices.empty());
    }
}

} // namespace
