// Rays in single precision: one triangle compared with the reference, trees compared with the search
// without a tree, and closed meshes that no ray may pass.

#include "cuda/trees/traverse.h"

#include "tests/cuda/trees/binary_tree.h"
#include "tests/cuda/trees/build_on.h"
#include "tests/cuda/trees/float_limits.h"
#include "tests/cuda/trees/hit_bounds.h"
#include "tests/cuda/trees/triangles.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>

namespace {

using fast::Hit;
using fast::Ray;
using fast::Triangle;
using fast::Vec3;
using fast_trees_test::infinity;
using fast_trees_test::linear_search;
using fast_trees_test::Traceable;
using fast_trees_test::u;
using trees_test::Random;

// map: triangle-shear, triangle-distance
TEST(IntersectTriangleInFloat, AgreesWithTheReferenceWithinItsRounding)
{
    Random random(1);
    int hits = 0;
    int unclear = 0;
    constexpr int rays = 50000;
    for (int i = 0; i < rays; ++i) {
        const double scale = std::ldexp(1, static_cast<int>(random.below(60)) - 30);
        const ref::Vec3 middle =
            (i % 2 == 0 ? 0.0 : random.magnitude(0, 2)) * scale * random.direction();
        Triangle triangle{};
        for (Vec3& vertex : triangle.vertices) vertex = Vec3(middle + scale * random.in_cube());
        const auto v = fast_trees_test::exactly(triangle);
        const ref::Vec3 b = random.barycentric() * 1.5 - 0.25; // inside, and not far outside
        const Vec3 origin(middle + scale * random.magnitude(-1, 1) * random.in_cube());
        const Vec3 direction((b[0] * v[0] + b[1] * v[1] + b[2] * v[2] - ref::Vec3(origin)) *
                             random.magnitude(-3, 3));
        const Ray ray{origin, infinity, direction};

        const fast_trees_test::HitBounds bounds = fast_trees_test::hit_bounds(ray, triangle);
        const auto expected = ref::intersect_triangle(ref::ShearedRay(fast_trees_test::exactly(ray)), v);
        Hit hit{};
        const bool is_hit = intersect_triangle(fast::ShearedRay(ray), triangle, ray.t_max, hit);
        if (bounds.certain) {
            ASSERT_TRUE(is_hit && expected) << "ray " << i;
            EXPECT_TRUE(bounds.lowest <= hit.t && hit.t <= bounds.highest) << "ray " << i;
            EXPECT_NEAR(hit.b1, expected->barycentric[1], 2 * bounds.margin + 2 * u) << "ray " << i;
            EXPECT_NEAR(hit.b2, expected->barycentric[2], 2 * bounds.margin + 2 * u) << "ray " << i;
            ++hits;
        } else if (bounds.possible) {
            ++unclear;
        } else {
            EXPECT_FALSE(is_hit) << "ray " << i;
        }
    }
    EXPECT_GT(hits, rays / 8);
    EXPECT_LT(unclear, rays / 50);
}

// In the 64 bits of a long double both products are exact, and the difference has the exact sign.
RC_GTEST_PROP(EdgeSignInFloat, IsExactHoweverCloseTheRayPasses, ()) // map: triangle-edges
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const Vec3 p(random.in_cube());
    Vec3 q = static_cast<float>(random.uniform(-2, 2)) * p; // the line of the edge, up to some last bits
    for (auto i = random.below(3); i > 0; --i)
        q.x = std::nextafter(q.x, random.below(2) == 0 ? infinity : -infinity);
    const long double exact = static_cast<long double>(p.x) * q.y - static_cast<long double>(p.y) * q.x;
    const float sign = fast::edge_sign(p, q);
    RC_CLASSIFY(p.x * q.y == p.y * q.x, "products round to the same");
    RC_ASSERT((sign > 0) == (exact > 0) && (sign < 0) == (exact < 0));
    RC_ASSERT(sign == -fast::edge_sign(q, p));
}

