// Scenes as glTF 2.0: the numbers in the file, and what Assimp reads from it.

#include "scenes/export/gltf.h"
#include "scenes/export/gltf_materials.h"
#include "tests/scenes/exported.h"

#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>

#include <cmath>

#ifdef PLUMBLINE_READS_MESHES
#include "scenes/read_mesh.h"
#include "tests/images/temporary_folder.h"
#include "tests/ref/transport/scene_files.h"

#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#endif

namespace {

using namespace scenes_test;
using nlohmann::json;
using scenes::exports::Options;

/// The JSON of `scene` as glTF.
json gltf_of(const Scene& scene, const Options& options = {})
{
    return json::parse(scenes::exports::to_gltf(scene, options, "a.gltf").files.back().bytes);
}

Vec3 json_vector(const json& numbers)
{
    return {numbers.at(0).get<double>(), numbers.at(1).get<double>(), numbers.at(2).get<double>()};
}

/// A column of a matrix that is written column by column.
Vec3 column(const json& matrix, std::size_t number)
{
    return {matrix.at(4 * number).get<double>(), matrix.at(4 * number + 1).get<double>(),
            matrix.at(4 * number + 2).get<double>()};
}

RC_GTEST_PROP(ExportGltf, TheCameraSeesEveryPixelAlongOurRay, ())
{
    Scene scene = exported_scene();
    scene.camera = any_camera();
    const Options options = any_options();
    const json file = gltf_of(scene, options);
    const json matrix = file["nodes"][0]["matrix"];
    RC_ASSERT(column(matrix, 3) == scene.camera->eye);
    const json camera = file["cameras"][0]["perspective"];
    const double y = glm::tan(camera["yfov"].get<double>() / 2.0);
    const double x = y * camera["aspectRatio"].get<double>();
    expect_our_rays(
        *scene.camera, options,
        [&](double u, double v) { // -z forward, +x to the right, +y up
            return x * (2 * u - 1) * column(matrix, 0) + y * (1 - 2 * v) * column(matrix, 1) -
                   column(matrix, 2);
        },
        1e-12);
}

RC_GTEST_PROP(ExportGltf, LightIsSplitIntoAColourAndAScaleWithoutRounding, ())
{
    const auto component = [] {
        return std::ldexp(*rc::gen::inRange(0, 1 << 20), *rc::gen::inRange(-60, 60));
    };
    const Rgb light(component(), component(), component());
    RC_PRE(light != Rgb(0.0));
    const auto [colour, scale] = scenes::exports::split(light);
    RC_ASSERT(colour * scale == light);
    for (int i = 0; i < 3; ++i) RC_ASSERT(colour[i] >= 0.0 && colour[i] <= 1.0);
}

TEST(ExportGltf, TheFrontOfAnEmitterShinesAndItsBackIsBlack)
{
    const json file = gltf_of(exported_scene());
    const json& primitives = file["meshes"][0]["primitives"];
    ASSERT_EQ(primitives.size(), 3u);
    const auto material = [&](std::size_t i) {
        return file["materials"][primitives[i]["material"].get<std::size_t>()];
    };
    EXPECT_TRUE(material(0)["doubleSided"]);
    EXPECT_FALSE(material(1)["doubleSided"]);
    EXPECT_FALSE(material(2)["doubleSided"]);
    EXPECT_FALSE(material(0).contains("emissiveFactor"));
    EXPECT_FALSE(material(2).contains("emissiveFactor"));
    const double strength =
        material(1)["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
    EXPECT_EQ(strength * json_vector(material(1)["emissiveFactor"]), Rgb(17.3, 5.1, 2.0 / 3.0));
    for (const std::size_t i : {0u, 1u, 2u}) {
        const json base = material(i)["pbrMetallicRoughness"];
        EXPECT_EQ(json_vector(base["baseColorFactor"]), i == 0 ? Rgb(0.1, 1.0 / 3.0, 0.7) : Rgb(0.0));
        EXPECT_EQ(base["metallicFactor"], 0.0);
        EXPECT_EQ(material(i)["extensions"]["KHR_materials_specular"]["specularFactor"], 0.0);
    }
    EXPECT_EQ(file["extensionsUsed"],
              json({"KHR_materials_emissive_strength", "KHR_materials_specular"}));
}

TEST(ExportGltf, MirrorsAndGlassUseTheirExtensions)
{
    Scene scene = exported_scene();
    scene.materials = {scenes::Mirror{Rgb(1.0)}, scenes::Glass{Rgb(1.0), Rgb(0.9, 0.8, 0.7), 1.33}};
    const json materials = gltf_of(scene)["materials"];
    EXPECT_EQ(
        materials[0]["pbrMetallicRoughness"],
        json::parse(R"({"baseColorFactor": [1, 1, 1, 1], "metallicFactor": 1, "roughnessFactor": 0})"));
    EXPECT_EQ(json_vector(materials[1]["pbrMetallicRoughness"]["baseColorFactor"]), Rgb(0.9, 0.8, 0.7));
    EXPECT_EQ(materials[1]["extensions"]["KHR_materials_transmission"]["transmissionFactor"], 1.0);
    EXPECT_EQ(materials[1]["extensions"]["KHR_materials_ior"]["ior"], 1.33);
    EXPECT_GT(materials[1]["extensions"]["KHR_materials_volume"]["thicknessFactor"], 0.0);
}

TEST(ExportGltf, LightsKeepTheirPlaceDirectionAndNumbers)
{
    Scene scene = exported_scene();
    const Vec3 w = glm::normalize(Vec3(1, -2, 3));
    scene.point_lights = {{Vec3(0.1, 0.2, 0.3), Rgb(1.1, 2.2, 3.3)}};
    scene.directional_lights = {{w, Rgb(4.4, 5.5, 6.6)}, {w, Rgb(0.0)}};
    const json file = gltf_of(scene);
    const json& lights = file["extensions"]["KHR_lights_punctual"]["lights"];
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0]["type"], "point");
    EXPECT_EQ(lights[0]["intensity"].get<double>() * json_vector(lights[0]["color"]),
              Rgb(1.1, 2.2, 3.3));
    EXPECT_EQ(lights[1]["type"], "directional");
    EXPECT_EQ(lights[1]["intensity"].get<double>() * json_vector(lights[1]["color"]),
              Rgb(4.4, 5.5, 6.6));
    EXPECT_EQ(json_vector(file["nodes"][2]["translation"]), Vec3(0.1, 0.2, 0.3));
    EXPECT_EQ(file["nodes"][2]["extensions"]["KHR_lights_punctual"]["light"], 0);
    EXPECT_EQ(-column(file["nodes"][3]["matrix"], 2), w); // along the local -z
    EXPECT_EQ(file["nodes"][3]["extensions"]["KHR_lights_punctual"]["light"], 1);
}

