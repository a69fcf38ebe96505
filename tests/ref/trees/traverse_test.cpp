// Queries with a tree must give the same hits as queries without one, bit for bit.

#include "ref/trees/traverse.h"

#include "ref/trees/geometry.h"
#include "tests/ref/trees/boxes.h"
#include "tests/ref/trees/linear_search.h"

#include <gtest/gtest.h>

namespace {

using ref::Aabb;
using ref::Builder;
using ref::Geometry;
using ref::Hit;
using ref::Ray;
using ref::Tree;
using ref::Vec3;
using trees_test::Random;

constexpr std::array builders = {Builder::morton30, Builder::morton63, Builder::sah, Builder::sah_leaf};

bool same(const std::optional<Hit>& a, const std::optional<Hit>& b)
{
    if (!a || !b) return a.has_value() == b.has_value();
    return a->t == b->t && a->primitive == b->primitive && a->barycentric == b->barycentric;
}

/// Meshes, slivers, duplicates, degenerate triangles and spheres, close together.
scenes::Scene crowded_scene(Random& random)
{
    scenes::Scene scene =
        scene_of(random.below(2) == 0 ? trees_test::tessellated_box(2, random.uniform(1, 20))
                                      : trees_test::icosphere(1, random.magnitude(-9, 0)));
    for (int i = 0; i < 12; ++i) {
        const Vec3 at = 0.8 * random.in_cube();
        const Vec3 along = random.in_cube();
        // Long thin ones, with aspect ratios up to 1e15.
        scene.triangles.push_back(
            {{at, at + along, at + 0.5 * along + random.magnitude(-15, 0) * random.in_cube()}, 0});
    }
    for (int i = 0; i < 8; ++i) { // in planes of constant x, y or z
        std::array<Vec3, 3> v{random.in_cube(), random.in_cube(), random.in_cube()};
        const int axis = static_cast<int>(random.below(3));
        for (Vec3& vertex : v) vertex[axis] = 0.5;
        scene.triangles.push_back({v, 0});
    }
    for (int i = 0; i < 6; ++i)
        scene.triangles.push_back(scene.triangles[random.below(scene.triangles.size())]);
    scene.triangles.push_back({{Vec3(0.1), Vec3(0.1), Vec3(0.1)}, 0});
    scene.triangles.push_back({{Vec3(0.1), Vec3(0.2), Vec3(0.4)}, 0});
    for (int i = 0; i < 6; ++i)
        scene.spheres.push_back({random.in_cube(), random.magnitude(-6, 0.3), 0});
    scene.spheres.push_back(scene.spheres[0]);
    return scene;
}

scenes::Scene moved(scenes::Scene scene, double scale, const Vec3& offset)
{
    for (scenes::Triangle& triangle : scene.triangles)
        for (Vec3& vertex : triangle.vertices) vertex = scale * vertex + offset;
    for (scenes::Sphere& sphere : scene.spheres) {
        sphere.center = scale * sphere.center + offset;
        sphere.radius *= scale;
    }
    return scene;
}

/// A point of some primitive: on a sphere, at a corner, on an edge or within a triangle.
Vec3 some_point(const scenes::Scene& scene, Random& random)
{
    const auto i = random.below(primitive_count(scene));
    if (i >= scene.triangles.size()) {
        const scenes::Sphere& sphere = scene.spheres[i - scene.triangles.size()];
        return sphere.center + sphere.radius * random.direction();
    }
    const auto& v = scene.triangles[i].vertices;
    const Vec3 b = random.barycentric();
    switch (random.below(3)) {
    case 0:
        return v[0];
    case 1:
        return v[0] + b[0] * (v[1] - v[0]);
    default:
        return b[0] * v[0] + b[1] * v[1] + b[2] * v[2];
    }
}

/// Random rays, and rays for the special cases: along axes (with zeros of either sign), in the faces
/// of boxes, in the planes of triangles, at corners and edges, and tangent to spheres; from all sides,
/// with and without a limit.
Ray some_ray(const scenes::Scene& scene, double scale, const Vec3& offset, Random& random)
{
    Ray ray;
    ray.origin = random.below(3) == 0 ? some_point(scene, random)
                                      : scale * (random.magnitude(-1, 1) * random.in_cube()) + offset;
    ray.direction = random.direction() * random.magnitude(-3, 3);
    switch (random.below(6)) {
    case 0:
        break;
    case 1:
        for (int axis = 0; axis < 3; ++axis)
            if (random.below(2) == 0) ray.direction[axis] = random.below(2) == 0 ? 0.0 : -0.0;
        break;
    case 2:
        ray.direction = some_point(scene, random) - ray.origin;
        break;
    case 3:
        ray.direction = some_point(scene, random) - some_point(scene, random);
        break;
    case 4: { // in the plane of a triangle, up to rounding
        const auto& v = scene.triangles[random.below(scene.triangles.size())].vertices;
        const Vec3 b = random.barycentric() * random.uniform(-2, 2);
        ray.origin = v[0] + b[1] * (v[1] - v[0]) + b[2] * (v[2] - v[0]);
        ray.direction = random.uniform(-1, 1) * (v[1] - v[0]) + random.uniform(-1, 1) * (v[2] - v[0]);
        break;
    }
    default: { // tangent to a sphere
        const scenes::Sphere& sphere = scene.spheres[random.below(scene.spheres.size())];
        const Vec3 n = random.direction();
        ray.direction = glm::cross(n, random.direction());
        ray.origin = sphere.center + sphere.radius * n - ray.direction * scale * random.magnitude(-3, 1);
        break;
    }
    }
    if (random.below(4) == 0) ray.t_max = random.magnitude(-3, 3);
    return ray;
}

struct Placement {
    double scale;
    Vec3 offset;
};

std::vector<Placement> placements()
{
    return {{1, Vec3(0)},
            {1e-15, Vec3(0)},
            {1e15, Vec3(0)},
            {1, Vec3(1e4, 3, -7e3)},
            {1e-15, Vec3(0, 1e-11, 3e-12)}};
}

TEST(Traverse,
     FindsWhatLinearSearchFinds) // 5 places x 10 scenes x 20,000 = 10^6 rays, for the builders in turn
{
    Random random(1);
    std::uint64_t hits = 0;
    for (const Placement& place : placements())
        for (int repeat = 0; repeat < 10; ++repeat) {
            const scenes::Scene scene = moved(crowded_scene(random), place.scale, place.offset);
            const std::vector<Geometry> geometries = {
                Geometry(scene, builders[0]), Geometry(scene, builders[1]), Geometry(scene, builders[2]),
                Geometry(scene, builders[3])};
            for (std::size_t i = 0; i < 20000; ++i) {
                const Ray ray = some_ray(scene, place.scale, place.offset, random);
                const std::optional<Hit> expected = trees_test::intersect_by_linear_search(scene, ray);
                const Geometry& geometry = geometries[i % geometries.size()];
                ASSERT_TRUE(same(intersect(geometry, ray), expected))
                    << "scale " << place.scale << " ray " << i;
                ASSERT_EQ(occluded(geometry, ray), expected.has_value())
                    << "scale " << place.scale << " ray " << i;
                hits += expected ? 1 : 0;
            }
        }
    EXPECT_GT(hits, 300000u);
}

// map: slabs
TEST(Slabs,
     AreEnteredBeforeAnythingInThemIsHit) // the condition that the padding must meet, for each primitive
{
    Random random(2);
    int hits = 0;
    for (const Placement& place : placements())
        for (int repeat = 0; repeat < 10; ++repeat) {
            const scenes::Scene scene = moved(crowded_scene(random), place.scale, place.offset);
            const std::vector<Aabb> boxes = ref::primitive_bounds(scene);
            for (int i = 0; i < 20000; ++i) {
                const Ray ray = some_ray(scene, place.scale, place.offset, random);
                const auto primitive = static_cast<std::uint32_t>(random.below(boxes.size()));
                const auto hit = intersect_primitive(scene, ray, ref::ShearedRay(ray), primitive);
                if (!hit) continue;
                ++hits;
                // The smallest possible root, and so the least padding: the primitive's own box.
                const double entry = ref::Slabs(ray, boxes[primitive]).entry(boxes[primitive]);
                ASSERT_LE(entry, hit->t) << "scale " << place.scale << " ray " << i;
            }
        }
    EXPECT_GT(hits, 10000);
}

TEST(Slabs, AreMissedByRaysThatPassAtADistance) // map: slabs
{
    const Aabb box{Vec3(1, 1, 1), Vec3(2, 3, 4)};
    const auto entry = [&](const Vec3& origin, const Vec3& direction) {
        return ref::Slabs({origin, direction}, box).entry(box);
    };
    const double none = std::numeric_limits<double>::infinity();
    EXPECT_EQ(entry(Vec3(0), Vec3(-1, -1, -1)), none);
    EXPECT_EQ(entry(Vec3(0, 2, 2), Vec3(0, 1, 0)), none);
    EXPECT_EQ(entry(Vec3(0, 2, 2), Vec3(-0.0, 1, 0)), none);
    EXPECT_EQ(entry(Vec3(0, 0, 2), Vec3(1, -1e-3, 0)), none);
    EXPECT_EQ(entry(Vec3(1.5, 2, 2), Vec3(1, 0, 0)), 0);             // inside
    EXPECT_NEAR(entry(Vec3(0, 2, 2), Vec3(0.5, 0, -0.0)), 2, 1e-13); // padding: 32 u m / 0.5, m = 4
}

TEST(Slabs, AreNotMissedWhereZeroTimesInfinityIsNoNumber)
{
    // Along y, exactly in the padded faces x = 0 - 2^-48 and x = 0.5 + 2^-48: 32 u m = 2^-48 for m = 1.
    const Aabb box{Vec3(0, 0, 0), Vec3(0.5, 1, 0.5)};
    for (const double x : {-0x1p-48, 0.5 + 0x1p-48})
        for (const double zero : {0.0, -0.0}) {
            const double entry = ref::Slabs({Vec3(x, 0, 0.25), Vec3(zero, 1, zero)}, box).entry(box);
            EXPECT_EQ(entry, 0);
        }
}

/// A chain: leaf 0 beside (leaf 1 beside (leaf 2 ...)), as deep as there are leaves.
Tree chain(std::span<const Aabb> boxes)
{
    Tree tree;
    const auto n = static_cast<std::uint32_t>(boxes.size());
    tree.nodes.resize(2 * n - 1);
    tree.bounds.resize(2 * n - 1);
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
        tree.nodes[i].children = {n - 1 + i, i + 2 < n ? i + 1 : 2 * n - 2};
        for (const std::uint32_t child : tree.nodes[i].children) tree.nodes[child].parent = i;
    }
    for (std::uint32_t i = 0; i <= n; ++i) tree.leaf_begin.push_back(i);
    for (std::uint32_t i = 0; i < n; ++i) tree.primitives.push_back(i);
    for (std::uint32_t i = n; i-- > 0;) tree.bounds[n - 1 + i] = boxes[i];
    for (std::uint32_t i = n - 1; i-- > 0;)
        tree.bounds[i] =
            unite(tree.bounds[tree.nodes[i].children[0]], tree.bounds[tree.nodes[i].children[1]]);
    return tree;
}

