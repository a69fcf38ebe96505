// Rays that leave surfaces without an epsilon, in single precision.

#include "cuda/trees/clearance.h"

#include "cuda/trees/surfaces.h"
#include "tests/cuda/trees/float_limits.h"
#include "tests/cuda/trees/triangles.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <optional>

namespace {

using fast::Hit;
using fast::Ray;
using fast::Sphere;
using fast::SurfaceTree;
using fast::Triangle;
using fast::Vec3;
using fast_trees_test::infinity;
using fast_trees_test::u;
using trees_test::Random;

/// Surfaces, their tree, and points on them.
struct World {
    World(std::vector<Triangle> given_triangles, std::vector<Sphere> given_spheres)
        : triangles(std::move(given_triangles)), spheres(std::move(given_spheres)),
          tree(memory, executor, triangles, spheres)
    {}
    fast::HostMemory memory;
    fast::SerialExecutor executor;
    std::vector<Triangle> triangles;
    std::vector<Sphere> spheres;
    SurfaceTree tree;
};

struct Point {
    Vec3 position, normal;
    float clearance;
};

Point on_triangle(const World& world, std::size_t triangle, float b1, float b2)
{
    const auto& v = world.triangles[triangle].vertices;
    const Vec3 e1 = v[1] - v[0];
    const Vec3 e2 = v[2] - v[0];
    fast::move_off_edges(fast::edge_margin(v[0], e1, e2), b1, b2);
    const Vec3 position = v[0] + (b1 * e1 + b2 * e2);
    const Vec3 normal = glm::normalize(glm::cross(e1, e2));
    return {position, normal,
            fast::clearance_at(position, normal,
                               fast::triangle_clearance(normal, e1, e2, fast::triangle_extent(e1, e2)))};
}

Point on_sphere(const World& world, std::size_t sphere, const Vec3& direction)
{
    const auto& [center, radius] = world.spheres[sphere];
    const Vec3 normal = glm::normalize(direction);
    const Vec3 position = center + radius * normal;
    return {position, normal, fast::clearance_at(position, normal, fast::sphere_clearance(radius))};
}

Point at(const World& world, const Ray& ray, const Hit& hit)
{
    if (hit.primitive < world.triangles.size()) return on_triangle(world, hit.primitive, hit.b1, hit.b2);
    const std::size_t sphere = hit.primitive - world.triangles.size();
    return on_sphere(world, sphere, ray.origin + hit.t * ray.direction - world.spheres[sphere].center);
}

Vec3 leave(const Point& point, const Vec3& direction)
{
    return fast::leave_surface(point.position, point.normal, point.clearance, direction);
}

/// The end of a segment that comes to `point` from `back`.
Vec3 end_at(const Point& point, const Vec3& back)
{
    const float clearance = point.clearance + fast::clearance_per_length * glm::length(back);
    return fast::leave_surface(point.position, point.normal, clearance, back);
}

/// The point where a ray hits the surface.
std::optional<Point> find_point(const World& world, const trees_test::Vec3& target, double size,
                                Random& random)
{
    const trees_test::Vec3 origin = target + size * random.magnitude(-2, 2) * random.direction();
    const Ray ray{Vec3(origin), infinity, Vec3((target - origin) * random.magnitude(-2, 2))};
    const Hit hit = intersect(world.tree.view<true>(), ray);
    if (hit.primitive == fast::no_primitive) return std::nullopt;
    return at(world, ray, hit);
}

/// A unit vector at right angles to `n`.
trees_test::Vec3 tangent_to(const trees_test::Vec3& n, Random& random)
{
    for (;;) {
        const trees_test::Vec3 v = glm::cross(n, random.direction());
        const double length = glm::length(v);
        if (length > 0.1) return v / length;
    }
}

/// A direction of any length, to either side of `n`, whose cosine to n is at least `least`.
Vec3 away_from(const Vec3& n, double least, Random& random)
{
    const double cosine = random.magnitude(std::log10(least), 0);
    const double side = random.below(2) == 0 ? 1 : -1;
    return Vec3(
        (side * cosine * trees_test::Vec3(n) + std::sqrt(1 - cosine * cosine) * tangent_to(n, random)) *
        random.magnitude(-3, 3));
}

/// A triangle of longest edge about `size` and smallest height about `size` / `aspect`.
std::array<trees_test::Vec3, 3> sliver_of(double size, double aspect, Random& random)
{
    const trees_test::Vec3 along = random.direction();
    const trees_test::Vec3 across = tangent_to(along, random);
    const trees_test::Vec3 where = random.in_cube();
    return {size * where, size * (where + along),
            size * (where + random.uniform() * along + across / aspect)};
}

Triangle shifted(const std::array<trees_test::Vec3, 3>& v, const trees_test::Vec3& by)
{
    return {{Vec3(v[0] + by), Vec3(v[1] + by), Vec3(v[2] + by)}};
}

struct Setting {
    double size, offset, aspect;
};

// The normal has an error of about 4 u times the aspect ratio, as an angle. For directions closer to
// the surface the side is unknown. So is the shape of a triangle that is thinner than the distance of
// neighbouring floats at its place.
std::vector<Setting> settings()
{
    std::vector<Setting> all;
    for (const double size : {1e-3, 1.0, 1e3})
        for (const double offset : {0.0, 1.0, 1e2, 1e4})
            for (const double aspect : {1.0, 1e2, 1e4})
                if (offset * aspect <= 1e6) all.push_back({size, offset * size, aspect});
    return all;
}

/// The ratio of longest edge to smallest height, after rounding.
double aspect_of(const Triangle& triangle)
{
    const auto& v = triangle.vertices;
    const trees_test::Vec3 a(v[1] - v[0]);
    const trees_test::Vec3 b(v[2] - v[0]);
    const trees_test::Vec3 c(v[2] - v[1]);
    const double longest = std::max({glm::length(a), glm::length(b), glm::length(c)});
    return longest * longest / glm::length(glm::cross(a, b));
}

RC_GTEST_PROP(LeaveSurfaceInFloat, ARayFromATriangleMeetsNeitherItNorItsDuplicate, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    for (const Setting& s : settings()) {
        int found = 0;
        for (int i = 0; i < 20; ++i) {
            const auto v = sliver_of(s.size, s.aspect, random);
            const trees_test::Vec3 by = s.offset * random.direction();
            const Triangle t = shifted(v, by);
            const World world({t,
                               {{t.vertices[1], t.vertices[2], t.vertices[0]}},
                               {{t.vertices[2], t.vertices[1], t.vertices[0]}}},
                              {});
            const double least = 16 * u * aspect_of(t);
            if (!(least < 0.5)) continue;
            const trees_test::Vec3 b = random.barycentric();
            const auto point =
                find_point(world, b[0] * v[0] + b[1] * v[1] + b[2] * v[2] + by, s.size, random);
            if (!point) continue; // the target is rounded: slivers can be missed
            ++found;
            const Vec3 d = away_from(point->normal, least, random);
            RC_ASSERT(!occluded(world.tree.view<false>(), {leave(*point, d), infinity, d}));
        }
        RC_ASSERT(found > 10 || s.aspect * std::max(s.offset / s.size, 1.0) > 1e3);
    }
}

TEST(LeaveSurfaceInFloat, MovesAPointByNoMoreThanItsErrorBound)
{
    Random random(3);
    for (const Setting& s : settings()) {
        const World world({shifted(sliver_of(s.size, s.aspect, random), s.offset * random.direction())},
                          {});
        const trees_test::Vec3 b = random.barycentric();
        const Point point = on_triangle(world, 0, static_cast<float>(b[1]), static_cast<float>(b[2]));
        // The bound: |n|_1 <= sqrt(3) times the largest of 4 u e + 2 u |p| + 8 u a, where e and a
        // are at most D; and the rounding of this.
        const double far = s.offset + 3 * s.size;
        const double largest = u * (12 * world.tree.diagonal() + 2 * far);
        const double moved =
            glm::length(trees_test::Vec3(leave(point, point.normal)) - trees_test::Vec3(point.position));
        EXPECT_LE(moved, std::sqrt(3.0) * largest + 2 * u * far);
        EXPECT_GT(moved, 0);
    }
}

// A neighbour in the same plane, up to 1e6 times larger, beyond an edge close to the start of the ray.
TEST(LeaveSurfaceInFloat, ARayMeetsNoLargerNeighbourInThePlane)
{
    Random random(8);
    for (const double larger : {1.0, 1e2, 1e4, 1e6})
        for (const double offset : {0.0, 1.0, 1e2}) {
            int met = 0;
            for (int i = 0; i < 20000; ++i) {
                const trees_test::Vec3 x = random.direction();
                const trees_test::Vec3 y = tangent_to(x, random);
                const trees_test::Vec3 a = offset * random.direction();
                const trees_test::Vec3 inside =
                    a + random.uniform(0.2, 0.8) * x + random.uniform(0.5, 2) * y;
                const trees_test::Vec3 outside = a + larger * (random.uniform(-1, 1) * x - y);
                const World world(
                    {{{Vec3(a), Vec3(a + x), Vec3(inside)}}, {{Vec3(a + x), Vec3(a), Vec3(outside)}}},
                    {});
                const double near = random.magnitude(-9, -1);
                const double along = random.uniform(0, 1 - near);
                const Point point =
                    on_triangle(world, 0, static_cast<float>(along), static_cast<float>(near));
                // The corners are rounded: the planes differ by that angle.
                const double least = 64 * u * (1 + offset);
                const Vec3 d = away_from(point.normal, least, random);
                met += occluded(world.tree.view<false>(), {leave(point, d), infinity, d}) ? 1 : 0;
            }
            EXPECT_EQ(met, 0) << "larger by " << larger << " offset " << offset;
        }
}

TEST(LeaveSurfaceInFloat, DoesNotDependOnHowLargeTheRestOfTheSceneIs)
{
    // A height of 1e-5 above a triangle of size 1, for any size of the ground: no clearance is as
    // large.
    for (const float ground : {1.0f, 1e3f, 1e6f}) {
        const World world({{{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}},
                           {{Vec3(0, 0, 1e-5f), Vec3(1, 0, 1e-5f), Vec3(0, 1, 1e-5f)}},
                           {{Vec3(0, 0, -ground), Vec3(ground, 0, -ground), Vec3(0, ground, -ground)}}},
                          {});
        const Point point = on_triangle(world, 0, 0.3f, 0.3f);
        const Vec3 up(0.1f, 0.2f, 1.0f);
        EXPECT_EQ(intersect(world.tree.view<false>(), {leave(point, up), infinity, up}).primitive, 1u);
    }
}

struct Globe {
    double radius, distance;
};

/// Up to 1e4 radii away, at scales from 1e-3 to 1e3.
std::vector<Globe> globes()
{
    std::vector<Globe> all;
    for (const double radius : {1e-3, 1.0, 1e3})
        for (const double distance : {0.0, 1.0, 1e2, 1e4}) all.push_back({radius, distance * radius});
    return all;
}

RC_GTEST_PROP(LeaveSurfaceInFloat, ARayOutOfASphereDoesNotMeetItAndOneIntoItMeetsTheFarSide, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    for (const Globe& globe : globes())
        for (int i = 0; i < 40; ++i) {
            const Sphere sphere{Vec3(globe.distance * random.direction()),
                                static_cast<float>(globe.radius)};
            const World world({}, {sphere, sphere});
            const trees_test::Vec3 target = trees_test::Vec3(sphere.center) +
                                            globe.radius * random.magnitude(-4, 0) * random.direction();
            const auto point = find_point(world, target, globe.radius, random);
            if (!point) {
                RC_ASSERT(globe.distance >= 1e4 * globe.radius); // beyond that the target is rounded
                continue;
            }
            const Vec3 d = away_from(point->normal, 1e-6, random);
            const Hit hit = intersect(world.tree.view<true>(), {leave(*point, d), infinity, d});
            // leave_surface uses the sign of this cosine.
            const double side = glm::dot(d, point->normal);
            const double speed = glm::length(trees_test::Vec3(d));
            const double cosine = glm::dot(trees_test::Vec3(d), trees_test::Vec3(point->normal)) / speed;
            if (side >= 0) {
                RC_ASSERT(hit.primitive == fast::no_primitive);
            } else {
                // The chord is 2 r |cos|, and not shorter from a point inside. A hit at less than half
                // of it is on the surface that was left.
                RC_ASSERT(hit.primitive == 0u);
                RC_ASSERT(hit.t * speed >= globe.radius * -cosine);
            }
        }
}

bool sees(const World& world, const Point& p, const Point& q)
{
    const Vec3 d = q.position - p.position;
    const Vec3 from = leave(p, d);
    const Vec3 to = end_at(q, -d);
    return !occluded(world.tree.view<true>(), {from, 1.0f, to - from});
}

double cosine_at(const Point& p, const Point& to)
{
    const trees_test::Vec3 d = trees_test::Vec3(to.position) - trees_test::Vec3(p.position);
    return glm::dot(trees_test::Vec3(p.normal), d) / glm::length(d);
}

/// The side of a segment is known up to the error of the normal and that of the segment itself, whose
/// ends have been moved. If both ends coincide, it is unknown (NaN).
double least_cosine_of(const Point& p, const Point& q, double aspect)
{
    const double length = glm::length(trees_test::Vec3(q.position) - trees_test::Vec3(p.position));
    const double moved = p.clearance + q.clearance + fast::clearance_per_length * length;
    return 16 * u * aspect + 2 * std::sqrt(3.0) * moved / length;
}

RC_GTEST_PROP(SegmentsInFloat, AreNotBlockedByTheTrianglesTheyEndOn, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    for (const Setting& s : settings())
        for (int i = 0; i < 20; ++i) {
            // The second triangle is far smaller or larger, and often nearly in the plane of the
            // first.
            const auto v = sliver_of(s.size, s.aspect, random);
            const auto w = sliver_of(s.size * random.magnitude(-3, 3), s.aspect, random);
            const trees_test::Vec3 by = s.offset * random.direction();
            const trees_test::Vec3 normal = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
            const trees_test::Vec3 shift =
                s.size * random.magnitude(-2, 2) *
                (tangent_to(normal, random) + random.magnitude(-6, 0) * normal);
            const Triangle a = shifted(v, by);
            const Triangle b = shifted(w, v[0] - w[0] + by + shift);
            const double aspect = std::max(aspect_of(a), aspect_of(b));
            if (!(aspect < 1e6)) continue;
            const World world({a,
                               b,
                               {{a.vertices[1], a.vertices[0], a.vertices[2]}},
                               {{b.vertices[2], b.vertices[0], b.vertices[1]}}},
                              {});
            const auto sampled = [&](std::size_t triangle) {
                const trees_test::Vec3 weights = random.barycentric();
                return on_triangle(world, triangle, static_cast<float>(weights[1]),
                                   static_cast<float>(weights[2]));
            };
            const Point p = sampled(0);
            const Point q = sampled(1);
            const double least = least_cosine_of(p, q, aspect);
            if (!(std::min(std::abs(cosine_at(p, q)), std::abs(cosine_at(q, p))) >= least)) continue;
            RC_ASSERT(sees(world, p, q));
        }
}

RC_GTEST_PROP(SegmentsInFloat, AreNotBlockedByTheSpheresTheyEndOn, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    for (const Globe& globe : globes())
        for (int i = 0; i < 40; ++i) {
            const Sphere a{Vec3(globe.distance * random.direction()), static_cast<float>(globe.radius)};
            const double other = globe.radius * random.magnitude(-3, 3);
            const double apart = (globe.radius + other) * (1 + random.magnitude(-4, 3));
            const trees_test::Vec3 towards = random.direction();
            const Sphere b{Vec3(trees_test::Vec3(a.center) + apart * towards),
                           static_cast<float>(other)};
            const World world({}, {a, b, a, b});
            // Points that face each other, often only just.
            const auto facing = [&](double side) {
                return Vec3(side * towards + random.magnitude(-3, 3) * tangent_to(towards, random));
            };
            const Point p = on_sphere(world, 0, facing(1));
            const Point q = on_sphere(world, 1, facing(-1));
            const double least = least_cosine_of(p, q, 1);
            if (!(std::min(cosine_at(p, q), cosine_at(q, p)) >= least)) continue;
            RC_ASSERT(sees(world, p, q));
        }
}

TEST(SegmentsInFloat, AreBlockedByWhatStandsBetweenHoweverCloseToAnEnd) // no shadow ray is too short
{
    for (const float scale : {1e-3f, 1.0f, 1e3f})
        for (const float height : {1e-4f, 0.05f, 0.5f, 0.95f, 1 - 1e-4f}) {
            const auto square = [&](float z) {
                return Triangle{
                    {Vec3(-1, -1, z) * scale, Vec3(1, -1, z) * scale, Vec3(0, 1, z) * scale}};
            };
            const auto seen = [&](const World& world) {
                return sees(world, on_triangle(world, 0, 0.3f, 0.3f), on_triangle(world, 1, 0.3f, 0.3f));
            };
            EXPECT_TRUE(seen(World({square(0), square(1)}, {})));
            EXPECT_FALSE(seen(World({square(0), square(1), square(height)}, {})))
                << "scale " << scale << " height " << height;
        }
}

TEST(LeaveSurfaceInFloat, AWalkThatStaysInsideABoxNeverLeavesIt)
{
    Random random(6);
    for (const double scale : {1e-3, 1.0, 1e3})
        for (const double offset : {0.0, 1e2}) {
            const trees_test::Vec3 by = scale * offset * trees_test::Vec3(1, -0.3, 0.7);
            const trees_test::Mesh mesh = moved(trees_test::tessellated_box(2, 3), scale, by);
            const World world(fast_trees_test::triangles_of(mesh),
                              {{Vec3(mesh.inside), static_cast<float>(0.4 * scale)}});
            Ray ray{Vec3(mesh.inside + scale * trees_test::Vec3(0.7)), infinity,
                    Vec3(random.direction())};
            for (int i = 0; i < 100'000; ++i) {
                const Hit hit = intersect(world.tree.view<true>(), ray);
                ASSERT_NE(hit.primitive, fast::no_primitive) << "bounce " << i;
                const Point point = at(world, ray, hit);
                Vec3 d(random.direction());
                if ((glm::dot(d, point.normal) < 0) == (glm::dot(ray.direction, point.normal) < 0))
                    d = -d;
                ray = {leave(point, d), infinity, d};
            }
        }
}

// A point in an edge may be rounded to the far side of the second wall. `shear`: the tangent of the
// angle by which walls are tilted; 1 for 45 degrees.
void expect_no_way_out_of_edges(double shear, double scale, double offset, std::uint64_t seed)
{
    Random random(seed);
    for (int box = 0; box < 20; ++box) {
        trees_test::Mesh mesh = trees_test::tessellated_box(1, 1);
        const trees_test::Vec3 x = random.direction();
        const trees_test::Vec3 y = tangent_to(x, random);
        const trees_test::Vec3 z = glm::cross(x, y);
        const trees_test::Vec3 by = scale * offset * random.direction();
        for (trees_test::Vec3& v : mesh.vertices)
            v = by + scale * ((v.x + shear * v.y) * x + v.y * y + v.z * z);
        const World world(fast_trees_test::triangles_of(mesh), {});
        for (int i = 0; i < 5'000; ++i) {
            const auto& triangle = mesh.triangles[random.below(mesh.triangles.size())];
            const std::size_t first = random.below(3);
            const trees_test::Vec3& a = mesh.vertices[triangle[first]];
            const trees_test::Vec3& b = mesh.vertices[triangle[(first + 1) % 3]];
            const trees_test::Vec3& c = mesh.vertices[triangle[(first + 2) % 3]];
            const trees_test::Vec3 target =
                glm::mix(a, b, random.uniform()) + random.magnitude(-9, -5) * (c - a);
            const Ray ray{Vec3(by), infinity, Vec3(target - by)};
            const Hit hit = intersect(world.tree.view<false>(), ray);
            ASSERT_NE(hit.primitive, fast::no_primitive);
            const Point point = at(world, ray, hit);
            Vec3 d(random.direction());
            if (glm::dot(d, point.normal) * glm::dot(Vec3(by) - point.position, point.normal) < 0)
                d = -d;
            ASSERT_NE(intersect(world.tree.view<false>(), {leave(point, d), infinity, d}).primitive,
                      fast::no_primitive)
                << "box " << box << ", ray " << i;
        }
    }
}

TEST(LeaveSurfaceInFloat, InTheEdgeOfTwoWallsNoRayLeavesTheRoom)
{
    for (const double scale : {1e-3, 1.0, 1e3})
        for (const double offset : {0.0, 1.0, 1e2}) {
            SCOPED_TRACE(testing::Message() << "scale " << scale << ", offset " << offset);
            expect_no_way_out_of_edges(0, scale, offset, 1);
            expect_no_way_out_of_edges(1, scale, offset, 2);
        }
}

} // namespace
