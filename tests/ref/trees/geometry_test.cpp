// Rays that leave surfaces without an epsilon, and segments between surfaces.

#include "ref/trees/geometry.h"

#include "ref/trees/rounding.h"
#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using ref::Builder;
using ref::Geometry;
using ref::Ray;
using ref::SurfacePoint;
using ref::Vec3;
using trees_test::Random;

constexpr double u = ref::unit_roundoff;

scenes::Scene empty_scene()
{
    return scene_of(trees_test::Mesh{});
}

/// A unit vector at right angles to `n`.
Vec3 tangent(const Vec3& n, Random& random)
{
    for (;;) {
        const Vec3 v = glm::cross(n, random.direction());
        const double length = glm::length(v);
        if (length > 0.1) return v / length;
    }
}

/// A direction of any length, to either side of `n`, whose cosine to n is at least `least`.
Vec3 leaving_direction(const Vec3& n, double least, Random& random)
{
    const double cosine = random.magnitude(std::log10(least), 0);
    const double side = random.below(2) == 0 ? 1 : -1;
    return (side * cosine * n + std::sqrt(1 - cosine * cosine) * tangent(n, random)) *
           random.magnitude(-3, 3);
}

/// A triangle of longest edge about `size` and smallest height about `size` / `aspect`.
std::array<Vec3, 3> sliver(double size, double aspect, Random& random)
{
    const Vec3 along = random.direction();
    const Vec3 across = tangent(along, random);
    const Vec3 at = random.in_cube();
    return {size * at, size * (at + along), size * (at + random.uniform() * along + across / aspect)};
}

struct Case {
    double size, offset, aspect;
};

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const double size : {1e-15, 1e-3, 1.0, 1e15})
        for (const double offset : {0.0, 1.0, 1e4})
            for (const double aspect : {1.0, 1e2, 1e4, 1e6})
                all.push_back({size, offset * size, aspect});
    return all;
}

/// The point on primitive 0 where a ray hits it.
std::optional<SurfacePoint> find_point(const Geometry& geometry, const Vec3& target, double size,
                                       Random& random)
{
    const Vec3 origin = target + size * random.magnitude(-3, 3) * random.direction();
    const Ray ray{origin, (target - origin) * random.magnitude(-2, 2)};
    const auto hit = intersect(geometry, ray);
    if (!hit) return std::nullopt;
    return surface_point(geometry, ray, *hit);
}

// The normal has an error of about 4 u times the aspect ratio, as an angle. For directions closer to
// the surface the side is unknown.
double least_cosine(double aspect)
{
    return std::max(1e-12, 16 * u * aspect);
}

TEST(LeaveSurface, ARayFromATriangleMeetsNeitherItNorItsDuplicate)
{
    Random random(1);
    for (const Case& c : cases()) {
        int found = 0;
        int met = 0;
        for (int i = 0; i < 3000; ++i) {
            auto v = sliver(c.size, c.aspect, random);
            const Vec3 away = c.offset * random.direction();
            for (Vec3& vertex : v) vertex += away;
            scenes::Scene scene = empty_scene();
            scene.triangles = {{v, 0}, {{v[1], v[2], v[0]}, 0}, {{v[2], v[1], v[0]}, 0}};
            const Geometry geometry(scene);
            const Vec3 b = random.barycentric();
            const auto point =
                find_point(geometry, b[0] * v[0] + b[1] * v[1] + b[2] * v[2], c.size, random);
            if (!point) continue; // the target is rounded: slivers can be missed
            ++found;
            const Vec3 d = leaving_direction(point->normal, least_cosine(c.aspect), random);
            met += intersect(geometry, {leave_surface(*point, d), d}) ? 1 : 0;
        }
        EXPECT_EQ(met, 0) << "size " << c.size << " offset " << c.offset << " aspect " << c.aspect;
        EXPECT_GT(found, c.offset * c.aspect <= 1e4 * c.size ? 2500 : 300);
    }
}