TEST(Traverse, GoesThroughATreeOfAnyDepth) // a fixed stack of 64 would overflow
{
    // Every box is inside the next. A ray from above enters the rest of the chain before the leaf,
    // which stays on the stack until all below it is done; a ray from below enters both at once.
    std::vector<Aabb> boxes;
    const int n = 100000;
    for (int i = 0; i < n; ++i) boxes.push_back({Vec3(0), Vec3((i + 1) * 1e-6)});
    const Tree tree = chain(boxes);
    for (const double side : {1.0, -1.0}) {
        int tested = 0;
        traverse(tree, {Vec3(side), -side * Vec3(1, 1, 1)}, [&](std::uint32_t) {
            ++tested;
            return std::numeric_limits<double>::infinity();
        });
        EXPECT_EQ(tested, n);
    }
}

TEST(Traverse, EntersTheNearerChildFirstAndNoBoxBeyondAHit) // map: traversal
{
    scenes::Scene scene = scene_of(trees_test::Mesh{});
    for (const double z : {1.0, 2.0})
        scene.triangles.push_back({{Vec3(-1, -1, z), Vec3(3, -1, z), Vec3(-1, 3, z)}, 0});
    for (const Builder builder : builders) {
        const Geometry geometry(scene, builder);
        for (const double from : {0.0, 3.0}) {
            ref::TraversalCounts counts;
            const auto hit = intersect(geometry, {Vec3(0, 0, from), Vec3(0, 0, 1.5 - from)}, &counts);
            ASSERT_TRUE(hit);
            EXPECT_EQ(hit->primitive, from < 1 ? 0u : 1u);
            if (geometry.tree().leaf_count() == 1) continue; // both in one leaf: only one visit
            EXPECT_EQ(counts.nodes, 2u);                     // the root and the nearer leaf
            EXPECT_EQ(counts.primitives, 1u);
        }
    }
}

