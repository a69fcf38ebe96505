// What a format cannot say is an error that names it; every scene of the repository is exported or
// refused.

#include "scenes/export/gltf.h"
#include "scenes/export/mitsuba.h"
#include "scenes/export/pbrt.h"
#include "scenes/read_scene.h"
#include "tests/ref/transport/scene_files.h"
#include "tests/scenes/exported.h"
#include "tests/scenes/pbrt_grammar.h"

#include <map>
#include <set>

namespace {

using namespace scenes_test;
using Writer = scenes::exports::Exported (*)(const Scene&, const scenes::exports::Options&,
                                             const std::string&);

constexpr Writer mitsuba = scenes::exports::to_mitsuba;
constexpr Writer pbrt = scenes::exports::to_pbrt;
constexpr Writer gltf = scenes::exports::to_gltf;

/// The message of the SceneError of a writer; empty if it writes files.
std::string refusal(Writer writer, const Scene& scene)
{
    try {
        const auto exported = writer(scene, {}, "a.x");
        EXPECT_FALSE(exported.files.back().bytes.empty());
        EXPECT_EQ(exported.files.back().name, "a.x");
    } catch (const scenes::SceneError& error) {
        return error.what();
    }
    return "";
}

TEST(ExportScenes, EveryOneIsExportedOrRefusedForWhatItsFormatCannotSay)
{
    using namespace std::string_literals;
    const std::map<std::string, std::array<std::string, 2>> refused = {
        {"all_emitters",
         {"spot light 1: Mitsuba has no spot light that fades", "spot light 1: pbrt-v4 has no"}},
        {"spot_over_plane",
         {"spot light 1: Mitsuba has no spot light that fades", "spot light 1: pbrt-v4 has no"}},
        {"mirror_image", {"", "material \"mirror\": pbrt-v4 has no coloured mirror"}}};
    const std::set<std::string> without_spheres = {"area_light_over_plane", "flush_lights", "mesh_knot",
                                                   "near_occluder", "point_over_plane"};
    for (const std::string& name : transport_test::our_scene_names()) {
        const Scene scene = transport_test::our_scene(name);
        const auto found = refused.find(name);
        const auto expected = found == refused.end() ? std::array{""s, ""s} : found->second;
        const auto expect = [&](Writer writer, const std::string& message) {
            const std::string begin = message.empty() ? "" : name + ": " + message;
            EXPECT_EQ(refusal(writer, scene).substr(0, message.empty() ? 999 : begin.size()), begin);
        };
        expect(mitsuba, expected[0]);
        expect(pbrt, expected[1]);
        if (expected[1].empty()) {
            EXPECT_EQ(fault_in_pbrt(pbrt(scene, {}, "a.pbrt").files.back().bytes), "") << name;
        }
        expect(gltf, without_spheres.contains(name) ? ""
                     : name == "spot_over_plane"    ? "spot light 1: glTF's spot lights fade"
                                                    : "sphere 1 of ");
    }
}

struct Refused {
    const char* name;
    std::vector<Writer> writers;
    std::string message; // after the name of the scene
    void (*change)(Scene&);
};

class ExportRefuses : public testing::TestWithParam<Refused> {};

INSTANTIATE_TEST_SUITE_P(
    Export, ExportRefuses,
    testing::Values(Refused{"FadingSpot",
                            {mitsuba, pbrt, gltf},
                            "spot light 1: ",
                            [](Scene& scene) {
                                scene.spot_lights = {{Vec3(0), Vec3(0, 0, 1), Rgb(1), 0.5, 3.0}};
                            }},
                    Refused{"AnySpot",
                            {gltf},
                            "spot light 1: glTF's spot lights fade",
                            [](Scene& scene) {
                                scene.spot_lights = {{Vec3(0), Vec3(0, 0, 1), Rgb(1), 0.5, 0.0}};
                            }},
                    Refused{
                        "ColouredMirror",
                        {pbrt, gltf},
                        "material \"a wall\": ",
                        [](Scene& scene) { scene.materials[0] = scenes::Mirror{Rgb(0.9, 0.8, 0.7)}; }},
                    Refused{"AbsorbingMirror",
                            {gltf},
                            "material \"a wall\": glTF has no mirror that absorbs",
                            [](Scene& scene) { scene.materials[0] = scenes::Mirror{Rgb(0.9)}; }},
                    Refused{"ColouredTransmittance",
                            {pbrt},
                            "material \"a wall\": pbrt-v4 has no glass that absorbs",
                            [](Scene& scene) {
                                scene.materials[0] = scenes::Glass{Rgb(1), Rgb(1, 1, 0.9), 1.5};
                            }},
                    Refused{"DimReflectance",
                            {pbrt, gltf},
                            "material \"a wall\": ",
                            [](Scene& scene) {
                                scene.materials[0] = scenes::Glass{Rgb(0.9), Rgb(1), 1.5};
                            }},
                    Refused{"IndexBelowOne",
                            {gltf},
                            "material \"a wall\": glTF has no index of refraction below 1",
                            [](Scene& scene) {
                                scene.materials[0] = scenes::Glass{Rgb(1), Rgb(1), 0.9};
                            }},
                    Refused{"Sphere",
                            {gltf},
                            "sphere 1 of 1: glTF has no spheres",
                            [](Scene& scene) {
                                scene.spheres = {{Vec3(0), 1.0, 0}};
                            }},
                    Refused{"Environment",
                            {gltf},
                            "the environment: glTF has no light from every direction",
                            [](Scene& scene) { scene.environment = Rgb(0.1); }},
                    Refused{"FarFromTheOrigin",
                            {gltf},
                            "the triangles: glTF's coordinates are 32-bit floats",
                            [](Scene& scene) {
                                for (auto& triangle : scene.triangles)
                                    for (Vec3& v : triangle.vertices) v.x += 1e5;
                                scene.camera->eye.x += 1e5;
                            }},
                    Refused{"BeyondFloats",
                            {gltf},
                            "the triangles: glTF's coordinates are 32-bit floats",
                            [](Scene& scene) { scene.triangles[0].vertices[0].x = 1e39; }}),
    [](const auto& refused) { return std::string(refused.param.name); });

TEST_P(ExportRefuses, WhatTheFormatCannotSayAndNamesIt)
{
    Scene scene = exported_scene();
    GetParam().change(scene);
    for (const Writer writer : {mitsuba, pbrt, gltf}) {
        const std::string message = refusal(writer, scene);
        bool expected = false;
        for (const Writer refusing : GetParam().writers) expected = expected || refusing == writer;
        EXPECT_EQ(message.starts_with("small: " + GetParam().message), expected) << message;
        EXPECT_EQ(message.empty(), !expected) << message;
        EXPECT_EQ(message.find('\n'), std::string::npos);
    }
}

TEST(ExportScenes, BlackLightsAndTrianglesWithoutAreaAreNothing)
{
    Scene scene = exported_scene();
    scene.spot_lights = {{Vec3(0), Vec3(0, 0, 1), Rgb(0.0), 0.5, 3.0}};
    scene.environment = Rgb(0.0);
    scene.materials[1] = scenes::Emission{Rgb(0.0)};
    const Vec3 p(0.25);
    scene.triangles.push_back({{p, p, 2.0 * p}, 1});
    for (const Writer writer : {mitsuba, pbrt, gltf}) {
        EXPECT_EQ(refusal(writer, scene), "");
        const std::string text = writer(scene, {}, "a.x").files.back().bytes;
        for (const char* light : {"emitter", "LightSource", "emissive", "KHR_lights", "0.25 0.25 0.25"})
            EXPECT_EQ(text.find(light), std::string::npos) << text;
    }
}

} // namespace