TEST(SurfacePoint, IsWhereTheRayMeetsTheSurfaceAndHasItsSideAndMaterial)
{
    Random random(7);
    for (const double size : {1e-15, 1.0, 1e15})
        for (int i = 0; i < 2000; ++i) {
            scenes::Scene scene = empty_scene();
            scene.triangles = {{sliver(size, 3, random), 4}, {sliver(size, 3, random), 5}};
            scene.spheres = {{size * random.in_cube(), size * random.uniform(0.1, 1), 6},
                             {size * random.in_cube(), size * random.uniform(0.1, 1), 7}};
            const Geometry geometry(scene);
            const Ray ray{2 * size * random.in_cube(), random.direction()};
            const auto hit = intersect(geometry, ray);
            if (!hit) continue;
            const SurfacePoint point = surface_point(geometry, ray, *hit);
            // Both are accurate to some tens of roundings of the scene's size, times the triangle's
            // aspect ratio and 1 / cosine, which is large for grazing rays.
            const double cosine = std::abs(glm::dot(ray.direction, point.normal));
            const double distance = glm::length(point.position - (ray.origin + hit->t * ray.direction));
            EXPECT_LE(distance * cosine, 1000 * u * size);
            EXPECT_EQ(point.primitive, hit->primitive);
            EXPECT_EQ(point.material, hit->primitive + 4);
            EXPECT_NEAR(glm::length(point.normal), 1, 4 * u);
            if (hit->primitive < 2) {
                const auto& v = scene.triangles[hit->primitive].vertices;
                EXPECT_GT(glm::dot(point.normal, glm::cross(v[1] - v[0], v[2] - v[0])), 0);
            } else {
                const Vec3& center = scene.spheres[hit->primitive - 2].center;
                EXPECT_GT(glm::dot(point.normal, point.position - center), 0);
            }
        }
}

TEST(SurfacePoint, HasTheSameErrorBoundInAReflectedScene)
{
    // Signs change no rounding. So a bound that is not the same everywhere lacks an absolute value.
    Random random(12);
    for (int i = 0; i < 100; ++i) {
        const auto v = sliver(1, 3, random);
        const Vec3 center = random.in_cube();
        const double radius = random.uniform(0.1, 1);
        const Vec3 b = random.barycentric();
        const Vec3 d = random.direction();
        const auto points = [&](const Vec3& signs) {
            scenes::Scene scene = empty_scene();
            scene.triangles = {{{signs * v[0], signs * v[1], signs * v[2]}, 0}};
            scene.spheres = {{signs * center, radius, 0}};
            const Geometry geometry(scene);
            return std::array{triangle_point(geometry, 0, b), sphere_point(geometry, 0, signs * d)};
        };
        const Vec3 signs(i % 2 == 0 ? -1 : 1, i % 4 < 2 ? -1 : 1, i % 8 < 4 ? -1 : 1);
        const auto here = points(Vec3(1));
        const auto reflected = points(signs);
        for (std::size_t k = 0; k < here.size(); ++k) {
            EXPECT_EQ(reflected[k].position, signs * here[k].position);
            EXPECT_EQ(reflected[k].error, here[k].error);
        }
    }
}

TEST(SeesFirst, SaysWhichOfTwoCoincidentSurfacesARayFromThereHits)
{
    scenes::Scene scene = empty_scene();
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}, scenes::Emission{scenes::Rgb(1)}};
    const std::array<Vec3, 3> v = {Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    scene.triangles = {{v, 0}, {v, 1}};
    const Geometry geometry(scene, ref::Builder::sah_leaf, scenes::coincidences(scene));
    for (const double side : {1.0, -1.0})
        for (const std::uint32_t triangle : {0u, 1u}) {
            const SurfacePoint point = triangle_point(geometry, triangle, Vec3(0.5, 0.25, 0.25));
            const Vec3 towards(0, 0, side);
            const auto hit = intersect(geometry, {point.position + towards, -towards});
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->primitive, side > 0 ? 1u : 0u); // the emitter from its front only
            EXPECT_EQ(sees_first(geometry, point, towards), hit->primitive == triangle);
        }
}

struct Ball {
    double radius, distance;
};

/// Radii and distances from the origin with ratios of 1e-8 to 1e8, at several scales.
std::vector<Ball> balls()
{
    std::vector<Ball> all;
    for (const double scale : {1e-15, 1.0, 1e15})
        for (const double ratio : {1e-8, 1e-4, 1e-2, 1.0, 1e4, 1e8})
            all.push_back({scale * ratio, scale});
    return all;
}

TEST(SurfacePoint, HasItsNormalAtAnyScale) // the square of an area is a product of four lengths
{
    for (const double size : {1e-100, 1.0, 1e100}) {
        scenes::Scene scene = empty_scene();
        scene.triangles = {{{Vec3(0), Vec3(size, 0, 0), Vec3(0, size, 0)}, 0}};
        EXPECT_EQ(triangle_point(Geometry(scene), 0, Vec3(1) / 3.0).normal, Vec3(0, 0, 1)) << size;
    }
}