#ifdef PLUMBLINE_READS_MESHES

/// The triangles that a reader of `scene` as glTF must see: those of each material in turn, as floats,
/// and after each emitter its back.
std::vector<Corners> expected_triangles(const Scene& scene)
{
    std::vector<Corners> result;
    for (std::uint32_t material = 0; material < scene.materials.size(); ++material) {
        std::vector<Corners> triangles = triangles_of(scene, material);
        for (Corners& corners : triangles)
            for (Vec3& v : corners) v = Vec3(glm::vec3(v));
        result.insert(result.end(), triangles.begin(), triangles.end());
        if (!std::holds_alternative<scenes::Emission>(scene.materials[material])) continue;
        for (const Corners& front : triangles) result.push_back({front[0], front[2], front[1]});
    }
    return result;
}

/// Writes `scene` into `folder`. The file to read.
std::string write_gltf(const Scene& scene, const images_test::TemporaryFolder& folder,
                       const std::string& name)
{
    Options options;
    options.width = options.height = 64;
    for (const auto& file : scenes::exports::to_gltf(scene, options, name).files)
        images_test::write_bytes(folder / file.name, file.bytes);
    return (folder / name).string();
}

TEST(ExportGltf, AssimpReadsTheSameTriangles)
{
    const images_test::TemporaryFolder folder;
    for (const char* name :
         {"area_light_over_plane", "flush_lights", "mesh_knot", "near_occluder", "point_over_plane"})
        for (const char* file : {"a b%.gltf", "a.glb"}) {
            const Scene scene = transport_test::our_scene(name);
            const Scene read = scenes::read_mesh(write_gltf(scene, folder, file));
            std::vector<Corners> triangles;
            for (const auto& triangle : read.triangles) triangles.push_back(triangle.vertices);
            EXPECT_EQ(triangles, expected_triangles(scene)) << name;
        }
}

