// Ends of paths that are not on surfaces: the eye, point lights and spot lights. The path judge starts
// from the fast path's own vertices, so it cannot detect a wrong position of these ends. Therefore
// their positions are tested here, against the scene in double precision: rays must start on the right
// side of every surface that the end lies on, or near.

#include "cuda/scene/scene_arrays.h"
#include "cuda/transport/contacts.h"
#include "cuda/trees/clearance.h"
#include "scenes/contacts.h"
#include "tests/cuda/transport/touching_scenes.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using fast_transport_test::Touching;
using scenes::Vec3;

Vec3 origin_of(const fast::SceneArrays& arrays, const fast::Vec3& position,
               const fast::EndContacts& contacts, const fast::Vec3& direction, float length)
{
    fast::SceneView<fast::any_needs> view{};
    view.contact_planes = arrays.contact_planes;
    return Vec3(fast::leave_end(view, position, contacts, direction, length));
}

/// The distance of `p` from the triangle's plane in float, along its normal.
double height_over(const fast::Triangle& triangle, const Vec3& p)
{
    const Vec3 a(triangle.vertices[0]);
    const Vec3 normal =
        glm::normalize(glm::cross(Vec3(triangle.vertices[1]) - a, Vec3(triangle.vertices[2]) - a));
    return glm::dot(p - a, normal);
}

Vec3 any_direction()
{
    const auto any = [] { return *rc::gen::inRange(-1000, 1001) / 1000.0; };
    const Vec3 w(any(), any(), any());
    return glm::length(w) > 0.1 ? glm::normalize(w) : Vec3(0.6, 0, 0.8);
}

/// Checks the origin of a ray from an end at `exact` (in the scene's own coordinates).
void check_end(const scenes::Scene& scene, const fast::SceneArrays& arrays, const Vec3& exact,
               const fast::Vec3& position, const fast::EndContacts& contacts)
{
    const fast::Vec3 direction(any_direction());
    // For a ray that leaves, or for a segment of any length that arrives.
    const double length =
        static_cast<double>(arrays.diagonal) * std::max(0, *rc::gen::inRange(-5, 11)) / 10;
    const Vec3 origin = origin_of(arrays, position, contacts, direction, static_cast<float>(length));
    const double near = 1e-3 / arrays.place.scale;
    int looked_at = 0;
    for (const scenes::NearSurface& surface : scenes::surfaces_near(scene, exact, near)) {
        if (surface.primitive >= arrays.triangles.size()) continue;
        const double height = height_over(arrays.triangles[surface.primitive], origin);
        const int side = surface.side != 0                               ? surface.side
                         : glm::dot(Vec3(direction), surface.normal) < 0 ? -1
                                                                         : 1;
        // The error of a ray or segment (clearance.h, steps 3 and 4): a plane closer than that could
        // be hit by rounding.
        const auto& v = arrays.triangles[surface.primitive].vertices;
        const Vec3 a(fast::triangle_extent(v[1] - v[0], v[2] - v[0]));
        const Vec3 n = glm::abs(surface.normal);
        const double uncertain =
            2 * glm::dot(n, a) + 5 * std::max({a.x, a.y, a.z}) * (n.x + n.y + n.z) + 11.7 * length;
        RC_ASSERT(side * height > 0x1p-24 * uncertain);
        ++looked_at;
    }
    RC_CLASSIFY(looked_at > 0, "near a triangle");
    // And the origin hardly moves: three planes at right angles move it by at most sqrt(3) clearances,
    // each of 14 u D for the ray, 3 u D for the rounded coordinates, and 24 u per unit of length.
    RC_ASSERT(glm::length(origin - (exact - arrays.place.origin) * arrays.place.scale) <
              std::sqrt(3.0) * 0x1p-24 * (18 * arrays.diagonal + 24.1 * length));
}

RC_GTEST_PROP(EndsOfPaths, BeginTheirRaysOnTheirSideOfEverySurface, ())
{
    const auto kind = *rc::gen::element(Touching::point_light_on_lamp, Touching::point_light_on_wall,
                                        Touching::point_light_in_corner, Touching::spot_light_on_wall,
                                        Touching::eye_on_wall, Touching::eye_in_edge);
    // 0, or a distance from far below the rounding of floats to far above it.
    const double gap =
        *rc::gen::inRange(0, 4) == 0 ? 0 : std::pow(10, -0.1 * *rc::gen::inRange(30, 120));
    scenes::Scene scene =
        fast_transport_test::touching_scene(kind, *rc::gen::inRange<std::uint32_t>(0, 1u << 30), gap);
    // Another light before it: each light must have its own contacts.
    if (*rc::gen::arbitrary<bool>())
        scene.point_lights.insert(scene.point_lights.begin(),
                                  {0.5 * scene.camera->eye, scenes::Rgb(1.0)});
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    check_end(scene, arrays, scene.camera->eye, arrays.place(scene.camera->eye), arrays.eye_contacts);
    for (std::size_t i = 0; i < arrays.emitters.size(); ++i) {
        const fast::Emitter& emitter = arrays.emitters[i];
        const fast::Light& light = arrays.lights[i];
        if (emitter.kind == fast::EmitterKind::point)
            check_end(scene, arrays, scene.point_lights[emitter.index].position, light.position,
                      light.contacts);
        if (emitter.kind == fast::EmitterKind::spot)
            check_end(scene, arrays, scene.spot_lights[emitter.index].position, light.position,
                      light.contacts);
    }
}