TEST(LeaveSurface, ARayFromTheOutsideOfASphereDoesNotMeetItAndOneFromTheInsideMeetsTheFarSide)
{
    Random random(2);
    for (const Ball& ball : balls()) {
        for (int i = 0; i < 5000; ++i) {
            const scenes::Sphere sphere{ball.distance * random.direction(), ball.radius, 0};
            scenes::Scene scene = empty_scene();
            scene.spheres = {sphere, sphere};
            const Geometry geometry(scene);
            const Vec3 target =
                sphere.center + ball.radius * random.magnitude(-4, 0) * random.direction();
            const auto point = find_point(geometry, target, ball.radius, random);
            ASSERT_TRUE(point || ball.distance > 1e3 * ball.radius); // beyond that the target is rounded
            if (!point) continue;
            const Vec3 d = leaving_direction(point->normal, 1e-12, random);
            const auto hit = intersect(geometry, {leave_surface(*point, d), d});
            const double cosine = glm::dot(d, point->normal) / glm::length(d);
            if (cosine > 0) {
                ASSERT_FALSE(hit) << "radius " << ball.radius << " distance " << ball.distance;
            } else {
                // The chord is 2 r |cos|, and not shorter from a point inside. A hit at less than half
                // of it is on the surface that was left.
                ASSERT_TRUE(hit) << "radius " << ball.radius << " distance " << ball.distance;
                ASSERT_GE(hit->t * glm::length(d), ball.radius * -cosine);
            }
        }
    }
}

TEST(LeaveSurface, MovesAPointByNoMoreThanItsErrorBound)
{
    Random random(3);
    for (const Case& c : cases()) {
        auto v = sliver(c.size, c.aspect, random);
        const Vec3 away = c.offset * random.direction();
        for (Vec3& vertex : v) vertex += away;
        scenes::Scene scene = empty_scene();
        scene.triangles = {{v, 0}};
        const Geometry geometry(scene);
        const SurfacePoint point = triangle_point(geometry, 0, random.barycentric());
        // The bound: |n|_1 <= sqrt(3) times the largest of 7 u b e + 2 u |p| + 8 u a, where b e and a
        // are at most D; and the rounding of this.
        const double largest = u * (15 * geometry.diagonal() + 2 * (c.offset + 3 * c.size));
        const double moved = glm::length(leave_surface(point, point.normal) - point.position);
        EXPECT_LE(moved, std::sqrt(3.0) * largest + 2 * u * (c.offset + 3 * c.size));
        EXPECT_GT(moved, 0);
    }
}

// A neighbour in the same plane, up to 1e6 times larger, beyond an edge close to the start of the ray.
TEST(LeaveSurface, ARayMeetsNoLargerNeighbourInThePlane)
{
    Random random(8);
    for (const double larger : {1.0, 1e3, 1e6})
        for (const double offset : {0.0, 1.0, 1e4}) {
            int met = 0;
            for (int i = 0; i < 20000; ++i) {
                const Vec3 x = random.direction();
                const Vec3 y = tangent(x, random);
                const Vec3 a = offset * random.direction();
                const Vec3 b = a + x;
                const Vec3 inside = a + random.uniform(0.2, 0.8) * x + random.uniform(0.5, 2) * y;
                const Vec3 outside = a + larger * (random.uniform(-1, 1) * x - y);
                scenes::Scene scene = empty_scene();
                scene.triangles = {{{a, b, inside}, 0}, {{b, a, outside}, 0}};
                const Geometry geometry(scene);
                const double near = random.magnitude(-17, -1);
                const double along = random.uniform(0, 1 - near);
                const auto point = triangle_point(geometry, 0, {1 - near - along, along, near});
                // The far corner and the position are rounded: the planes differ by that angle.
                const double least = std::max(1e-12, 64 * u * (1 + offset));
                const Vec3 d = leaving_direction(point.normal, least, random);
                met += intersect(geometry, {leave_surface(point, d), d}) ? 1 : 0;
            }
            EXPECT_EQ(met, 0) << "larger by " << larger << " offset " << offset;
        }
}