TEST(ReadMesh, TheFrontOfATriangleBelowAMirroredNodeIsTheImageOfItsFront)
{
    const images_test::TemporaryFolder folder;
    const Scene scene = transport_test::our_scene("point_over_plane");
    const std::string file = write_gltf(scene, folder, "a.gltf");
    json mirrored = json::parse(images_test::read_bytes(file));
    for (json& node : mirrored["nodes"])
        if (node.contains("mesh")) node["scale"] = {-1, 1, 1};
    images_test::write_bytes(file, mirrored.dump());
    std::vector<Corners> expected;
    for (const Corners& corners : expected_triangles(scene)) {
        const auto image = [&](std::size_t i) { return Vec3(-1, 1, 1) * corners[i]; };
        expected.push_back({image(0), image(2), image(1)});
    }
    std::vector<Corners> triangles;
    for (const auto& triangle : scenes::read_mesh(file).triangles)
        triangles.push_back(triangle.vertices);
    EXPECT_EQ(triangles, expected);
}

TEST(ExportGltf, AssimpReadsTheSameCameraAndLight)
{
    const images_test::TemporaryFolder folder;
    // Assimp 5.2 multiplies the angle of the height by the ratio of the sides: right for a square only.
    for (const char* name : {"flush_lights", "mesh_knot"}) {
        const Scene scene = transport_test::our_scene(name);
        Assimp::Importer importer;
        const aiScene* read = importer.ReadFile(write_gltf(scene, folder, "a.gltf"), 0);
        ASSERT_NE(read, nullptr) << importer.GetErrorString();
        ASSERT_EQ(read->mNumCameras, 1u);
        const aiCamera& camera = *read->mCameras[0];
        const aiMatrix4x4 m = read->mRootNode->FindNode(camera.mName)->mTransformation;
        const double x = glm::tan(camera.mHorizontalFOV / 2.0);
        const double y = x / camera.mAspect;
        const aiVector3D right = camera.mLookAt ^ camera.mUp;
        const auto world = [&](const aiVector3D& v) {
            const aiVector3D turned = aiMatrix3x3(m) * v;
            return Vec3(turned.x, turned.y, turned.z);
        };
        const ref::Camera ours(*scene.camera, 64, 64);
        for (const double u : {0.0, 0.3, 1.0})
            for (const double v : {0.0, 0.8, 1.0}) {
                const Vec3 theirs = world(camera.mLookAt) + (2 * u - 1) * x * world(right) +
                                    (1 - 2 * v) * y * world(camera.mUp);
                const Vec3 expected = ours.ray({u * 64, v * 64}).direction;
                EXPECT_LT(glm::length(glm::normalize(theirs) - expected), 1e-6) << name;
            }
        ASSERT_EQ(read->mNumLights, scene.point_lights.size());
        if (scene.point_lights.empty()) continue;
        const aiLight& light = *read->mLights[0];
        EXPECT_EQ(light.mType, aiLightSource_POINT);
        EXPECT_EQ(Vec3(light.mColorDiffuse.r, light.mColorDiffuse.g, light.mColorDiffuse.b),
                  Vec3(glm::vec3(scene.point_lights[0].intensity)));
        const aiMatrix4x4 at = read->mRootNode->FindNode(light.mName)->mTransformation;
        EXPECT_EQ(Vec3(at.a4, at.b4, at.c4), Vec3(glm::vec3(scene.point_lights[0].position)));
    }
}

#endif

} // namespace
