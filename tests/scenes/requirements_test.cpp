#include "scenes/requirements.h"

#include "scenes/read_scene.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace {

using scenes::Bsdf;
using scenes::EmitterKind;
using scenes::Rgb;
using scenes::Scene;
using scenes::Shape;
using scenes::Strategy;
using scenes::Vec3;

const scenes::Lambertian grey = {Rgb(0.5)};
const scenes::Lambertian black = {Rgb(0.0)};
const scenes::Mirror mirror = {Rgb(0.5)};
const scenes::Glass glass = {Rgb(1.0), Rgb(1.0), 1.5};
const scenes::Emission lamp = {Rgb(0.0, 0.0, 1.0)};

/// A camera, and one sphere of each of these materials.
Scene spheres_of(const std::vector<scenes::Material>& materials)
{
    Scene scene;
    scene.materials = materials;
    scene.material_names.resize(materials.size());
    for (std::uint32_t i = 0; i < materials.size(); ++i) scene.spheres.push_back({Vec3(0.0), 1.0, i});
    scene.camera = scenes::Camera{};
    return scene;
}

const scenes::Triangle triangle = {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, 0};
const scenes::PointLight point = {Vec3(0.0), Rgb(1.0)};
const scenes::DirectionalLight directional = {Vec3(0, 0, -1), Rgb(1.0)};
const scenes::SpotLight spot = {Vec3(0.0), Vec3(0, 0, -1), Rgb(1.0), 0.5, 0};

using Strategies = std::set<Strategy>;
const Strategies all_strategies(scenes::all_of<Strategy>.begin(), scenes::all_of<Strategy>.end());
const Strategies seen_directly = {Strategy::emission_hit, Strategy::light_image};
const Strategies all_but_emission_hit = {Strategy::next_event, Strategy::light_image,
                                         Strategy::inner_connection};

TEST(Requirements, AnEmptySceneRequiresNothing)
{
    const scenes::Requirements needs = requirements(Scene());
    EXPECT_TRUE(needs.shapes.empty() && needs.bsdfs.empty() && needs.emitters.empty());
    EXPECT_TRUE(needs.strategies.empty() && needs.fov_axes.empty());
}

TEST(Requirements, ShapesAndBsdfsAreThoseInSight)
{
    Scene scene = spheres_of({mirror, glass});
    scene.materials.emplace_back(grey); // of no surface
    EXPECT_EQ(requirements(scene).shapes, std::set{Shape::sphere});
    EXPECT_EQ(requirements(scene).bsdfs, (std::set{Bsdf::mirror, Bsdf::glass}));
    scene.triangles.push_back(triangle);
    scene.triangles[0].material = 2;
    EXPECT_EQ(requirements(scene).shapes, (std::set{Shape::triangle, Shape::sphere}));
    EXPECT_EQ(requirements(scene).bsdfs, (std::set{Bsdf::lambertian, Bsdf::mirror, Bsdf::glass}));
}

TEST(Requirements, AnEmissiveSurfaceIsAnEmitterOfItsShapeAndNoBsdf)
{
    Scene scene = spheres_of({lamp});
    EXPECT_EQ(requirements(scene).emitters, std::set{EmitterKind::sphere});
    EXPECT_TRUE(requirements(scene).bsdfs.empty());
    scene.spheres.clear();
    scene.triangles.push_back(triangle);
    EXPECT_EQ(requirements(scene).emitters, std::set{EmitterKind::triangle});
}

TEST(Requirements, ABlackEmissionOrOneOfNoAreaIsNoEmitter)
{
    EXPECT_TRUE(requirements(spheres_of({scenes::Emission{Rgb(0.0)}})).emitters.empty());
    Scene line = spheres_of({lamp});
    line.spheres.clear();
    line.triangles.push_back({{Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}, 0});
    EXPECT_TRUE(requirements(line).emitters.empty());
    EXPECT_TRUE(requirements(line).strategies.empty());
}

TEST(Requirements, LightsThatAreNotBlackAreEmitters)
{
    Scene scene;
    scene.point_lights = {{Vec3(0.0), Rgb(0.0)}};
    scene.directional_lights = {{Vec3(0, 0, 1), Rgb(0.0)}};
    scene.spot_lights = {{Vec3(0.0), Vec3(0, 0, 1), Rgb(0.0), 0, 0}};
    scene.environment = Rgb(0.0);
    EXPECT_TRUE(requirements(scene).emitters.empty());
    scene.point_lights.push_back(point);
    EXPECT_EQ(requirements(scene).emitters, std::set{EmitterKind::point});
    scene.directional_lights.push_back(directional);
    scene.spot_lights.push_back(spot);
    scene.environment = Rgb(0.0, 0.1, 0.0);
    EXPECT_EQ(requirements(scene).emitters, (std::set{EmitterKind::point, EmitterKind::directional,
                                                      EmitterKind::spot, EmitterKind::environment}));
}

TEST(Requirements, AnEmitterWithAnAreaAndADiffuseSurfaceAllowEveryStrategy)
{
    EXPECT_EQ(requirements(spheres_of({grey, lamp})).strategies, all_strategies);
    Scene sky = spheres_of({grey});
    sky.environment = Rgb(1.0);
    EXPECT_EQ(requirements(sky).strategies, all_strategies);
}