// The position and the weights of a corner in the origin are exact. Of the error bound there is only the
// part for the triangle test: 2 u a_i + 5 u a (derivation in geometry.cpp, 3.), no more than counted
// there.
TEST(LeaveSurface, TheErrorBoundHasRoomForTheRoundingOfTheTriangleTest)
{
    scenes::Scene scene = empty_scene();
    scene.triangles = {{{Vec3(0), Vec3(1, 0.5, 0), Vec3(0, 2, 0.25)}, 0}};
    const Vec3 extent(1, 2, 0.25);
    const Vec3 error = triangle_point(Geometry(scene), 0, Vec3(1, 0, 0)).error;
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(error[axis], u * (2 * extent[axis] + 5 * 2));
        EXPECT_LE(error[axis], u * (2 * extent[axis] + 6 * 2) * (1 + 4 * u));
    }
}

TEST(LeaveSurface, DoesNotDependOnHowLargeTheRestOfTheSceneIs)
{
    Random random(9);
    for (const double size : {1.0, 1e3, 1e6}) {
        scenes::Scene scene = empty_scene();
        scene.triangles = {{sliver(1, 3, random), 0}};
        scene.spheres = {{random.in_cube(), 0.3, 0}};
        const Vec3 b = random.barycentric();
        const Vec3 w = random.direction();
        const auto errors = [&] {
            const Geometry geometry(scene);
            return std::pair(triangle_point(geometry, 0, b).error, sphere_point(geometry, 0, w).error);
        };
        const auto alone = errors();
        scene.triangles.push_back({{size * random.in_cube(), size * random.in_cube(), Vec3(0.0)}, 0});
        EXPECT_EQ(errors(), alone);
    }
}

bool sees(const Geometry& geometry, const SurfacePoint& p, const SurfacePoint& q)
{
    const Vec3 d = q.position - p.position;
    const Vec3 from = leave_surface(p, d);
    return !occluded(geometry, {from, end_at_surface(q, -d) - from, 1.0});
}

double cosine(const SurfacePoint& p, const Vec3& to)
{
    return glm::dot(p.normal, to - p.position) / glm::length(to - p.position);
}

TEST(Segments, AreNotBlockedByTheTrianglesTheyEndOn)
{
    Random random(4);
    for (const Case& c : cases()) {
        int tried = 0;
        int blocked = 0;
        for (int i = 0; i < 3000; ++i) {
            // The second triangle is far smaller or larger, and often nearly in the plane of the first.
            auto v = sliver(c.size, c.aspect, random);
            auto w = sliver(c.size * random.magnitude(-3, 3), c.aspect, random);
            const Vec3 away = c.offset * random.direction();
            const Vec3 normal = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
            const Vec3 shift = c.size * random.magnitude(-2, 2) *
                               (tangent(normal, random) + random.magnitude(-12, 0) * normal);
            const Vec3 to_first = v[0] - w[0];
            for (Vec3& vertex : v) vertex += away;
            for (Vec3& vertex : w) vertex += to_first + away + shift;
            scenes::Scene scene = empty_scene();
            scene.triangles = {{v, 0}, {w, 0}, {{v[1], v[0], v[2]}, 0}, {{w[2], w[0], w[1]}, 0}};
            const Geometry geometry(scene);
            const SurfacePoint p = triangle_point(geometry, 0, random.barycentric());
            const SurfacePoint q = triangle_point(geometry, 1, random.barycentric());
            // The side of a direction is known up to the error of the normal and that of the direction
            // itself: the positions have an error of u |p| on a segment of this length.
            const double length = glm::length(q.position - p.position);
            const double least = 16 * u * c.aspect + 16 * u * (c.offset + geometry.diagonal()) / length;
            if (std::abs(cosine(p, q.position)) < least || std::abs(cosine(q, p.position)) < least)
                continue;
            ++tried;
            blocked += sees(geometry, p, q) ? 0 : 1;
        }
        EXPECT_EQ(blocked, 0) << "size " << c.size << " offset " << c.offset << " aspect " << c.aspect;
        EXPECT_GT(tried, 2000) << "size " << c.size << " offset " << c.offset << " aspect " << c.aspect;
    }
}