// An end near a surface whose distance suffices for a ray: only a long segment needs more.
TEST(EndsOfPaths, AreNotMovedTowardsASurface)
{
    fast::SceneArrays arrays;
    arrays.contact_planes = {{fast::Vec3(0.0f), fast::Vec3(0, 0, 1), -fast::clearance_per_length}};
    const fast::EndContacts contacts{0, 1, 0, 0};
    const auto height = [&](float length) {
        return origin_of(arrays, fast::Vec3(0.0f), contacts, fast::Vec3(0, 0.6f, 0.8f), length).z;
    };
    EXPECT_EQ(height(0.0f), 0.0);
    EXPECT_EQ(height(0.5f), 0.0);
    EXPECT_EQ(height(3.0f), 2.0 * static_cast<double>(fast::clearance_per_length));
}

/// A scene with a material for triangles, and nothing else.
scenes::Scene empty_scene()
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{scenes::Rgb(0.5)}};
    scene.material_names = {"wall"};
    return scene;
}

TEST(EndsOfPaths, InAnObliqueEdgeAreMovedFromOneWallParallelToTheOthers)
{
    for (const double angle : {0.2, 1.0, 2.5}) {
        scenes::Scene scene = empty_scene();
        const Vec3 along(1, 0, 0);
        const Vec3 up(0, std::sin(angle), std::cos(angle));
        scene.triangles = {{{-along, along, Vec3(0, 0, 1)}, 0},
                           {{-along, along, up}, 0},
                           {{Vec3(0.0), Vec3(0.5, 1, 0), Vec3(0.3, 0, 1)}, 0}};
        scene.point_lights = {{Vec3(0.0), scenes::Rgb(1.0)}};
        const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
        ASSERT_EQ(arrays.contact_planes.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t j = 0; j < 3; ++j)
                EXPECT_NEAR(glm::dot(arrays.contact_planes[i].push, arrays.contact_planes[j].normal),
                            i == j ? 1 : 0, 1e-5)
                    << "angle " << angle << ", planes " << i << ", " << j;
    }
}

// Of two planes that are nearly the same, that on which the end lies: the light passes it on both
// sides.
TEST(EndsOfPaths, AreOnASurfaceRatherThanNearAnother)
{
    for (const double height : {-1e-8, 1e-8}) {
        scenes::Scene scene = empty_scene();
        const Vec3 a(-1, -1, 0);
        const Vec3 b(1, -1, 0);
        const Vec3 c(0, 1, 0);
        const Vec3 by(0, 0, height);
        scene.triangles = {{{a + by, b + by, c + by}, 0}, {{a, b, c}, 0}};
        scene.point_lights = {{Vec3(0.0), scenes::Rgb(1.0)}};
        const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
        ASSERT_EQ(arrays.contact_planes.size(), 1u);
        EXPECT_EQ(arrays.contact_planes[0].normal, fast::Vec3(0, 0, 1)) << height;
    }
}

TEST(EndsOfPaths, OfAnOrdinarySceneTouchNothing)
{
    scenes::Scene scene = fast_transport_test::touching_scene(Touching::point_light_on_wall, 1, 0.01);
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    EXPECT_TRUE(arrays.contact_planes.empty());
    EXPECT_TRUE(arrays.contact_triangles.empty());
    EXPECT_TRUE(arrays.coincident.empty());
}

// Floats cannot tell whether a lamp is 1e-9 in front of its wall or behind it; doubles can.
TEST(CoincidentSurfaces, KeepTheOrderThatOnlyDoublesResolve)
{
    for (const double gap : {1e-9, -1e-9, 0.0}) {
        const scenes::Scene scene = fast_transport_test::touching_scene(Touching::lamp_in_wall, 2, gap);
        const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
        // The lamp's triangles are the last; the wall that they coincide with faces the same way.
        const fast::SurfaceContacts& lamp = arrays.surface_contacts[arrays.surfaces.back().contacts];
        ASSERT_GT(lamp.coincident_count, 0u);
        for (std::uint32_t i = 0; i < lamp.coincident_count; ++i)
            EXPECT_EQ(arrays.coincident[lamp.first_coincident + i].side, gap == 0  ? 0
                                                                         : gap > 0 ? -1
                                                                                   : 1)
                << gap;
    }
    const scenes::Scene apart = fast_transport_test::touching_scene(Touching::lamp_in_wall, 2, 1e-4);
    EXPECT_TRUE(fast::scene_arrays(apart, true).coincident.empty());
}

TEST(CoincidentSurfaces, KeepTheOrderOfSpheres)
{
    scenes::Scene scene = empty_scene();
    scene.spheres = {{Vec3(0.0), 1, 0}, {Vec3(0.0), 1 + 1e-9, 0}};
    const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
    ASSERT_EQ(arrays.coincident.size(), 2u);
    EXPECT_EQ(arrays.coincident[0].primitive, 1u);
    EXPECT_EQ(arrays.coincident[0].side, 1); // the larger one is outside the smaller one
    EXPECT_EQ(arrays.coincident[1].primitive, 0u);
    EXPECT_EQ(arrays.coincident[1].side, -1);
}

// Coincident surfaces may be as small as the distance up to which surfaces count as near.
TEST(CoincidentSurfaces, AreFoundHoweverSmall)
{
    for (const double size : {1.0, 1e-2, 1e-4, 1e-5}) {
        scenes::Scene scene = empty_scene();
        const Vec3 at(0.3, 0.2, 0.4);
        const scenes::Triangle small{{at, at + Vec3(size, 0, 0), at + Vec3(0, size, 0)}, 0};
        scene.triangles = {{{Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0)}, 0}, small, small};
        const fast::SceneArrays arrays = fast::scene_arrays(scene, true);
        for (const std::size_t i : {1, 2})
            EXPECT_EQ(arrays.surface_contacts[arrays.surfaces[i].contacts].coincident_count, 1u) << size;
    }
}

} // namespace
