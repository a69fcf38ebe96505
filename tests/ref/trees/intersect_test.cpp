// One ray against one primitive, and closed meshes that no ray may pass.

#include "ref/trees/intersect.h"

#include "ref/trees/geometry.h"
#include "tests/ref/trees/meshes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <limits>

namespace {

using boost::multiprecision::cpp_rational;
using ref::Ray;
using ref::Vec3;
using trees_test::Mesh;
using trees_test::Random;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double u = ref::unit_roundoff;

// ---- exact arithmetic ----------------------------------------------------------------------------

using Exact = std::array<cpp_rational, 3>;

Exact exact(const Vec3& v)
{
    return {cpp_rational(v.x), cpp_rational(v.y), cpp_rational(v.z)};
}

Exact operator-(const Exact& a, const Exact& b)
{
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

cpp_rational det(const Exact& a, const Exact& b, const Exact& c)
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

struct ExactHit {
    double t, b0, b1, b2;
};

/// Cramer's rule in rational numbers, rounded only at the end. Empty if the ray is parallel to the
/// plane.
std::optional<ExactHit> exact_hit(const Ray& ray, const std::array<Vec3, 3>& v)
{
    const Exact v0 = exact(v[0]);
    const Exact e1 = exact(v[1]) - v0;
    const Exact e2 = exact(v[2]) - v0;
    const Exact d = exact(ray.direction);
    const Exact s = exact(ray.origin) - v0;
    const Exact minus_d = exact(Vec3(0)) - d;
    const cpp_rational volume = det(minus_d, e1, e2);
    if (volume == 0) return std::nullopt;
    const cpp_rational b1 = det(minus_d, s, e2) / volume;
    const cpp_rational b2 = det(minus_d, e1, s) / volume;
    const cpp_rational t = det(s, e1, e2) / volume;
    const cpp_rational b0 = 1 - b1 - b2;
    return ExactHit{t.convert_to<double>(), b0.convert_to<double>(), b1.convert_to<double>(),
                    b2.convert_to<double>()};
}

int sign(const cpp_rational& x)
{
    return x.sign();
}

int sign(double x)
{
    return (x > 0) - (x < 0);
}

RC_GTEST_PROP(EdgeFunction, HasTheExactSignHoweverCloseTheRayPasses, ()) // map: triangle-edges
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Vec3 p = random.in_cube();
    // q is on the line through 0 and p, except for some last bits.
    Vec3 q = random.uniform(-2, 2) * p;
    for (auto i = random.below(3); i > 0; --i)
        q.x = std::nextafter(q.x, random.uniform(-1, 1) * infinity);
    const cpp_rational truth =
        cpp_rational(p.x) * cpp_rational(q.y) - cpp_rational(p.y) * cpp_rational(q.x);
    RC_CLASSIFY(p.x * q.y == p.y * q.x, "products round to the same");
    RC_ASSERT(sign(ref::edge_function(p, q)) == sign(truth));
    RC_ASSERT(ref::edge_function(p, q) == -ref::edge_function(q, p));
}

// The sheared vertices differ from the exact ones by at most 7 u D (see geometry.cpp), where D is the
// largest coordinate of v - o. So the result is certain for a ray that passes the projected triangle
// at a greater distance from its edges, which in barycentric coordinates is 7 u D / height. The factor
// of 4 accounts for the two ends of an edge moving in opposite directions, and for the third vertex
// moving too.
TEST(IntersectTriangle, AgreesWithExactArithmetic) // map: triangle-shear, triangle-distance
{
    Random random(1);
    int hits = 0;
    int unclear = 0;
    const int rays = 20000;
    for (int i = 0; i < rays; ++i) {
        const double scale = std::ldexp(1, static_cast<int>(random.below(100)) - 50);
        const Vec3 middle = (i % 2 == 0 ? 0.0 : random.magnitude(0, 4)) * scale * random.direction();
        std::array<Vec3, 3> v{};
        for (Vec3& vertex : v) vertex = middle + scale * random.in_cube();
        const Vec3 b = random.barycentric() * 1.5 - 0.25; // inside, and not far outside
        const Vec3 origin = middle + scale * random.magnitude(-2, 2) * random.in_cube();
        const Ray ray{origin,
                      (b[0] * v[0] + b[1] * v[1] + b[2] * v[2] - origin) * random.magnitude(-3, 3)};
        const auto truth = exact_hit(ray, v);
        if (!truth) continue;

        const ref::ShearedRay sheared(ray);
        const Vec3 A = sheared.shear(v[0]);
        const Vec3 B = sheared.shear(v[1]);
        const Vec3 C = sheared.shear(v[2]);
        double D = 0;
        for (const Vec3& vertex : v)
            for (int axis = 0; axis < 3; ++axis) D = std::max(D, std::abs(vertex[axis] - origin[axis]));
        const double area = std::abs((B.x - A.x) * (C.y - A.y) - (B.y - A.y) * (C.x - A.x));
        const double edge = std::max({std::hypot(B.x - A.x, B.y - A.y), std::hypot(C.x - A.x, C.y - A.y),
                                      std::hypot(C.x - B.x, C.y - B.y)});
        const double margin = 4 * 7 * u * D * edge / area;
        // A change of the weights by `margin` changes t by at most the spread of the vertices' own t.
        const double spread = std::max({A.z, B.z, C.z}) - std::min({A.z, B.z, C.z});
        const double t_margin = 3 * margin * spread + 8 * u * (std::abs(truth->t) + spread);

        const auto hit = ref::intersect_triangle(sheared, v);
        const double inside = std::min({truth->b0, truth->b1, truth->b2});
        if (inside > margin && truth->t > t_margin) {
            ASSERT_TRUE(hit) << "ray " << i;
            EXPECT_NEAR(hit->t, truth->t, t_margin) << "ray " << i;
            EXPECT_NEAR(hit->barycentric[0], truth->b0, 2 * margin + 8 * u);
            EXPECT_NEAR(hit->barycentric[1], truth->b1, 2 * margin + 8 * u);
            EXPECT_NEAR(hit->barycentric[2], truth->b2, 2 * margin + 8 * u);
            ++hits;
        } else if (inside < -margin || truth->t < -t_margin) {
            EXPECT_FALSE(hit) << "ray " << i;
        } else {
            ++unclear;
        }
    }
    EXPECT_GT(hits, rays / 8);
    EXPECT_LT(unclear, rays / 1000);
}

TEST(IntersectTriangle, BothSidesCountAndSoDoEdgesAndCorners)
{
    const std::array<Vec3, 3> triangle{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
    for (const double from : {1.0, -1.0})
        for (const Vec3& at : {Vec3(0.25, 0.25, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                               Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0.5, 0.5, 0)}) {
            const Ray ray{at + Vec3(0, 0, from), Vec3(0, 0, -from)};
            const auto hit = ref::intersect_triangle(ref::ShearedRay(ray), triangle);
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->t, 1.0);
        }
}

TEST(IntersectTriangle, ATriangleSeenEdgeOnAndADegenerateOneAreNotHit)
{
    const Ray ray{Vec3(-1, 0.25, 0), Vec3(1, 0, 0)};
    EXPECT_FALSE(
        ref::intersect_triangle(ref::ShearedRay(ray), {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}));
    EXPECT_FALSE(ref::intersect_triangle(ref::ShearedRay(ray),
                                         {Vec3(0, 0, -1), Vec3(0, 0.25, 0), Vec3(0, 0.5, 1)}));
    EXPECT_FALSE(ref::intersect_triangle(ref::ShearedRay(ray),
                                         {Vec3(0, 0.25, 0), Vec3(0, 0.25, 0), Vec3(0, 0.25, 0)}));
}

TEST(IntersectTriangle, TheLimitIsStrictAndZeroIsNoHit)
{
    const std::array<Vec3, 3> triangle{Vec3(-1, -1, 2), Vec3(3, -1, 2), Vec3(-1, 3, 2)};
    const auto hit = [&](const Ray& ray) {
        return ref::intersect_triangle(ref::ShearedRay(ray), triangle);
    };
    const Vec3 z(0, 0, 1);
    EXPECT_FALSE(hit({Vec3(0), z, 2.0}));
    EXPECT_TRUE(hit({Vec3(0), z, std::nextafter(2.0, 3.0)}));
    EXPECT_FALSE(hit({Vec3(0, 0, 2), z}));
    EXPECT_FALSE(hit({Vec3(0, 0, 2), -z}));
    EXPECT_TRUE(hit({Vec3(0, 0, std::nextafter(2.0, 0.0)), z}));
    EXPECT_FALSE(hit({Vec3(0), -z}));
}

// Rays from points in the plane of a triangle, up to rounding: a reported hit must certainly be in
// front of the origin. The test uses the sheared ray and triangle; the sign of t is that of U Az + V
// Bz + W Cz, divided by that of U + V + W.
TEST(IntersectTriangle, WhatIsHitIsCertainlyAhead)
{
    Random random(6);
    int hits = 0;
    int misses = 0;
    for (int i = 0; i < 20000; ++i) {
        const std::array<Vec3, 3> v{random.in_cube(), random.in_cube(), random.in_cube()};
        const Vec3 b = random.barycentric();
        const Ray ray{b[0] * v[0] + b[1] * v[1] + b[2] * v[2], random.direction()};
        const ref::ShearedRay sheared(ray);
        if (!ref::intersect_triangle(sheared, v)) {
            ++misses;
            continue;
        }
        ++hits;
        const Exact A = exact(sheared.shear(v[0]));
        const Exact B = exact(sheared.shear(v[1]));
        const Exact C = exact(sheared.shear(v[2]));
        const cpp_rational U = C[0] * B[1] - C[1] * B[0];
        const cpp_rational V = A[0] * C[1] - A[1] * C[0];
        const cpp_rational W = B[0] * A[1] - B[1] * A[0];
        const cpp_rational ahead = U * A[2] + V * B[2] + W * C[2];
        EXPECT_EQ(sign(ahead), sign(cpp_rational(U + V + W))) << "ray " << i;
    }
    EXPECT_GT(misses, 15000); // an uncertain hit is not reported
    EXPECT_GT(hits, 500);     // and a certain one is
}

TEST(IntersectTriangle, TinyTrianglesAreHitAsOftenAsLargeOnes) // an absolute threshold on det loses them
{
    const auto hits = [](double scale) {
        Random random(5);
        int count = 0;
        for (int i = 0; i < 10000; ++i) {
            const std::array<Vec3, 3> v{scale * random.in_cube(), scale * random.in_cube(),
                                        scale * random.in_cube()};
            const Ray ray{scale * random.in_cube(), random.direction()};
            count += ref::intersect_triangle(ref::ShearedRay(ray), v).has_value() ? 1 : 0;
        }
        return count;
    };
    const int expected = hits(1);
    EXPECT_GT(expected, 300);
    for (const int exponent : {-150, -100, -50, 50, 100, 150})
        EXPECT_EQ(hits(std::ldexp(1, exponent)), expected) << "scale 2^" << exponent;
}

TEST(IntersectTriangle, NoNumberInAndNoHitOut)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::array<Vec3, 3> triangle{Vec3(-1, -1, 2), Vec3(3, -1, 2), Vec3(-1, 3, 2)};
    for (const Ray& ray :
         {Ray{Vec3(0), Vec3(0)}, Ray{Vec3(nan, 0, 0), Vec3(0, 0, 1)}, Ray{Vec3(0), Vec3(0, nan, 1)},
          Ray{Vec3(infinity, 0, 0), Vec3(0, 0, 1)}, Ray{Vec3(0), Vec3(0, 0, infinity)}}) {
        EXPECT_FALSE(ref::intersect_triangle(ref::ShearedRay(ray), triangle));
        EXPECT_FALSE(ref::intersect_sphere(ray, Vec3(0, 0, 2), 1));
    }
}