TEST(Segments, AreNotBlockedByTheSpheresTheyEndOn)
{
    Random random(5);
    for (const Ball& ball : balls()) {
        int blocked = 0;
        int tried = 0;
        for (int i = 0; i < 6000; ++i) {
            const scenes::Sphere a{ball.distance * random.direction(), ball.radius, 0};
            const double other = ball.radius * random.magnitude(-6, 6);
            const double apart = (ball.radius + other) * (1 + random.magnitude(-6, 3));
            const scenes::Sphere b{a.center + apart * random.direction(), other, 0};
            scenes::Scene scene = empty_scene();
            scene.spheres = {a, b, a, b};
            const Geometry geometry(scene);
            // Points that face each other, often only just.
            const Vec3 towards = glm::normalize(b.center - a.center);
            const auto facing = [&](double side) {
                return side * towards + random.magnitude(-6, 3) * tangent(towards, random);
            };
            const SurfacePoint p = sphere_point(geometry, 0, facing(1));
            const SurfacePoint q = sphere_point(geometry, 1, facing(-1));
            const double length = glm::length(q.position - p.position);
            const double least = 16 * u * (ball.distance + geometry.diagonal()) / length;
            if (cosine(p, q.position) < least || cosine(q, p.position) < least) continue;
            ++tried;
            blocked += sees(geometry, p, q) ? 0 : 1;
        }
        EXPECT_EQ(blocked, 0) << "radius " << ball.radius << " distance " << ball.distance;
        EXPECT_GT(tried, 1000) << "radius " << ball.radius << " distance " << ball.distance;
    }
}

TEST(Segments, AreBlockedByWhatStandsBetweenHoweverCloseToAnEnd) // no shadow ray is too short
{
    for (const double scale : {1e-15, 1.0, 1e15})
        for (const double at : {1e-6, 0.05, 0.5, 0.95, 1 - 1e-6}) {
            const auto square = [&](double z) {
                return scenes::Triangle{
                    {Vec3(-9, -9, z) * scale, Vec3(9, -9, z) * scale, Vec3(0, 9, z) * scale}, 0};
            };
            scenes::Scene scene = empty_scene();
            scene.triangles = {square(0), square(1)};
            const Geometry open(scene);
            EXPECT_TRUE(sees(open, triangle_point(open, 0, Vec3(1) / 3.0),
                             triangle_point(open, 1, Vec3(1) / 3.0)));
            scene.triangles.push_back(square(at));
            const Geometry shut(scene);
            EXPECT_FALSE(sees(shut, triangle_point(shut, 0, Vec3(1) / 3.0),
                              triangle_point(shut, 1, Vec3(1) / 3.0)))
                << "scale " << scale << " at " << at;
        }
}

TEST(Geometry, AWalkThatStaysInsideABoxNeverLeavesIt)
{
    Random random(6);
    for (const double scale : {1e-15, 1.0, 1e15})
        for (const double offset : {0.0, 1e4}) {
            const trees_test::Mesh mesh =
                moved(trees_test::tessellated_box(2, 3), scale, scale * offset * Vec3(1, -0.3, 0.7));
            scenes::Scene scene = scene_of(mesh);
            scene.spheres.push_back({mesh.inside, 0.4 * scale, 0});
            const Geometry geometry(scene);
            Ray ray{mesh.inside + scale * Vec3(0.7), random.direction()};
            for (int i = 0; i < 20000; ++i) {
                const auto hit = intersect(geometry, ray);
                ASSERT_TRUE(hit) << "bounce " << i;
                const SurfacePoint point = surface_point(geometry, ray, *hit);
                Vec3 d = random.direction();
                if ((glm::dot(d, point.normal) < 0) == (glm::dot(ray.direction, point.normal) < 0))
                    d = -d;
                ray = {leave_surface(point, d), d};
            }
        }
}

TEST(Geometry, OfEqualDistancesTheLowestPrimitiveNumberCounts)
{
    scenes::Scene scene = empty_scene();
    const scenes::Triangle triangle{{Vec3(-1, -1, 2), Vec3(3, -1, 2), Vec3(-1, 3, 2)}, 0};
    scene.triangles = {triangle, triangle, triangle};
    scene.spheres = {{Vec3(0, 0, 3), 1, 0}, {Vec3(0, 0, 3), 1, 0}};
    EXPECT_EQ(intersect(Geometry(scene), {Vec3(0), Vec3(0, 0, 1)})->primitive, 0);
    scene.triangles.clear();
    EXPECT_EQ(intersect(Geometry(scene), {Vec3(0), Vec3(0, 0, 1)})->primitive, 0);
}

TEST(Geometry, NegativeZeroInADirectionIsZero)
{
    const trees_test::Mesh mesh = trees_test::tessellated_box(2, 1);
    const scenes::Scene scene = scene_of(mesh);
    const Geometry geometry(scene);
    for (const double zero : {0.0, -0.0})
        for (const double one : {1.0, -1.0}) {
            EXPECT_EQ(intersect(geometry, {Vec3(0.25), Vec3(zero, zero, one)})->t,
                      one > 0 ? 0.75 : 1.25);
            EXPECT_EQ(intersect(geometry, {Vec3(0.25), Vec3(zero, one, zero)})->t,
                      one > 0 ? 0.75 : 1.25);
            EXPECT_EQ(intersect(geometry, {Vec3(0.25), Vec3(one, zero, zero)})->t,
                      one > 0 ? 0.75 : 1.25);
        }
}