TEST(IntersectTriangleInFloat, CountsBothSidesEdgesAndCornersAndNothingEdgeOn)
{
    const Triangle triangle{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}};
    const Triangle reversed{{Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(1, 0, 0)}};
    Hit hit{};
    // The side that a ray comes from does not change the signs of the edge functions, the order of the
    // vertices does.
    for (const Triangle& one : {triangle, reversed})
        for (const float from : {1.0f, -1.0f})
            for (const Vec3& at : {Vec3(0.25, 0.25, 0), Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0),
                                   Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0.5, 0.5, 0)}) {
                const Ray ray{at + Vec3(0, 0, from), infinity, Vec3(0, 0, -from)};
                ASSERT_TRUE(intersect_triangle(fast::ShearedRay(ray), one, infinity, hit));
                EXPECT_EQ(hit.t, 1.0f);
                EXPECT_FALSE(
                    intersect_triangle(fast::ShearedRay(ray), one, 1, hit)); // t < limit, strictly
            }
    const Ray edge_on{Vec3(-1, 0.25, 0), infinity, Vec3(1, 0, 0)};
    EXPECT_FALSE(intersect_triangle(fast::ShearedRay(edge_on), triangle, infinity, hit));
    const Ray no_direction{Vec3(0.25, 0.25, 1), infinity, Vec3(0)};
    EXPECT_FALSE(intersect_triangle(fast::ShearedRay(no_direction), triangle, infinity, hit));
}

// ---- trees -----------------------------------------------------------------------------------------

bool same(const Hit& a, const Hit& b)
{
    using Words = std::array<std::uint32_t, 4>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

/// Whether the narrow and the wide tree give the hit of the linear search, bit for bit.
bool agrees(const Traceable& tree, std::span<const Triangle> triangles, const Ray& ray)
{
    const Hit expected = linear_search(triangles, ray);
    const bool any = expected.primitive != fast::no_primitive;
    return same(intersect(tree.narrow(), ray), expected) &&
           same(intersect(tree.wide(), ray), expected) && occluded(tree.narrow(), ray) == any &&
           occluded(tree.wide(), ray) == any;
}

/// Triangles of all sizes, either anywhere or on a lattice, which makes ties, flat boxes and
/// duplicates.
std::vector<Triangle> soup(std::size_t n, Random& random)
{
    const bool lattice = random.below(2) == 0;
    const double scale = random.magnitude(-10, 10);
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < n; ++i) {
        const ref::Vec3 middle = random.in_cube();
        const double size = random.magnitude(-3, 0);
        Triangle triangle{};
        for (Vec3& vertex : triangle.vertices) {
            const ref::Vec3 v = middle + size * random.in_cube();
            vertex = lattice ? glm::round(Vec3(4.0 * v)) : Vec3(scale * v);
        }
        triangles.push_back(i > 0 && random.below(8) == 0 ? triangles[random.below(i)] : triangle);
    }
    return triangles;
}

RC_GTEST_PROP(TraverseInFloat, FindsWhatTheLinearSearchFinds, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const auto triangles = soup(*rc::gen::inRange<std::size_t>(0, 200), random);
    const Traceable tree(triangles);
    for (int i = 0; i < 50; ++i) {
        // From a vertex or near it, to a vertex or near it, or along an axis.
        const auto place = [&] {
            if (triangles.empty()) return Vec3(random.in_cube());
            const Vec3 at = triangles[random.below(triangles.size())].vertices[random.below(3)];
            return random.below(2) == 0 ? at : at * Vec3(random.in_cube() * 2.0);
        };
        Ray ray{place(), random.below(2) == 0 ? infinity : 1.0f, Vec3(0)};
        ray.direction = place() - ray.origin;
        if (random.below(3) == 0) {
            ray.direction = Vec3(0);
            ray.direction[static_cast<int>(random.below(3))] = random.below(2) == 0 ? 1.0f : -1.0f;
            if (random.below(2) == 0) ray.direction = -ray.direction; // with zeros of both signs
        }
        RC_ASSERT(agrees(tree, triangles, ray));
    }
}

TEST(TraverseInFloat,
     TheDeepestTreeFitsTheStack) // one level for each bit of the code, then for each bit of the index
{
    // Centroids in the cells of the codes 0, 1, 2, 4, ..., 2^62, the first of them 1024 times. All
    // triangles are so large that every ray from the middle enters every box.
    std::vector<Triangle> triangles;
    const auto add = [&](const Vec3& middle) {
        const Vec3 half(64, 64, 64);
        triangles.push_back({{middle - half, middle + half, middle + half * Vec3(1, -1, 1)}});
    };
    for (int i = 0; i < 1024; ++i) add(Vec3(0));
    for (int bit = 0; bit < 63; ++bit) {
        Vec3 middle(0);
        middle[2 - bit % 3] = std::ldexp(1.0f, bit / 3 - 20);
        add(middle);
    }
    add(Vec3(2 - 0x1p-20f)); // so that a cell is 2^-20 wide
    const Traceable tree(triangles);
    Random random(2);
    for (int i = 0; i < 100; ++i) {
        const Ray ray{Vec3(random.in_cube()), infinity, Vec3(random.direction())};
        EXPECT_TRUE(agrees(tree, triangles, ray));
    }
}