RC_GTEST_PROP(IntersectTriangle, ScalingByAPowerOfTwoScalesTAndNothingElse, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::array<Vec3, 3> v{random.in_cube(), random.in_cube(), random.in_cube()};
    const Vec3 b = random.barycentric();
    const Vec3 origin = 3.0 * random.in_cube();
    const Vec3 direction = (b[0] * v[0] + b[1] * v[1] + b[2] * v[2] - origin) * random.magnitude(-3, 3);
    const double scale = std::ldexp(1, *rc::gen::inRange(-320, 320)); // products of three lengths
    const double stretch = std::ldexp(1, *rc::gen::inRange(-50, 50));
    const auto hit = ref::intersect_triangle(ref::ShearedRay({origin, direction}), v);
    const auto scaled = ref::intersect_triangle(ref::ShearedRay({scale * origin, stretch * direction}),
                                                {scale * v[0], scale * v[1], scale * v[2]});
    RC_ASSERT(hit.has_value() == scaled.has_value());
    RC_PRE(hit.has_value());
    RC_ASSERT(scaled->t == hit->t * scale / stretch);
    RC_ASSERT(scaled->barycentric == hit->barycentric);
}

// ---- spheres -------------------------------------------------------------------------------------

/// The squared distance of the line from the centre, minus r^2, in units of r^2; exact except for the
/// last rounding.
double exact_miss(const Ray& ray, const Vec3& center, double radius)
{
    const Exact f = exact(ray.origin) - exact(center);
    const Exact d = exact(ray.direction);
    const auto dot = [](const Exact& a, const Exact& b) {
        return cpp_rational(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    };
    const cpp_rational r2 = cpp_rational(radius) * cpp_rational(radius);
    const cpp_rational along = dot(f, d);
    return cpp_rational((dot(f, f) - along * along / dot(d, d)) / r2 - 1).convert_to<double>();
}

// f = o - c, (b/a) d and l are each rounded by u |f|, so |l| has an error of at most 3 u |f| + 2 u r.
// Therefore |l|^2 / r^2 - 1 is certain if it is larger than twice that over r.
TEST(IntersectSphere, IsHitOrMissedAsExactArithmeticSays) // map: sphere-discriminant, sphere-distance
{
    Random random(2);
    int hits = 0;
    const int rays = 20000;
    for (int i = 0; i < rays; ++i) {
        const double scale = std::ldexp(1, static_cast<int>(random.below(100)) - 50);
        const double radius = scale;
        const Vec3 center = scale * random.magnitude(-2, 4) * random.in_cube();
        const Vec3 origin = center + radius * random.magnitude(-8, 8) * random.direction();
        const Vec3 target = center + radius * random.magnitude(-1, 0.3) * random.direction();
        const Ray ray{origin, (target - origin) * random.magnitude(-3, 3)};
        const double distance = glm::length(origin - center);
        const double miss = exact_miss(ray, center, radius);
        const double margin = 2 * (3 * u * distance + 2 * u * radius) / radius;
        const auto t = ref::intersect_sphere(ray, center, radius);
        if (miss > margin) {
            EXPECT_FALSE(t) << "ray " << i;
        }
        if (miss < -margin) {
            const bool outside_and_going_away =
                distance > radius && glm::dot(target - origin, center - origin) < 0;
            if (outside_and_going_away) continue;
            ASSERT_TRUE(t) << "ray " << i << " at " << distance / radius << " radii";
            // On the surface: the error of t is that of the half chord, h^2 = -miss r^2.
            const double half_chord = radius * std::sqrt(-miss);
            const double t_error = 8 * u * distance + margin * radius * radius / half_chord;
            const double residual = glm::length(ray.origin + *t * ray.direction - center) - radius;
            EXPECT_LE(std::abs(residual), t_error + 4 * u * (glm::length(center) + distance))
                << "ray " << i;
            ++hits;
        }
    }
    EXPECT_GT(hits, rays / 5);
}

TEST(IntersectSphere, FromInsideTheFarSideIsHit)
{
    EXPECT_EQ(ref::intersect_sphere({Vec3(0), Vec3(0, 0, 2)}, Vec3(0), 1), 0.5);
    EXPECT_EQ(ref::intersect_sphere({Vec3(0, 0, -2), Vec3(0, 0, 1)}, Vec3(0), 1), 1.0);
    EXPECT_EQ(ref::intersect_sphere({Vec3(0, 0, 2), Vec3(0, 0, 1)}, Vec3(0), 1), std::nullopt);
    EXPECT_EQ(ref::intersect_sphere({Vec3(0, 0, -2), Vec3(0, 0, 1), 1.0}, Vec3(0), 1), std::nullopt);
    EXPECT_EQ(ref::intersect_sphere({Vec3(0, 0, 0.5), Vec3(0, 0, 1), 0.25}, Vec3(0), 1), std::nullopt);
}

RC_GTEST_PROP(IntersectSphere, ScalingByAPowerOfTwoScalesTAndNothingElse, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Vec3 center = random.in_cube();
    const double radius = random.uniform(0.1, 1);
    const Vec3 origin = 3.0 * random.in_cube();
    const Vec3 direction = center + 1.1 * radius * random.direction() - origin;
    // Squares of lengths and of t are within range; products of four lengths are not.
    const double scale = std::ldexp(1, *rc::gen::inRange(-400, 400));
    const double stretch = std::ldexp(1, *rc::gen::inRange(-400, 400));
    const auto t = ref::intersect_sphere({origin, direction}, center, radius);
    const auto scaled =
        ref::intersect_sphere({scale * origin, stretch * direction}, scale * center, scale * radius);
    RC_ASSERT(t.has_value() == scaled.has_value());
    RC_PRE(t.has_value());
    RC_ASSERT(*scaled == *t * scale / stretch);
}

// ---- closed meshes -------------------------------------------------------------------------------

std::vector<Mesh> closed_meshes()
{
    Random random(3);
    return {tetrahedron(random),
            tetrahedron(random),
            trees_test::icosphere(1, 1),
            trees_test::icosphere(1, 1e-3),
            trees_test::icosphere(0, 1e-6),
            trees_test::tessellated_box(1, 1),
            trees_test::tessellated_box(3, 12),
            trees_test::tessellated_box(2, 30)};
}

struct Placement {
    double scale;
    Vec3 offset;
};

/// The places of the meshes: small, large, and away from the origin by up to 1e4 times their size.
std::vector<Placement> placements()
{
    return {{1, Vec3(0)},
            {1e-15, Vec3(0)},
            {1e15, Vec3(0)},
            {1, Vec3(1e4, -7e3, 1)},
            {1e-15, Vec3(1e-11, 0, -1e-11)}};
}

/// Points well inside: a star-shaped mesh contains all points between its centre and its surface.
Vec3 inside(const Mesh& mesh, Random& random)
{
    const auto& [a, b, c] = mesh.triangles[random.below(mesh.triangles.size())];
    const Vec3 w = random.barycentric();
    const Vec3 on_surface = w[0] * mesh.vertices[a] + w[1] * mesh.vertices[b] + w[2] * mesh.vertices[c];
    return mesh.inside + random.uniform(0, 0.9) * (on_surface - mesh.inside);
}

template <typename Aim>
void expect_no_escape(int rays_per_mesh, Aim aim)
{
    Random random(4);
    for (const Placement& placement : placements()) {
        int number = 0;
        for (const Mesh& unit : closed_meshes()) {
            const Mesh mesh = moved(unit, placement.scale, placement.offset);
            const scenes::Scene scene = scene_of(mesh);
            const ref::Geometry geometry(scene);
            int escaped = 0;
            for (int i = 0; i < rays_per_mesh; ++i) {
                const Vec3 origin = inside(mesh, random);
                escaped += intersect(geometry, {origin, aim(mesh, origin, random)}) ? 0 : 1;
            }
            EXPECT_EQ(escaped, 0) << "mesh " << number << " scale " << placement.scale;
            ++number;
        }
    }
}

TEST(ClosedMeshes, NoRandomRayEscapes) // 5 places x 8 meshes x 25,000 = 10^6 rays
{
    expect_no_escape(25000, [](const Mesh&, const Vec3&, Random& random) { return random.direction(); });
}

TEST(ClosedMeshes, NoRayAimedAtAVertexEscapes)
{
    expect_no_escape(5000, [](const Mesh& mesh, const Vec3& origin, Random& random) {
        return mesh.vertices[random.below(mesh.vertices.size())] - origin;
    });
}

TEST(ClosedMeshes, NoRayAimedAtAnEdgeEscapes)
{
    expect_no_escape(5000, [](const Mesh& mesh, const Vec3& origin, Random& random) {
        const auto& triangle = mesh.triangles[random.below(mesh.triangles.size())];
        const Vec3& a = mesh.vertices[triangle[0]];
        const Vec3& b = mesh.vertices[triangle[1]];
        const double at = random.below(4) == 0 ? 0.5 : random.uniform();
        return a + at * (b - a) - origin;
    });
}

TEST(ClosedMeshes, NoAxisParallelRayThroughTheGridEscapes)
{
    // Origins and directions on a lattice that also contains the vertices: every kind of exact tie.
    const Mesh mesh = trees_test::tessellated_box(4, 1);
    const scenes::Scene scene = scene_of(mesh);
    const ref::Geometry geometry(scene);
    for (double x = -0.75; x < 1; x += 0.25)
        for (double y = -0.75; y < 1; y += 0.25)
            for (double z = -0.75; z < 1; z += 0.25)
                for (int i = 0; i < 27; ++i) {
                    const Vec3 direction(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
                    if (direction == Vec3(0)) continue;
                    EXPECT_TRUE(intersect(geometry, {Vec3(x, y, z), direction}));
                }
}

} // namespace