TEST(Geometry, ARayInTheFaceOfABoxIsStoppedByTheWallAtItsEnd)
{
    const trees_test::Mesh mesh = trees_test::tessellated_box(2, 1);
    const scenes::Scene scene = scene_of(mesh);
    const Geometry geometry(scene);
    for (const double y : {-0.5, 0.0, 0.25}) {
        const auto hit = intersect(geometry, {Vec3(0.5, y, 1), Vec3(1, 0, 0)}); // in the plane z = 1
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->t, 0.5);
    }
}

/// A matte surface, primitive 0, and a lamp in the same place whose front is where z is larger.
scenes::Scene lamp_in_a_wall(const Vec3& at, double size, double height)
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}, scenes::Emission{scenes::Rgb(1)}};
    const std::array<Vec3, 3> v{at, at + size * Vec3(1, 0, 0), at + size * Vec3(0, 1, 0)};
    const Vec3 up(0, 0, height);
    scene.triangles = {{v, 0}, {{v[0] + up, v[1] + up, v[2] + up}, 1}};
    return scene;
}

TEST(CoincidentSurfaces, ALampIsMetFromItsFrontAndTheWallFromTheOtherSide)
{
    for (const bool turned : {false, true}) {
        scenes::Scene scene = lamp_in_a_wall(Vec3(0), 1, 0);
        if (turned) std::swap(scene.triangles[1].vertices[1], scene.triangles[1].vertices[2]);
        scene.spheres = {{Vec3(9), 1, 0}, {Vec3(9), 1, 1}};
        const Geometry geometry(scene, Builder::sah, coincidences(scene));
        for (const double side : {1.0, -1.0}) {
            const std::uint32_t seen = (side > 0) != turned ? 1 : 0;
            const auto hit = intersect(geometry, {Vec3(0.25, 0.25, side), Vec3(0, 0, -side)});
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->primitive, seen);
            for (const std::uint32_t triangle : {0u, 1u})
                EXPECT_EQ(sees_first(geometry, triangle_point(geometry, triangle, Vec3(1) / 3.0),
                                     Vec3(0, 0, side)),
                          triangle == seen);
        }
        EXPECT_EQ(intersect(geometry, {Vec3(9, 9, 12), Vec3(0, 0, -1)})->primitive, 3);
        EXPECT_EQ(intersect(geometry, {Vec3(9), Vec3(0, 0, -1)})->primitive, 2);
    }
}

TEST(CoincidentSurfaces, ARayFromOneMeetsNotTheOther)
{
    // Small, so that the distance of 16 u between them is the largest part of the error.
    const scenes::Scene scene = lamp_in_a_wall(Vec3(1), 1e-3, 16 * u);
    const Geometry geometry(scene, Builder::sah, coincidences(scene));
    ASSERT_FALSE(geometry.coincident().empty());
    const SurfacePoint wall = triangle_point(geometry, 0, Vec3(1) / 3.0);
    EXPECT_FALSE(occluded(geometry, {leave_surface(wall, Vec3(0, 0, 1)), Vec3(0, 0, 1)}));
}

// Components that differ by more than the digits of a double, and reciprocals beyond 1e30.
TEST(Geometry, TheLengthOfADirectionOnlyScalesT)
{
    const scenes::Scene scene = scene_of(trees_test::tessellated_box(2, 1));
    const Geometry geometry(scene);
    for (const double length : {0x1p-200, 0x1p-60, 1.0, 0x1p200})
        for (const double beside : {0.0, 0x1p-60, -0x1p-60}) {
            const auto hit = intersect(geometry, {Vec3(0.5, 0, 1), length * Vec3(1, beside, 0)});
            ASSERT_TRUE(hit) << length << ' ' << beside;
            EXPECT_DOUBLE_EQ(hit->t, 0.5 / length); // 4 ulp = 8 u; a weight carries 3 u, t another 3
        }
}

TEST(Geometry, AnEmptySceneIsHitByNothing)
{
    const scenes::Scene scene = empty_scene();
    const Geometry geometry(scene);
    EXPECT_FALSE(intersect(geometry, {Vec3(0), Vec3(1, 0, 0)}));
    EXPECT_FALSE(occluded(geometry, {Vec3(0), Vec3(1, 0, 0)}));
}

} // namespace
