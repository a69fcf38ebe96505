// Five files of a course, written by others. They are not part of this repository: the tests are skipped
// where the files are absent. The expected values were found by inspection of the files.

#include "scenes/bounds.h"
#include "scenes/frame.h"
#include "scenes/read_scene.h"
#include "scenes/requirements.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace {

using scenes::Scene;
using scenes::Vec3;

// The files have seven digits: numbers of about 1 err by up to 1e-7, and products of a few of them by
// less than this.
constexpr double digits = 1e-6;

class CourseScene : public testing::TestWithParam<const char*> {
protected:
    void SetUp() override
    {
        const char* shared = std::getenv("PLUMBLINE_SHARED");
        const std::filesystem::path folder =
            shared ? std::filesystem::path(shared)
                   : std::filesystem::path(PLUMBLINE_SOURCE_DIR).parent_path() / "shared";
        const std::filesystem::path path = folder / "scenes" / (std::string(GetParam()) + ".dae");
        if (!std::filesystem::exists(path)) GTEST_SKIP() << "the course scenes are not here";
        scene = scenes::read_scene(path);
    }

    [[nodiscard]] bool is(const char* name) const { return scene.name == name; }

    Scene scene;
};

INSTANTIATE_TEST_SUITE_P(All, CourseScene,
                         testing::Values("cow", "CBcoil", "CBbunny", "CBspheres",
                                         "CBspheres_lambertian"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(CourseScene, HasItsTrianglesAndSpheresAndMaterials)
{
    // The room with its luminaire has 12 triangles, the mesh of the coil 7,872, that of the bunny
    // 28,576.
    const std::size_t triangles = is("cow") ? 5856 : is("CBcoil") ? 7884 : is("CBbunny") ? 28588 : 12;
    const std::size_t spheres = is("CBspheres") || is("CBspheres_lambertian") ? 2 : 0;
    EXPECT_EQ(scene.triangles.size(), triangles);
    EXPECT_EQ(scene.spheres.size(), spheres);
    EXPECT_EQ(scene.materials.size(), is("cow") ? 1 : spheres == 2 ? 8 : 7);
    EXPECT_EQ(scene.material_names.size(), scene.materials.size());
}

TEST_P(CourseScene, HasOneLuminaireFacingDown)
{
    std::vector<scenes::Triangle> luminaire;
    std::copy_if(scene.triangles.begin(), scene.triangles.end(), std::back_inserter(luminaire),
                 [&](const auto& t) {
                     return std::holds_alternative<scenes::Emission>(scene.materials[t.material]);
                 });
    if (is("cow")) { // lit only by the sun
        EXPECT_TRUE(luminaire.empty());
        ASSERT_EQ(scene.directional_lights.size(), 1);
        EXPECT_EQ(scene.directional_lights[0].irradiance, Vec3(1.0));
        const Vec3 along = scene.directional_lights[0].direction - Vec3(-0.5, -0.5, -std::sqrt(0.5));
        EXPECT_LT(glm::length(along), digits);
        EXPECT_TRUE(scene.notices.empty());
        return;
    }
    ASSERT_EQ(luminaire.size(), 2);
    Vec3 low(1e9);
    Vec3 high(-1e9);
    for (const scenes::Triangle& triangle : luminaire) {
        const auto& v = triangle.vertices;
        const Vec3 area_vector = 0.5 * glm::cross(v[1] - v[0], v[2] - v[0]);
        EXPECT_LT(glm::length(area_vector - Vec3(0, 0, -0.24)), digits); // half of 0.8 x 0.6
        for (const Vec3& vertex : v) {
            low = glm::min(low, vertex);
            high = glm::max(high, vertex);
        }
        EXPECT_EQ(std::get<scenes::Emission>(scene.materials[triangle.material]).radiance, Vec3(10.0));
    }
    // In four files it is moved by 0.0043 in y.
    const double shift = is("CBbunny") ? 0 : 0.004315853;
    EXPECT_LT(glm::length(low - Vec3(-0.4, shift - 0.3, 1.49)), digits);
    EXPECT_LT(glm::length(high - Vec3(0.4, shift + 0.3, 1.49)), digits);
    EXPECT_TRUE(scene.point_lights.empty() && scene.directional_lights.empty() &&
                scene.spot_lights.empty());
    EXPECT_FALSE(scene.environment.has_value());

    ASSERT_EQ(scene.notices.size(), 1);
    EXPECT_NE(scene.notices[0].find("<instance_light url=\"#Area-light\">: skipped"), std::string::npos);
}

TEST_P(CourseScene, HasTheColoursOfItsRoom)
{
    const auto albedo = [&](const std::string& name) {
        const auto found = std::find(scene.material_names.begin(), scene.material_names.end(), name);
        EXPECT_NE(found, scene.material_names.end()) << name;
        return std::get<scenes::Lambertian>(
                   scene.materials.at(static_cast<std::size_t>(found - scene.material_names.begin())))
            .albedo;
    };
    if (is("cow")) {
        EXPECT_EQ(albedo("Default_003-material"), Vec3(0.48));
        return;
    }
    EXPECT_EQ(albedo("leftWall-material"), Vec3(0.6, 0.2, 0.2));
    EXPECT_EQ(albedo("rightWall-material"), Vec3(0.2, 0.2, 0.6));
    for (const char* name : {"ceiling-material", "floor-material", "backWall-material"})
        EXPECT_EQ(albedo(name), Vec3(0.6));
    // The room: x and y in [-1, 1], z in [0, 1.5].
    const scenes::Bounds box = scenes::bounds(scene).value();
    EXPECT_LT(glm::length(box.min - Vec3(-1, -1, 0)), digits);
    EXPECT_LT(glm::length(box.max - Vec3(1, 1, 1.5)), digits);
}

TEST_P(CourseScene, HasItsSpheresAndTheMaterialsThatTheExtraProfileGives)
{
    if (is("CBspheres") || is("CBspheres_lambertian")) {
        ASSERT_EQ(scene.spheres.size(), 2);
        EXPECT_EQ(scene.spheres[0].center, Vec3(-0.4, 0.3, 0.3));
        EXPECT_EQ(scene.spheres[1].center, Vec3(0.4, -0.3, 0.3));
        for (const scenes::Sphere& sphere : scene.spheres) EXPECT_DOUBLE_EQ(sphere.radius, 0.3);
        const auto& first = scene.materials[scene.spheres[0].material];
        const auto& second = scene.materials[scene.spheres[1].material];
        if (is("CBspheres")) {
            EXPECT_EQ(std::get<scenes::Glass>(first).ior, 1.45);
            EXPECT_EQ(std::get<scenes::Glass>(first).reflectance, Vec3(1.0));
            EXPECT_EQ(std::get<scenes::Glass>(first).transmittance, Vec3(1.0));
            EXPECT_EQ(std::get<scenes::Mirror>(second).reflectance, Vec3(1.0));
        } else {
            EXPECT_EQ(std::get<scenes::Lambertian>(first).albedo, Vec3(0.8));
            EXPECT_EQ(std::get<scenes::Lambertian>(second).albedo, Vec3(0.8));
        }
    }
    if (is("CBcoil")) {
        std::size_t mirrors = 0;
        for (const scenes::Triangle& triangle : scene.triangles)
            if (const auto* mirror = std::get_if<scenes::Mirror>(&scene.materials[triangle.material])) {
                EXPECT_EQ(mirror->reflectance, Vec3(0.3));
                ++mirrors;
            }
        EXPECT_EQ(mirrors, 7872);
    }
}

TEST_P(CourseScene, HasItsCameraAndFramingMovesItBack)
{
    const scenes::Camera camera = scene.camera.value();
    const double y = is("cow")       ? 5
                     : is("CBbunny") ? -3
                                     : 3; // looking along -y or, from the other side, +y
    EXPECT_EQ(camera.eye, Vec3(0, y, 0));
    EXPECT_LT(glm::length(camera.backward - Vec3(0, y / std::abs(y), 0)), digits);
    EXPECT_LT(glm::length(camera.up - Vec3(0, 0, 1)), digits);
    EXPECT_LT(glm::length(camera.right - Vec3(-y / std::abs(y), 0, 0)), digits);
    EXPECT_EQ(camera.fov_axis, scenes::FovAxis::horizontal);
    EXPECT_DOUBLE_EQ(camera.fov, (is("cow") ? 39.5978 : 49.13434) * std::numbers::pi / 180);

    scenes::frame_camera(scene);
    if (is("cow")) return;
    const double diagonal = std::sqrt(4 + 4 + 2.25);
    EXPECT_LT(glm::length(scene.camera->eye - Vec3(0, std::copysign(1.5 * diagonal, y), 0.75)),
              4 * digits);
}

TEST_P(CourseScene, RequiresWhatItShows)
{
    const scenes::Requirements needs = scenes::requirements(scene);
    using scenes::Bsdf;
    using scenes::Strategy;
    const std::set<Bsdf> bsdfs = is("CBspheres") ? std::set{Bsdf::lambertian, Bsdf::mirror, Bsdf::glass}
                                 : is("CBcoil")  ? std::set{Bsdf::lambertian, Bsdf::mirror}
                                                 : std::set{Bsdf::lambertian};
    EXPECT_EQ(needs.bsdfs, bsdfs);
    EXPECT_EQ(needs.emitters,
              std::set{is("cow") ? scenes::EmitterKind::directional : scenes::EmitterKind::triangle});
    EXPECT_EQ(needs.strategies.contains(Strategy::emission_hit), !is("cow"));
    EXPECT_EQ(needs.strategies.size(), is("cow") ? 3 : 4);
}

} // namespace
