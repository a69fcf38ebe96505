// Scenes for pbrt-v4, read back by the meaning that its documentation gives to directives.

#include "scenes/export/pbrt.h"
#include "tests/scenes/exported.h"
#include "tests/scenes/pbrt_grammar.h"

#include <rapidcheck/gtest.h>

#include <algorithm>

namespace {

using namespace scenes_test;
using scenes::exports::Options;

/// The text of `scene` for pbrt.
std::string pbrt_text(const Scene& scene, const Options& options = {})
{
    return scenes::exports::to_pbrt(scene, options, "a.pbrt").files.back().bytes;
}

/// What is between `before` and the next end of a line or `end` after it.
std::string after(const std::string& text, const std::string& before, char end = '\n')
{
    const std::size_t at = text.find(before);
    if (at == std::string::npos) throw std::runtime_error("no " + before + " in " + text);
    const std::size_t begin = at + before.size();
    return text.substr(begin, text.find(end, begin) - begin);
}

/// The numbers of the parameter `name`, such as "rgb L".
std::vector<double> parameter(const std::string& line, const std::string& name)
{
    return numbers_in(after(line, "\"" + name + "\" [", ']'));
}

Vec3 vector_parameter(const std::string& line, const std::string& name)
{
    return vector_in(after(line, "\"" + name + "\" [", ']'));
}

RC_GTEST_PROP(ExportPbrt, TheCameraSeesEveryPixelAlongOurRay, ())
{
    Scene scene = exported_scene();
    scene.camera = any_camera();
    const Options options = any_options();
    const std::string text = pbrt_text(scene, options);
    // The columns of the rotation from the world to the camera; it is applied after Translate.
    const std::vector<double> m = numbers_in(after(text, "Transform [", ']'));
    RC_ASSERT(m.size() == 16u);
    RC_ASSERT(-vector_in(after(text, "Translate ")) == scene.camera->eye);
    const std::string line = after(text, "Camera \"perspective\"");
    const double tan_half = glm::tan(glm::radians(parameter(line, "float fov").front()) / 2.0);
    const std::vector<double> window = parameter(line, "float screenwindow");
    expect_our_rays(
        *scene.camera, options,
        [&](double u, double v) { // +z forward, +x to the right; the picture's top is the window's
            const Vec3 local(tan_half * (window[0] + u * (window[1] - window[0])),
                             tan_half * (window[3] + v * (window[2] - window[3])), 1.0);
            return Vec3(glm::dot(local, Vec3(m[0], m[1], m[2])), glm::dot(local, Vec3(m[4], m[5], m[6])),
                        glm::dot(local, Vec3(m[8], m[9], m[10])));
        },
        1e-12);
    RC_ASSERT(parameter(text, "integer xresolution") == std::vector<double>{1.0 * options.width});
    RC_ASSERT(parameter(text, "integer yresolution") == std::vector<double>{1.0 * options.height});
}

TEST(ExportPbrt, TrianglesKeepTheirBitsAndWindingAndTheEmitterItsSide)
{
    const Scene scene = exported_scene();
    const std::string text = pbrt_text(scene);
    std::size_t at = text.find("WorldBegin");
    for (const std::uint32_t material : {0u, 1u}) {
        at = text.find("AttributeBegin", at);
        const std::string shape = text.substr(at, text.find("AttributeEnd", at) - at);
        at += shape.size();
        const std::vector<double> indices = parameter(shape, "integer indices");
        const std::vector<double> points = parameter(shape, "point3 P");
        std::vector<Corners> triangles(indices.size() / 3);
        for (std::size_t i = 0; i < indices.size(); ++i) {
            const auto first = 3 * static_cast<std::size_t>(indices[i]);
            triangles[i / 3][i % 3] = Vec3(points.at(first), points.at(first + 1), points.at(first + 2));
        }
        EXPECT_EQ(triangles, triangles_of(scene, material));
        ASSERT_EQ(shape.find("AreaLightSource") != std::string::npos, material == 1);
        EXPECT_EQ(shape.find("ReverseOrientation"), std::string::npos);
        if (material == 0) continue;
        EXPECT_EQ(vector_parameter(shape, "rgb L"), Rgb(17.3, 5.1, 2.0 / 3.0));
        EXPECT_NE(shape.find("NamedMaterial \"plumbline_black\""), std::string::npos);
    }
}

TEST(ExportPbrt, SpheresMaterialsAndLightsKeepTheirNumbers)
{
    Scene scene = exported_scene();
    scene.materials.emplace_back(scenes::Mirror{Rgb(0.9)});
    scene.materials.emplace_back(scenes::Glass{Rgb(1.0), Rgb(1.0), 1.33});
    scene.material_names.insert(scene.material_names.end(), {"mirror", "glass"});
    scene.spheres = {{Vec3(1, 2, 3.3), 0.1, 2}, {Vec3(4, 5, 6), 0.2, 3}};
    scene.point_lights = {{Vec3(0.1, 0.2, 0.3), Rgb(1.1, 2.2, 3.3)}, {Vec3(1), Rgb(0.0)}};
    const Vec3 w = glm::normalize(Vec3(1, -2, 3));
    scene.directional_lights = {{w, Rgb(4.4, 5.5, 6.6)}};
    scene.spot_lights = {{Vec3(7, 8, 9), w, Rgb(7.7, 8.8, 9.9), glm::cos(glm::radians(25.0)), 0.0}};
    scene.environment = Rgb(0.3, 0.2, 0.1);
    const std::string text = pbrt_text(scene);
    EXPECT_NE(text.find("NamedMaterial \"mirror_2\"\nTranslate 1 2 3.3\n"
                        "Shape \"sphere\" \"float radius\" [ 0.1 ]"),
              std::string::npos);
    EXPECT_NE(text.find("NamedMaterial \"glass_3\"\nTranslate 4 5 6\n"
                        "Shape \"sphere\" \"float radius\" [ 0.2 ]"),
              std::string::npos);
    const std::string mirror = after(text, "MakeNamedMaterial \"mirror_2\"");
    EXPECT_NE(mirror.find("\"plumbline_black\" \"plumbline_mirror\""), std::string::npos);
    EXPECT_EQ(parameter(mirror, "float amount"), std::vector<double>{0.9}); // of the second
    EXPECT_EQ(parameter(after(text, "MakeNamedMaterial \"glass_3\""), "float eta"),
              std::vector<double>{1.33});

    const std::string point = after(text, "LightSource \"point\"");
    EXPECT_EQ(vector_parameter(point, "rgb I"), Rgb(1.1, 2.2, 3.3));
    EXPECT_EQ(vector_parameter(point, "point3 from"), Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(text.find("LightSource \"point\""), text.rfind("LightSource \"point\""))
        << "a black light";
    const std::string sun = after(text, "LightSource \"distant\"");
    EXPECT_EQ(vector_parameter(sun, "rgb L"), Rgb(4.4, 5.5, 6.6));
    EXPECT_EQ(vector_parameter(sun, "point3 to") - vector_parameter(sun, "point3 from"), w);
    const std::string spot = after(text, "LightSource \"spot\"");
    EXPECT_EQ(vector_parameter(spot, "rgb I"), Rgb(7.7, 8.8, 9.9));
    EXPECT_EQ(parameter(spot, "float coneangle"), std::vector<double>{25});
    EXPECT_EQ(parameter(spot, "float conedeltaangle"), std::vector<double>{0});
    EXPECT_NE(text.find("Translate 7 8 9\nConcatTransform"), std::string::npos);
    const std::vector<double> m = numbers_in(after(text, "ConcatTransform [", ']'));
    EXPECT_EQ(Vec3(m.at(8), m.at(9), m.at(10)), w); // the third column: where +z goes
    EXPECT_EQ(vector_parameter(after(text, "LightSource \"infinite\""), "rgb L"), Rgb(0.3, 0.2, 0.1));
}

TEST(ExportPbrt, LongestPathsAndSamplesAreThoseOfTheOptions)
{
    Options options;
    options.max_edges = 6;
    options.samples = 123;
    const std::string text = pbrt_text(exported_scene(), options);
    EXPECT_EQ(parameter(text, "integer maxdepth"), std::vector<double>{5});
    EXPECT_EQ(parameter(text, "integer pixelsamples"), std::vector<double>{123});
    EXPECT_GT(parameter(pbrt_text(exported_scene()), "integer maxdepth").front(), 1e5);
}

TEST(ExportPbrt, EveryQuoteAndBracketIsClosedAndColoursAreNoticed)
{
    Scene scene = exported_scene();
    const auto exported = scenes::exports::to_pbrt(scene, {}, "a \"b\".pbrt");
    const std::string& text = exported.files.back().bytes;
    EXPECT_NE(text.find(R"("a \"b\".exr")"), std::string::npos);
    EXPECT_EQ(std::ranges::count(text, '['), std::ranges::count(text, ']'));
    EXPECT_EQ(std::ranges::count(text, '"') % 2, 0);
    EXPECT_EQ(exported.notices.size(), 1u);
    scene.materials = {scenes::Lambertian{Rgb(0.5)}, scenes::Emission{Rgb(2.0)}};
    EXPECT_TRUE(scenes::exports::to_pbrt(scene, {}, "a.pbrt").notices.empty());
}

TEST(ExportPbrt, TheGrammarOfItsDocumentationReadsAllOfIt)
{
    Scene scene = exported_scene();
    scene.materials.insert(scene.materials.end(),
                           {scenes::Mirror{Rgb(0.9)}, scenes::Glass{Rgb(1.0), Rgb(1.0), 1.5}});
    scene.material_names.insert(scene.material_names.end(), {"mirror", "glass"});
    scene.spheres = {{Vec3(1, 2, 3), 0.5, 2}, {Vec3(3, 2, 1), 1e-7, 3}};
    scene.point_lights = {{Vec3(1, 2, 3), Rgb(1, 2, 3)}};
    scene.directional_lights = {{Vec3(0, 0, -1), Rgb(1, 2, 3)}};
    scene.spot_lights = {{Vec3(1, 2, 3), Vec3(0, 0.6, 0.8), Rgb(1, 2, 3), 0.5, 0.0}};
    scene.environment = Rgb(0.1);
    const std::string text = pbrt_text(scene);
    EXPECT_EQ(fault_in_pbrt(text), "");
    // A grammar that reads everything says nothing.
    for (const auto& [right, wrong] : std::vector<std::pair<std::string, std::string>>{
             {"\"float fov\"", "\"float fovx\""},
             {"\"rgb L\" [ ", "\"rgb L\" [ 1 "},
             {"\"perspective\"", "\"pinhole\""},
             {"WorldBegin\n", ""},
             {"AttributeEnd\n", ""},
             {"NamedMaterial \"a_wall_0\"", "NamedMaterial \"a_wall\""},
             {"\"float radius\" [ 0.5 ]", "\"float radius\" [ nan ]"},
             {"\"float amount\"", "\"float weight\""}}) {
        std::string changed = text;
        const std::size_t at = changed.find(right);
        ASSERT_NE(at, std::string::npos) << right;
        EXPECT_NE(fault_in_pbrt(changed.replace(at, right.size(), wrong)), "") << right;
    }
}

} // namespace
