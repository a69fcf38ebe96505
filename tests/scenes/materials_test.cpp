#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace {

using scenes::Rgb;

/// The material of an <effect> with this content, read from a sphere that has it.
transport_test::SceneText with_effect(const std::string& content)
{
    transport_test::SceneText text;
    text.effects = "<effect id=\"e\">" + content + "</effect>";
    text.materials = "<material id=\"x\" name=\"other\"><instance_effect url=\"#e\"/></material>";
    text.geometries = transport_test::sphere_geometry("s", "1");
    text.nodes = transport_test::node(transport_test::instance_geometry("s", "x"));
    return text;
}

scenes::Material material_from(const std::string& content)
{
    const scenes::Scene scene = with_effect(content).parse();
    EXPECT_EQ(scene.material_names, std::vector<std::string>{"x"});
    return scene.materials.at(scene.spheres.at(0).material);
}

std::string common(const std::string& shader)
{
    return "<profile_COMMON><technique sid=\"common\">" + shader + "</technique></profile_COMMON>";
}

std::string cmu462(const std::string& kind)
{
    return "<extra><technique profile=\"CMU462\">" + kind + "</technique></extra>";
}

const std::string white = "<diffuse><color>1 1 1 1</color></diffuse>";

TEST(Materials, AnyShaderOfTheCommonProfileIsLambertianWithItsDiffuseColour)
{
    for (const std::string shader : {"phong", "lambert", "blinn"}) {
        const scenes::Material material = material_from(common(
            "<" + shader +
            "><emission><color>0 0 0 1</color></emission><ambient><color>1 1 1 1</color></ambient>"
            "<diffuse><color sid=\"diffuse\">0.1 0.2 0.3 1</color></diffuse><specular><color>0.5 0.5 "
            "0.5 1</color></specular>"
            "<shininess><float>50</float></shininess><reflectivity><float>0.2</float></reflectivity>"
            "<index_of_refraction><float>1</float></index_of_refraction></" +
            shader + ">"));
        EXPECT_EQ(std::get<scenes::Lambertian>(material).albedo, Rgb(0.1, 0.2, 0.3));
    }
    EXPECT_EQ(std::get<scenes::Lambertian>(
                  material_from(common("<lambert><diffuse><color>0 1 0</color></diffuse></lambert>")))
                  .albedo,
              Rgb(0, 1, 0)); // without alpha
}

TEST(Materials, TheCmu462ProfileGoesBeforeTheCommonOne)
{
    const std::string ignored =
        common("<phong>" + white + "<emission><color>1 1 1 1</color></emission></phong>");
    EXPECT_EQ(
        std::get<scenes::Mirror>(
            material_from(ignored + cmu462("<mirror><reflectance>0.3 0.2 0.1</reflectance></mirror>")))
            .reflectance,
        Rgb(0.3, 0.2, 0.1));
    const auto glass = std::get<scenes::Glass>(material_from(
        ignored + cmu462("<glass><reflectance>1 0.9 0.8</reflectance><transmittance>0.7 0.6 0.5"
                         "</transmittance><roughness>0</roughness><ior>1.45</ior></glass>")));
    EXPECT_EQ(glass.reflectance, Rgb(1, 0.9, 0.8));
    EXPECT_EQ(glass.transmittance, Rgb(0.7, 0.6, 0.5));
    EXPECT_EQ(glass.ior, 1.45);
    EXPECT_EQ(std::get<scenes::Emission>(
                  material_from(ignored + cmu462("<emission><radiance>10 20 30</radiance></emission>")))
                  .radiance,
              Rgb(10, 20, 30));
}

TEST(Materials, AnEmptyCmu462ProfileLeavesTheCommonOneInForce)
{
    const scenes::Material material =
        material_from(common("<phong>" + white + "</phong>") + cmu462("<!-- <mirror/> -->"));
    EXPECT_EQ(std::get<scenes::Lambertian>(material).albedo, Rgb(1, 1, 1));
}

TEST(Materials, GlassIsSmoothByDefaultAndAnIndexBelowOneIsFine)
{
    const auto glass = std::get<scenes::Glass>(
        material_from(cmu462("<glass><reflectance>1 1 1</reflectance><transmittance>1 1 "
                             "1</transmittance><ior>0.7</ior></glass>")));
    EXPECT_EQ(glass.ior, 0.7);
}

TEST(Materials, EmissionOfTheCommonProfileCountsWhereNothingIsReflected)
{
    const std::string emission = "<emission><color>1 2 3 1</color></emission>";
    for (const std::string& shader :
         {"<constant>" + emission + "</constant>", "<lambert>" + emission + "</lambert>",
          "<phong>" + emission + "<diffuse><color>0 0 0 1</color></diffuse></phong>"})
        EXPECT_EQ(std::get<scenes::Emission>(material_from(common(shader))).radiance, Rgb(1, 2, 3));
    EXPECT_EQ(transport_test::error_of(with_effect(common("<phong>" + emission + white + "</phong>"))),
              "test.dae:1: <color>: a surface that emits and reflects is not supported");
}

TEST(Materials, OpaqueTransparencyIsFineAndAnyOtherIsNot)
{
    const auto transparent = [](const std::string& text) {
        return common("<phong>" + white + text + "</phong>");
    };
    for (const char* text : {"<transparent opaque=\"A_ONE\"><color>0 0 0 "
                             "1</color></transparent><transparency><float>1</float></transparency>",
                             "<transparent><color>1 1 1 1</color></transparent>",
                             "<transparency><float>0</float></transparency>"})
        EXPECT_EQ(transport_test::error_of(with_effect(transparent(text))), "") << text;
    for (const char* text : {"<transparent><color>1 1 1 0.5</color></transparent>",
                             "<transparent opaque=\"RGB_ZERO\"><color>0 0 0 1</color></transparent>",
                             "<transparent><color>1 1 1 "
                             "1</color></transparent><transparency><float>0.5</float></transparency>"})
        EXPECT_NE(transport_test::error_of(with_effect(transparent(text)))
                      .find("transparency is not supported"),
                  std::string::npos)
            << text;
}

TEST(Materials, ThoseOfOneEffectKeepTheirOwnNames)
{
    transport_test::SceneText text = with_effect(common("<phong>" + white + "</phong>"));
    text.materials += "<material id=\"y\"><instance_effect url=\"#e\"/></material>";
    text.nodes += transport_test::node(transport_test::instance_geometry("s", "y") +
                                       transport_test::instance_geometry("s", "x"));
    const scenes::Scene scene = text.parse();
    EXPECT_EQ(scene.material_names, (std::vector<std::string>{"x", "y"}));
    EXPECT_EQ(scene.spheres[2].material, 0);
}

TEST(Materials, OnesThatNothingWearsAreNotLookedAt)
{
    transport_test::SceneText text = with_effect(common("<phong>" + white + "</phong>"));
    transport_test::add_material(text, "odd", "<velvet/>");
    EXPECT_EQ(text.parse().materials.size(), 1);
}

} // namespace