TEST(Traverse, StopsWhenToldTo)
{
    const scenes::Scene scene = scene_of(trees_test::icosphere(3, 1));
    const Geometry geometry(scene);
    int tested = 0;
    traverse(geometry.tree(), {Vec3(0, 0, -5), Vec3(0, 0, 1)}, [&](std::uint32_t) {
        ++tested;
        return -1.0;
    });
    EXPECT_LE(tested, 8); // the other primitives of a leaf may follow
}

TEST(Traverse,
     VisitsFarFewerNodesThanThereAre) // if every box were the whole scene's, the hits would be the same
{
    const scenes::Scene scene = scene_of(trees_test::icosphere(5, 1)); // 20,480 triangles
    Random random(3);
    for (const Builder builder : builders) {
        const Geometry geometry(scene, builder);
        ref::TraversalCounts closest;
        ref::TraversalCounts any;
        const std::uint64_t rays = 1000;
        for (std::uint64_t i = 0; i < rays; ++i) {
            const Ray ray{3.0 * random.direction(), -random.direction()};
            intersect(geometry, ray, &closest);
            occluded(geometry, ray, &any);
        }
        EXPECT_LT(closest.nodes, 100 * rays); // about 4 log2 n
        EXPECT_LT(closest.primitives, 20 * rays);
        EXPECT_LE(any.nodes, closest.nodes);
        EXPECT_GT(any.nodes, 0u);
    }
}

TEST(Traverse, PrimitivesOfOneCodeCostNoMoreThanTheyMust)
{
    // Pairs with equal codes: if a builder put them into chains, the counts would show it.
    scenes::Scene scene = scene_of(trees_test::icosphere(4, 1));
    const std::vector<scenes::Triangle> once = scene.triangles;
    for (int copy = 1; copy < 8; ++copy)
        scene.triangles.insert(scene.triangles.end(), once.begin(), once.end());
    const scenes::Scene single = scene_of(trees_test::icosphere(4, 1));
    Random random(4);
    for (const Builder builder : {Builder::morton30, Builder::morton63}) {
        const Geometry one(single, builder);
        const Geometry eight(scene, builder);
        ref::TraversalCounts work_one;
        ref::TraversalCounts work_eight;
        for (int i = 0; i < 1000; ++i) {
            const Ray ray{3.0 * random.direction(), -random.direction()};
            intersect(one, ray, &work_one);
            intersect(eight, ray, &work_eight);
        }
        // Each leaf becomes a subtree of 15 nodes, all of which are entered.
        EXPECT_LE(work_eight.primitives, 8 * work_one.primitives);
        EXPECT_LE(work_eight.nodes, 15 * work_one.nodes);
    }
}

} // namespace
