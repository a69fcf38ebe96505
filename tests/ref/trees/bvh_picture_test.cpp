#include "cli/bvh_picture.h"

#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>

#include <numbers>

namespace {

using ref::Vec3;

/// Two small triangles far apart along x, seen from z = 10 by a camera with a field of view of 90
/// degrees.
scenes::Scene two_specks()
{
    scenes::Scene scene = scene_of(trees_test::Mesh{});
    for (const double x : {-5.0, 5.0})
        scene.triangles.push_back({{Vec3(x - 1, -1, 0), Vec3(x + 1, -1, 0), Vec3(x, 1, 0)}, 0});
    scene.camera = scenes::Camera{
        Vec3(0, 0, 10),      Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal,
        std::numbers::pi / 2};
    return scene;
}

/// Columns of the picture in which some pixel is coloured: lines are, the shaded scene is grey.
std::vector<int> coloured_columns(const images::Image& image)
{
    std::vector<int> columns;
    for (int x = 0; x < image.width; ++x) {
        bool coloured = false;
        for (int y = 0; y < image.height; ++y) {
            const images::Rgb& pixel = image.pixels[static_cast<std::size_t>(y * image.width + x)];
            coloured = coloured || pixel.x != pixel.y || pixel.y != pixel.z;
        }
        if (coloured) columns.push_back(x);
    }
    return columns;
}

TEST(DrawBoxes, DrawsTheRootAtLevelZeroAndItsChildrenAtLevelOne)
{
    const scenes::Scene scene = two_specks();
    const ref::Geometry geometry(scene, ref::Builder::morton30);
    // 200 pixels for 20 units at z = 0: x = -6 is pixel 40, -4 is 60, 4 is 140, 6 is 160 (up to a
    // rounding).
    const std::vector<int> root = coloured_columns(cli::draw_boxes(geometry, 0, 200, 100));
    ASSERT_FALSE(root.empty());
    EXPECT_NEAR(root.front(), 40, 1);
    EXPECT_NEAR(root.back(), 160, 1);
    EXPECT_NEAR(static_cast<double>(root.size()), 120, 2);
    for (const int level : {1, 7}) { // leaves stay visible below their depth
        const std::vector<int> children = coloured_columns(cli::draw_boxes(geometry, level, 200, 100));
        EXPECT_NEAR(static_cast<double>(children.size()), 2 * 20, 4);
        for (const int x : children) EXPECT_TRUE((x >= 39 && x <= 61) || (x >= 139 && x <= 161)) << x;
    }
}

TEST(DrawOrder, GivesEachPieceOfTheListItsColour)
{
    const scenes::Scene scene = two_specks();
    const ref::Geometry geometry(scene, ref::Builder::morton30);
    // The difference between the colours at mid-height of the two triangles, at mirrored places.
    const auto difference = [&](std::size_t pieces) {
        const images::Image image = cli::draw_order(geometry, pieces, 200, 100);
        EXPECT_EQ(image.pixels[50 * 200 + 100], images::Rgb(0.9)); // the background between them
        return glm::length(image.pixels[50 * 200 + 50] - image.pixels[50 * 200 + 149]);
    };
    EXPECT_NEAR(difference(1), 0, 1e-14); // up to roundings of the shading: tens of ulps
    EXPECT_GT(difference(2), 0.1);
}

TEST(DrawVisits, IsBrighterWhereARayEntersMoreBoxes)
{
    const scenes::Scene scene = two_specks();
    const ref::Geometry geometry(scene, ref::Builder::morton30);
    const auto colour_at = [&](int x) {
        return cli::draw_visits(geometry, 3, 200, 100).pixels[static_cast<std::size_t>(50 * 200 + x)];
    };
    EXPECT_EQ(colour_at(10), images::Rgb(0));        // beside the root's box
    EXPECT_EQ(colour_at(100), images::Rgb(1, 0, 0)); // only the root's
    EXPECT_EQ(colour_at(50), images::Rgb(1, 1, 0));  // and that of a leaf
}

TEST(DrawBoxes, OfAnEmptySceneDrawsNothing)
{
    scenes::Scene scene = two_specks();
    scene.triangles.clear();
    EXPECT_TRUE(coloured_columns(cli::draw_boxes(ref::Geometry(scene), 0, 20, 10)).empty());
}

} // namespace
