#include "scenes/collada/transform.h"

#include "tests/scenes/scene_text.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cmath>
#include <functional>
#include <ranges>
#include <string>
#include <vector>

namespace {

using scenes::Vec3;
using transport_test::exactly;

constexpr double rounding = 0x1p-53;

/// One transformation element: its text, its effect on a point, and by how much it can lengthen one.
struct Step {
    std::string text;
    std::function<Vec3(const Vec3&)> apply;
    double growth;
};

std::string join(std::initializer_list<double> values)
{
    std::string text;
    for (const double value : values) text += exactly(value) + " ";
    return text;
}

double whole(int from, int to)
{
    return *rc::gen::inRange(from, to);
}

Step translation()
{
    const Vec3 by(whole(-9, 10), whole(-9, 10), whole(-9, 10));
    return {"<translate>" + join({by.x, by.y, by.z}) + "</translate>",
            [by](const Vec3& p) { return p + by; }, 20};
}

Step scaling()
{
    const Vec3 by(whole(1, 4), whole(-3, 0), whole(1, 4));
    return {"<scale>" + join({by.x, by.y, by.z}) + "</scale>", [by](const Vec3& p) { return p * by; },
            4};
}

Step shear()
{
    const double a = whole(-3, 4);
    const double b = whole(-9, 10);
    return {"<matrix>" + join({1, a, 0, b, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}) + "</matrix>",
            [=](const Vec3& p) { return Vec3(p.x + a * p.y + b, p.y, p.z); }, 20};
}

/// Through glm's quaternions, which the reader does not use.
Step rotation()
{
    const Vec3 axis(whole(-9, 10), whole(-9, 10), whole(1, 10));
    const double degrees = whole(-360, 361);
    const glm::dquat q = glm::angleAxis(glm::radians(degrees), glm::normalize(axis));
    return {"<rotate>" + join({axis.x, axis.y, axis.z, degrees}) + "</rotate>",
            [q](const Vec3& p) { return q * p; }, 2};
}

/// The triangle that read_below() puts below nested nodes, one node for each list of steps.
const std::vector<Vec3> local_points = {{1, 2, 3}, {-4, 5, 6}, {7, -8, 9}};

std::vector<Vec3> read_below(const std::vector<std::vector<Step>>& nodes)
{
    transport_test::SceneText text;
    text.geometries = transport_test::mesh(
        "t", "1 2 3 -4 5 6 7 -8 9", 3,
        "<triangles material=\"m\" count=\"1\"><input semantic=\"VERTEX\" source=\"#t-v\" "
        "offset=\"0\"/><p>0 1 2</p></triangles>");
    text.nodes = transport_test::instance_geometry("t");
    bool mirrored = false;
    for (const auto& steps : std::views::reverse(nodes)) {
        std::string transforms;
        for (const Step& step : steps) {
            transforms += step.text;
            if (step.text.find("scale") != std::string::npos) mirrored = !mirrored; // y is negative
        }
        text.nodes = "<node>" + transforms + text.nodes + "</node>";
    }
    if (nodes.empty()) text.nodes = "<node>" + text.nodes + "</node>";
    const scenes::Scene scene = text.parse();
    const auto& v = scene.triangles.at(0).vertices;
    if (mirrored) return {v[0], v[2], v[1]};
    return {v[0], v[1], v[2]};
}

Vec3 take_to_world(const std::vector<std::vector<Step>>& nodes, Vec3 point)
{
    for (const auto& steps : std::views::reverse(nodes))
        for (const Step& step : std::views::reverse(steps)) point = step.apply(point);
    return point;
}

template <class Kinds>
std::vector<std::vector<Step>> random_hierarchy(const Kinds& kinds)
{
    std::vector<std::vector<Step>> nodes(static_cast<std::size_t>(*rc::gen::inRange(1, 5)));
    for (auto& steps : nodes) {
        const int count = *rc::gen::inRange(0, 4);
        for (int i = 0; i < count; ++i)
            steps.push_back(kinds[static_cast<std::size_t>(
                *rc::gen::inRange(0, static_cast<int>(std::size(kinds))))]());
    }
    return nodes;
}

// Small whole numbers: at most 20^12 * 9 < 2^53 / 10 could appear, and all sums of products are exact.
RC_GTEST_PROP(NodeTransform, ElementsAndNodesComposeFromTheInnermostOut, ())
{
    Step (*const kinds[])() = {translation, scaling, shear};
    std::vector<std::vector<Step>> nodes = random_hierarchy(kinds);
    double growth = 10;
    for (const auto& steps : nodes)
        for (const Step& step : steps) growth *= step.growth;
    RC_PRE(growth < 0x1p50);
    const std::vector<Vec3> world = read_below(nodes);
    for (std::size_t i = 0; i < 3; ++i) RC_ASSERT(world[i] == take_to_world(nodes, local_points[i]));
}

// Tolerance: rounding. Each step takes three products and sums on both sides, and each of these errs by
// less than 16 units of 2^-53 of the largest possible number.
RC_GTEST_PROP(NodeTransform, RotationsTurnCounterClockwiseAboutTheirAxisByDegrees, ())
{
    Step (*const kinds[])() = {rotation, translation, scaling, rotation};
    const std::vector<std::vector<Step>> nodes = random_hierarchy(kinds);
    double largest = 12;
    double steps_taken = 1;
    for (const auto& steps : nodes)
        for (const Step& step : steps) {
            largest *= step.growth;
            ++steps_taken;
        }
    const std::vector<Vec3> world = read_below(nodes);
    for (std::size_t i = 0; i < 3; ++i)
        RC_ASSERT(glm::distance(world[i], take_to_world(nodes, local_points[i])) <=
                  steps_taken * 2 * 16 * rounding * largest);
}

TEST(NodeTransform, ARotationByNinetyDegreesAboutZTakesXToY)
{
    const std::vector<Vec3> world = read_below({{{"<rotate>0 0 2 90</rotate>", {}, 1}}});
    EXPECT_NEAR(world[0].x, -2, 4 * rounding); // (1, 2, 3) to (-2, 1, 3); rounding of cos(pi/2)
    EXPECT_NEAR(world[0].y, 1, 4 * rounding);
    EXPECT_EQ(world[0].z, 3);
}

TEST(NodeTransform, AMatrixIsWrittenRowByRow)
{
    const std::vector<Vec3> world =
        read_below({{{"<matrix>1 2 3 4 0 1 5 6 0 0 1 7 0 0 0 1</matrix>", {}, 1}}});
    EXPECT_EQ(world[0], Vec3(1 + 4 + 9 + 4, 2 + 15 + 6, 3 + 7));
}

TEST(NodeTransform, LookatPutsTheOriginAtTheEyeAndTurnsMinusZToTheInterest)
{
    const scenes::collada::Document document("<node><lookat>1 2 3 1 7 3 0 0 4</lookat></node>",
                                             "n.xml"); // towards +y, +z up
    const scenes::collada::Matrix m = scenes::collada::node_transform(document.root());
    EXPECT_EQ(scenes::collada::transform_point(m, Vec3(0.0)), Vec3(1, 2, 3));
    EXPECT_EQ(scenes::collada::transform_point(m, Vec3(0, 0, -5)), Vec3(1, 7, 3));
    EXPECT_EQ(scenes::collada::transform_direction(m, Vec3(0, 1, 0)), Vec3(0, 0, 1));
    EXPECT_EQ(scenes::collada::transform_direction(m, Vec3(1, 0, 0)), Vec3(1, 0, 0));
}

TEST(LinearPart, TellsSingularMirroredShearedAndStretchedTransforms)
{
    using scenes::collada::LinearPart;
    using scenes::collada::Matrix;
    const auto linear = [](const Vec3& x, const Vec3& y, const Vec3& z) {
        return LinearPart(
            Matrix(glm::dvec4(x, 0), glm::dvec4(y, 0), glm::dvec4(z, 0), glm::dvec4(5, 6, 7, 1)));
    };
    const Vec3 x(1, 0, 0);
    const Vec3 y(0, 1, 0);
    const Vec3 z(0, 0, 1);
    for (const double scale : {1.0, 1e-150, 1e150}) { // squares of these overflow or vanish
        const LinearPart identity = linear(scale * x, scale * y, scale * z);
        EXPECT_FALSE(identity.singular || identity.mirrored);
        EXPECT_TRUE(identity.orthogonal && identity.uniform);
        EXPECT_TRUE(linear(scale * x, scale * y, -scale * z).mirrored);
        EXPECT_TRUE(linear(scale * x, scale * y, Vec3(0.0)).singular);
        EXPECT_TRUE(linear(scale * x, scale * y, scale * (x + y)).singular);
        EXPECT_FALSE(linear(scale * x, scale * y, 1.001 * scale * z).uniform);
        EXPECT_FALSE(linear(scale * x, scale * (y + 0.001 * x), scale * z).orthogonal);
    }
    EXPECT_FALSE(linear(x, y, 1e-9 * z).singular); // flat, but not degenerate
}

} // namespace