TEST(TraverseInFloat, ASingleTriangleAndNoneNeedNoNodes)
{
    const std::vector<Triangle> one = {{{Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)}}};
    EXPECT_TRUE(agrees(Traceable(one), one, {Vec3(0.25, 0.25, 0), infinity, Vec3(0, 0, 1)}));
    EXPECT_FALSE(occluded(Traceable(one).wide(), {Vec3(0.25, 0.25, 0), infinity, Vec3(0, 0, -1)}));
    const std::vector<Triangle> none;
    EXPECT_FALSE(occluded(Traceable(none).narrow(), {Vec3(0), infinity, Vec3(0, 0, 1)}));
    EXPECT_FALSE(occluded(Traceable(none).wide(), {Vec3(0), infinity, Vec3(0, 0, 1)}));
}

TEST(TraverseInFloat, EveryExecutorFindsTheSameHits)
{
    Random random(3);
    const auto triangles = soup(300, random);
    const Traceable tree(triangles);
    std::vector<Ray> rays;
    for (int i = 0; i < 500; ++i)
        rays.push_back({triangles[0].vertices[0], infinity, Vec3(random.direction())});
    std::vector<Hit> serial(500);
    std::vector<Hit> threaded(500);
    std::vector<std::uint8_t> any(500);
    fast::SerialExecutor serial_executor;
    fast::ThreadedExecutor threads(3, 1);
    serial_executor(500, fast::IntersectRays<fast_trees_test::TreeView>{tree.narrow(), rays, serial});
    threads(500, fast::IntersectRays<fast::Surfaces<false>>{tree.wide(), rays, threaded});
    threads(500, fast_trees_test::TestOcclusion<fast::Surfaces<false>>{tree.wide(), rays, any});
    for (std::size_t i = 0; i < 500; ++i) {
        EXPECT_TRUE(same(serial[i], threaded[i])) << i;
        EXPECT_EQ(any[i] == 1, serial[i].primitive != fast::no_primitive) << i;
    }
}

// ---- closed meshes ---------------------------------------------------------------------------------

TEST(ClosedMeshesInFloat, NoRayFromInsideEscapes)
{
    Random random(4);
    const std::vector<trees_test::Mesh> meshes = {tetrahedron(random),
                                                  trees_test::icosphere(1, 1),
                                                  trees_test::icosphere(1, 1e-3),
                                                  trees_test::icosphere(0, 1e-6),
                                                  trees_test::tessellated_box(1, 1),
                                                  trees_test::tessellated_box(3, 12)};
    struct Placement {
        double scale;
        ref::Vec3 offset;
    };
    const std::vector<Placement> placements = {
        {1, ref::Vec3(0)}, {1e-12, ref::Vec3(0)}, {1e12, ref::Vec3(0)}, {1, ref::Vec3(100, -70, 0)}};
    for (const Placement& placement : placements)
        for (std::size_t number = 0; number < meshes.size(); ++number) {
            const trees_test::Mesh mesh = moved(meshes[number], placement.scale, placement.offset);
            const Traceable tree(fast_trees_test::triangles_of(mesh));
            int escaped = 0;
            for (int i = 0; i < 6000; ++i) {
                const auto& [a, b, c] = mesh.triangles[random.below(mesh.triangles.size())];
                const ref::Vec3 w = random.barycentric();
                const ref::Vec3 on_surface =
                    w[0] * mesh.vertices[a] + w[1] * mesh.vertices[b] + w[2] * mesh.vertices[c];
                const Vec3 origin(mesh.inside + random.uniform(0, 0.9) * (on_surface - mesh.inside));
                // Anywhere; at a vertex; at a point of an edge.
                const double at = random.below(4) == 0 ? 0.5 : random.uniform();
                const ref::Vec3 on_edge = mesh.vertices[a] + at * (mesh.vertices[b] - mesh.vertices[a]);
                const Vec3 direction = i % 3 == 0   ? Vec3(random.direction())
                                       : i % 3 == 1 ? Vec3(mesh.vertices[a]) - origin
                                                    : Vec3(on_edge) - origin;
                const Ray ray{origin, infinity, direction};
                escaped += occluded(tree.wide(), ray) && occluded(tree.narrow(), ray) ? 0 : 1;
            }
            EXPECT_EQ(escaped, 0) << "mesh " << number << " scale " << placement.scale << " at "
                                  << placement.offset.x;
        }
}

} // namespace
