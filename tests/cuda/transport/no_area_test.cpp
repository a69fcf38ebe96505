// Triangles without area stop no ray on the fast path, at any place and for any rounding of their
// corners; thin triangles with area do.

#include "cuda/launch/renderer.h"
#include "cuda/parallel/threaded_executor.h"
#include "cuda/scene/scene_arrays.h"
#include "cuda/trees/scene_geometry.h"
#include "cuda/trees/surfaces.h"
#include "tests/cuda/transport/float_scene.h"
#include "tests/ref/trees/meshes.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using scenes::Vec3;
using trees_test::Random;
using Corners = std::array<Vec3, 3>;

/// A position that floats hold exactly, with coordinates of at least 1/4, so that a distance of 1e-10
/// from it is rounded away.
Vec3 float_place(Random& random)
{
    Vec3 place = random.in_cube();
    for (int axis = 0; axis < 3; ++axis) place[axis] += place[axis] < 0 ? -0.25 : 0.25;
    return fast_transport_test::nearest_float(place);
}

/// The kinds of triangles that have no area in the scene.
constexpr std::size_t kinds_in_double = 4;
/// All kinds, including those that have no area only as floats.
constexpr std::size_t kinds = 6;

Corners without_area(std::size_t kind, Random& random)
{
    const Vec3 a = random.in_cube();
    const Vec3 b = random.in_cube();
    const double t = random.uniform(-0.5, 1.5);
    Corners v{};
    switch (kind) {
    case 0:
        v = {a, a, a};
        break;
    case 1:
        v = {a, a, b};
        break;
    case 2: // on a line up to the rounding of doubles
        v = {a, b, a + t * (b - a)};
        break;
    case 3: // on a line along an axis
        v = {a, a + Vec3(0.7, 0, 0), a + Vec3(0.7 * t, 0, 0)};
        break;
    case 4: { // less than the distance between neighbouring floats
        const Vec3 p = float_place(random);
        v = {p, p + 1e-10 * random.in_cube(), p + 1e-10 * random.in_cube()};
        break;
    }
    default: { // thinner than that
        const Vec3 p = float_place(random);
        v = {p, p + Vec3(0.5, 1e-10, 0), p + Vec3(0.5 * t, 0, 1e-10)};
        break;
    }
    }
    const std::size_t first = random.below(3);
    std::rotate(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(first), v.end());
    if (random.below(2) == 0) std::swap(v[0], v[1]);
    return v;
}

/// The number of rays that hit something.
std::size_t hits(const std::vector<fast::Triangle>& triangles, const std::vector<fast::Ray>& rays)
{
    fast::HostMemory memory;
    fast::SerialExecutor serial;
    const fast::SurfaceTree tree(memory, serial, triangles, {});
    std::size_t count = 0;
    for (const fast::Ray& ray : rays) {
        const bool any = occluded(tree.view<false>(), ray);
        EXPECT_EQ(intersect(tree.view<false>(), ray).primitive != fast::no_primitive, any);
        count += any ? 1 : 0;
    }
    return count;
}

TEST(TrianglesWithoutArea, AreHitByNoRay)
{
    Random random(1);
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    for (std::size_t i = 0; i < 1200; ++i)
        scene.triangles.push_back({without_area(i % kinds, random), 0});
    std::vector<fast::Triangle> corner_by_corner;
    std::vector<fast::Ray> rays; // towards the triangles
    for (const scenes::Triangle& triangle : scene.triangles) {
        const auto& v = triangle.vertices;
        corner_by_corner.push_back({{fast::Vec3(v[0]), fast::Vec3(v[1]), fast::Vec3(v[2])}});
        for (int k = 0; k < 50; ++k) {
            const Vec3 b = random.barycentric();
            const fast::Vec3 origin(2.0 * random.in_cube());
            const fast::Vec3 to(b[0] * v[0] + b[1] * v[1] + b[2] * v[2]);
            rays.push_back({origin, std::numeric_limits<float>::infinity(), to - origin});
        }
    }
    EXPECT_GT(hits(corner_by_corner, rays), rays.size() / 100); // otherwise the test is empty
    EXPECT_EQ(hits(fast::triangles_of(scene), rays), 0u);
}

TEST(TrianglesWithoutArea, AreFoundInEveryPlaceAndSize)
{
    Random random(2);
    for (std::size_t i = 0; i < 2000; ++i) {
        const Corners v = without_area(i % kinds_in_double, random);
        const double size = std::ldexp(1.0, static_cast<int>(random.below(1001)) - 500);
        const Vec3 far = size * random.magnitude(0, 6) * random.in_cube();
        Corners moved{};
        for (std::size_t k = 0; k < 3; ++k) moved[k] = size * v[k] + far;
        EXPECT_FALSE(fast::has_area({moved, 0}, {far, 1 / size})) << "kind " << i % kinds_in_double;
    }
}

