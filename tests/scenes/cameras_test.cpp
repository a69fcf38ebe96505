#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>
#include <string>

namespace {

using scenes::Vec3;

transport_test::SceneText with_camera(const std::string& perspective, const std::string& transform = "")
{
    transport_test::SceneText text;
    text.cameras = "<camera id=\"c\"><optics><technique_common><perspective>" + perspective +
                   "</perspective></technique_common></optics></camera>";
    text.lights = "<light id=\"l\"><technique_common><ambient><color>1 1 "
                  "1</color></ambient></technique_common></light>";
    text.nodes = transport_test::node("<instance_light url=\"#l\"/>") +
                 transport_test::node(transform + "<instance_camera url=\"#c\"/>");
    return text;
}

TEST(Cameras, LookAlongLocalMinusZWithLocalYUp)
{
    const scenes::Scene scene = with_camera("<xfov>90</xfov>", "<translate>1 2 3</translate>").parse();
    const scenes::Camera& camera = scene.camera.value();
    EXPECT_EQ(camera.eye, Vec3(1, 2, 3));
    EXPECT_EQ(camera.right, Vec3(1, 0, 0));
    EXPECT_EQ(camera.up, Vec3(0, 1, 0));
    EXPECT_EQ(camera.backward, Vec3(0, 0, 1));
    EXPECT_TRUE(scene.notices.empty());
}

TEST(Cameras, XfovIsHorizontalAndYfovVerticalAndBothAreWholeAngles)
{
    const scenes::Camera horizontal =
        with_camera("<xfov>90</xfov><aspect_ratio>1.5</aspect_ratio><znear>0.1</znear><zfar>100</zfar>")
            .parse()
            .camera.value();
    EXPECT_EQ(horizontal.fov_axis, scenes::FovAxis::horizontal);
    EXPECT_DOUBLE_EQ(horizontal.fov, std::numbers::pi / 2);
    const scenes::Camera vertical = with_camera("<yfov>60</yfov>").parse().camera.value();
    EXPECT_EQ(vertical.fov_axis, scenes::FovAxis::vertical);
    EXPECT_DOUBLE_EQ(vertical.fov, std::numbers::pi / 3);
}

TEST(Cameras, OfBothAnglesTheHorizontalOneCountsWithANotice)
{
    const scenes::Scene scene = with_camera("<xfov>90</xfov><yfov>60</yfov>").parse();
    EXPECT_EQ(scene.camera.value().fov_axis, scenes::FovAxis::horizontal);
    EXPECT_DOUBLE_EQ(scene.camera.value().fov, std::numbers::pi / 2);
    EXPECT_EQ(scene.notices,
              std::vector<std::string>{
                  "test.dae:1: <yfov>: ignored: <xfov> is given as well, and pixels are square"});
}

TEST(Cameras, TheFirstOfSeveralCountsWithOneNotice)
{
    transport_test::SceneText text = with_camera("<xfov>90</xfov>");
    for (int i = 0; i < 2; ++i)
        text.nodes += transport_test::node("<translate>9 9 9</translate><instance_camera url=\"#c\"/>");
    const scenes::Scene scene = text.parse();
    EXPECT_EQ(scene.camera.value().eye, Vec3(0.0));
    EXPECT_EQ(scene.notices,
              std::vector<std::string>{
                  "test.dae:1: <instance_camera url=\"#c\">: ignored, like every camera but the first"});
}

TEST(Cameras, ASceneNeedsNone)
{
    EXPECT_FALSE(transport_test::SceneText().parse().camera.has_value());
}

TEST(Cameras, AMirroredNodeMirrorsThePicture)
{
    const scenes::Camera camera =
        with_camera("<xfov>90</xfov>", "<scale>-2 2 2</scale>").parse().camera.value();
    EXPECT_EQ(camera.right, Vec3(-1, 0, 0));
    EXPECT_EQ(camera.up, Vec3(0, 1, 0));
    EXPECT_EQ(camera.backward, Vec3(0, 0, 1));
}

RC_GTEST_PROP(Cameras, TheAxesAreOrthonormalToRoundingWhateverTheDigitsOfTheFile, ())
{
    // A random rotation times a scale and a random sign, each entry off by up to 1e-6.
    const auto real = rc::gen::map(rc::gen::inRange(-1000000, 1000001), [](int i) { return i / 1e6; });
    const auto axis = [&] {
        return *rc::gen::suchThat(rc::gen::construct<Vec3>(real, real, real),
                                  [](const Vec3& v) { return glm::length(v) > 0.1; });
    };
    const Vec3 z = glm::normalize(axis());
    const Vec3 other = axis();
    RC_PRE(glm::length(glm::cross(other, z)) > 0.1);
    const Vec3 x = glm::normalize(glm::cross(other, z)) * (*rc::gen::arbitrary<bool>() ? 1.0 : -1.0);
    const Vec3 y = glm::cross(z, glm::normalize(glm::cross(other, z)));
    const double scale = *rc::gen::element(1e-3, 0.38, 1.0, 1e3);
    const Vec3 columns[3] = {x, y, z};
    std::string matrix = "<matrix>";
    for (int row = 0; row < 3; ++row) {
        for (const Vec3& column : columns)
            matrix += transport_test::exactly(scale * (column[row] + 1e-6 * *real)) + " ";
        matrix += "0 ";
    }
    const scenes::Camera camera =
        with_camera("<xfov>90</xfov>", matrix + "0 0 0 1</matrix>").parse().camera.value();

    // Orthonormal: rounding of a handful of operations on numbers of at most 1.
    const double rounding = 8 * 0x1p-53;
    RC_ASSERT(std::abs(glm::length(camera.right) - 1) < rounding &&
              std::abs(glm::length(camera.up) - 1) < rounding &&
              std::abs(glm::length(camera.backward) - 1) < rounding);
    RC_ASSERT(std::abs(glm::dot(camera.right, camera.up)) < rounding &&
              std::abs(glm::dot(camera.up, camera.backward)) < rounding &&
              std::abs(glm::dot(camera.backward, camera.right)) < rounding);
    // The intended axes, to the digits of the file: an error of 1e-6 in each of nine entries.
    RC_ASSERT(glm::distance(camera.right, x) < 1e-5 && glm::distance(camera.up, y) < 1e-5 &&
              glm::distance(camera.backward, z) < 1e-5);
}

} // namespace