TEST(Requirements, ADeltaEmitterCannotBeHit)
{
    Scene scene = spheres_of({grey});
    scene.point_lights = {point};
    EXPECT_EQ(requirements(scene).strategies, all_but_emission_hit);
    scene.point_lights.clear();
    scene.directional_lights = {directional};
    EXPECT_EQ(requirements(scene).strategies, all_but_emission_hit);
    scene.directional_lights.clear();
    scene.spot_lights = {spot};
    EXPECT_EQ(requirements(scene).strategies, all_but_emission_hit);
}

TEST(Requirements, AmongDeltaSurfacesAnEmitterIsOnlyHitOrImagedDirectly)
{
    EXPECT_EQ(requirements(spheres_of({mirror, glass, lamp})).strategies, seen_directly);
    EXPECT_EQ(requirements(spheres_of({lamp})).strategies, seen_directly);
    EXPECT_EQ(requirements(spheres_of({black, lamp})).strategies,
              seen_directly); // black surfaces cannot be joined
}

TEST(Requirements, ADeltaEmitterAmongDeltaSurfacesLightsNothing)
{
    Scene scene = spheres_of({mirror, glass});
    scene.point_lights = {point};
    EXPECT_EQ(requirements(scene).strategies, Strategies());
}

TEST(Requirements, WithoutACameraOrAnEmitterThereAreNoPaths)
{
    EXPECT_TRUE(requirements(spheres_of({grey, mirror})).strategies.empty());
    Scene blind = spheres_of({grey, lamp});
    blind.camera.reset();
    EXPECT_TRUE(requirements(blind).strategies.empty());
    EXPECT_TRUE(requirements(blind).fov_axes.empty());
}

TEST(Requirements, TheAxisOfTheFieldOfViewIsTheCameras)
{
    Scene scene = spheres_of({grey});
    scene.camera->fov_axis = scenes::FovAxis::vertical;
    EXPECT_EQ(requirements(scene).fov_axes, std::set{scenes::FovAxis::vertical});
}

// The scenes in this repository.

template <class Enumeration>
std::string names(const std::set<Enumeration>& set)
{
    std::string text;
    for (const Enumeration enumerator : set)
        text += (text.empty() ? "" : ", ") + std::string(name_of(enumerator));
    return text;
}

/// The text after "Requires" in the head comment of a scene, up to the next empty line, in single
/// spaces.
std::string stated_requirements(const std::filesystem::path& file)
{
    std::ifstream stream(file);
    std::string line;
    while (std::getline(stream, line) && line.find("Requires ") == std::string::npos) {
    }
    std::string words;
    for (; line.find_first_not_of(" \t\r") != std::string::npos; std::getline(stream, line)) {
        std::istringstream in(line);
        for (std::string word; in >> word;)
            if (word != "Requires") words += (words.empty() ? "" : " ") + word;
    }
    return words;
}

class OurScene : public testing::TestWithParam<std::filesystem::path> {};

INSTANTIATE_TEST_SUITE_P(All, OurScene, testing::ValuesIn(transport_test::our_scene_files()),
                         [](const auto& tested) { return tested.param.stem().string(); });

TEST_P(OurScene, ReadsWithoutNoticesAndHasACamera)
{
    const Scene scene = scenes::read_scene(GetParam());
    EXPECT_EQ(scene.notices, std::vector<std::string>());
    EXPECT_TRUE(scene.camera.has_value());
}

TEST_P(OurScene, RequiresWhatItsHeadSays)
{
    const scenes::Requirements needs = requirements(scenes::read_scene(GetParam()));
    const auto part = [](const std::string& title, const std::string& list) {
        return list.empty() ? "" : title + list;
    };
    EXPECT_EQ(stated_requirements(GetParam()),
              part("shapes ", names(needs.shapes)) + part("; bsdfs ", names(needs.bsdfs)) +
                  part("; emitters ", names(needs.emitters)) + part("; fov ", names(needs.fov_axes)));
}

template <class Enumeration>
void expect_all(const std::set<Enumeration>& required)
{
    for (const Enumeration enumerator : scenes::all_of<Enumeration>)
        EXPECT_TRUE(required.contains(enumerator)) << "no scene requires " << name_of(enumerator);
}

TEST(OurScenes, RequireEveryEnumeratorAtLeastOnce)
{
    scenes::Requirements all;
    for (const std::filesystem::path& file : transport_test::our_scene_files()) {
        scenes::Requirements one = requirements(scenes::read_scene(file));
        all.shapes.merge(one.shapes);
        all.bsdfs.merge(one.bsdfs);
        all.emitters.merge(one.emitters);
        all.strategies.merge(one.strategies);
        all.fov_axes.merge(one.fov_axes);
    }
    expect_all(all.shapes);
    expect_all(all.bsdfs);
    expect_all(all.emitters);
    expect_all(all.strategies);
    expect_all(all.fov_axes);
}

} // namespace