// Down to a height of 2^-18: 64 times the distance by which rounding moves a corner.
TEST(TrianglesWithLittleArea, KeepEveryCorner)
{
    Random random(3);
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    for (int i = 0; i < 2000; ++i) {
        const Vec3 along = random.direction();
        const Vec3 across = glm::normalize(glm::cross(along, random.direction()));
        const double length = random.magnitude(-4, 0);
        const Vec3 a = random.in_cube();
        const double height = std::max(0x1p-18, length * random.magnitude(-6, 0));
        scene.triangles.push_back(
            {{a, a + length * along, a + random.uniform() * length * along + height * across}, 0});
        EXPECT_TRUE(fast::has_area(scene.triangles.back()));
    }
    const auto triangles = fast::triangles_of(scene);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(triangles[i].vertices[k], fast::Vec3(scene.triangles[i].vertices[k]));
    // And rays to their middles still hit them.
    std::vector<fast::Ray> rays;
    for (const scenes::Triangle& triangle : scene.triangles) {
        const auto& v = triangle.vertices;
        const Vec3 normal = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
        const fast::Vec3 origin((v[0] + v[1] + v[2]) / 3.0 + normal);
        rays.push_back({origin, std::numeric_limits<float>::infinity(), fast::Vec3(-normal)});
    }
    EXPECT_EQ(hits(triangles, rays), rays.size());
}

scenes::Scene under_a_sky()
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}, scenes::Emission{scenes::Rgb(3.0)}};
    scene.environment = scenes::Rgb(1.0);
    const Vec3 backward = glm::normalize(Vec3(0.3, -0.5, 0.8));
    const Vec3 right = glm::normalize(glm::cross(Vec3(0, 1, 0), backward));
    scene.camera = scenes::Camera{
        3.0 * backward, right, glm::cross(backward, right), backward, scenes::FovAxis::horizontal, 0.6};
    return scene;
}

TEST(TrianglesWithoutArea, LeaveASkyOfOneExactlyOne)
{
    Random random(4);
    scenes::Scene scene = under_a_sky();
    for (std::size_t i = 0; i < 10000; ++i)
        scene.triangles.push_back({without_area(i % kinds_in_double, random), 0});
    images::RenderOptions options;
    options.integrator = fast::Integrator::path;
    options.batch_size = 256;
    const auto renderer = fast::host_renderer(scene, 32, 32, options, 2);
    const images::Batch batch = *renderer->render_batch(0, {});
    for (const images::Rgb& pixel : batch.mean.pixels) EXPECT_EQ(pixel, images::Rgb(1.0));
}

std::string refusal_of(const scenes::Scene& scene)
{
    try {
        (void)fast::scene_arrays(scene, true);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

// A lamp that floats cannot represent is rejected, unless its share of the light is too small to be
// visible.
TEST(TrianglesWithoutArea, ThatGiveMuchOfTheLightAreRefused)
{
    scenes::Scene scene = under_a_sky();
    scene.environment.reset();
    scene.triangles = {{{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(0, 1, 0)}, 0}};
    const Vec3 p(0.5, 0.5, 0.5);
    scene.triangles.push_back({{p, p + Vec3(1e-10, 0, 0), p + Vec3(0, 1e-10, 0)}, 1});
    EXPECT_NE(refusal_of(scene).find("1 emitting triangle(s) are too small or too thin for single "
                                     "precision, and 100"),
              std::string::npos)
        << refusal_of(scene);
    // Beside another lamp it gives only 1e-20 of the light.
    scene.triangles.push_back({{p, p + Vec3(1, 0, 0), p + Vec3(0, 1, 0)}, 1});
    EXPECT_EQ(refusal_of(scene), "");
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    ASSERT_EQ(arrays.emitters.size(), 2u);
    EXPECT_EQ(arrays.emitters[0].probability, 0.0f);
    EXPECT_EQ(arrays.emitters[1].probability, 1.0f);
    // A triangle without area in the scene does not emit there either.
    scene.triangles.resize(1);
    scene.triangles.push_back({{p, p + Vec3(1, 0, 0), p + Vec3(0.5, 0, 0)}, 1});
    EXPECT_EQ(refusal_of(scene), "");
}

} // namespace
