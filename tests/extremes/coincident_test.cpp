// Two surfaces at a gap of 0: which one a ray sees is decided by rule (scenes/contacts.h), in both
// wings.

#include "cuda/launch/ray_pairs.h"
#include "extremes/leave/shapes.h"
#include "ref/trees/geometry.h"
#include "scenes/placed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace extremes {

namespace {

const scenes::Material diffuse = scenes::Lambertian{scenes::Rgb(0.5)};
const scenes::Material glass = scenes::Glass{scenes::Rgb(1.0), scenes::Rgb(1.0), 1.5};
const scenes::Material lamp = scenes::Emission{scenes::Rgb(1.0)};

/// The number (0 or 1) of the one of two coincident triangles that each wing sees, from the side that
/// their normals point to or from the other. -1 if the wings differ, or nothing is seen.
int seen(const scenes::Material& first, const scenes::Material& second, bool from_front, Random& random)
{
    scenes::Scene scene;
    scene.name = "coincident";
    scene.materials = {first, second};
    scene.material_names = {"first", "second"};
    const Turn turn = random_turn(random);
    const std::array<scenes::Vec3, 3> v = {turn(scenes::Vec3(1, 0, 0.3)),
                                           turn(scenes::Vec3(-0.5, 0.8, 0.3)),
                                           turn(scenes::Vec3(-0.5, -0.8, 0.3))};
    // The same plane, corners in another order: rounding differs.
    scene.triangles = {{v, 0}, {{v[1], v[2], v[0]}, 1}};
    scene.triangles.push_back(
        {{turn(scenes::Vec3(1, 0, 5)), turn(scenes::Vec3(0, 1, 5)), turn(scenes::Vec3(-1, 0, 5))},
         0}); // so that the scene has an extent along its third axis
    scene.camera = scenes::Camera{turn(scenes::Vec3(0.1, 0.05, from_front ? 1.5 : -1.5)),
                                  turn.x,
                                  turn.y,
                                  turn.z,
                                  scenes::FovAxis::horizontal,
                                  1.0};
    const scenes::Vec3 target =
        turn(scenes::Vec3(random.between(-0.2, 0.2), random.between(-0.2, 0.2), 0.3));
    const scenes::Vec3 direction = direction_between(scene.camera->eye, target);
    const scenes::Scene placed = scenes::placed(scene);

    const ref::Geometry geometry(placed, ref::Builder::sah_leaf, scenes::coincidences(placed));
    const auto hit = ref::intersect(geometry, {placed.camera->eye, direction});
    const fast::SceneArrays arrays = fast::scene_arrays(placed, true);
    const fast::RayPair pair{{arrays.place(placed.camera->eye), std::numeric_limits<float>::infinity(),
                              fast::Vec3(direction)},
                             fast::Vec3(direction)};
    const auto fast_hit = fast::trace_ray_pairs(arrays, std::vector{pair}).at(0).first;
    if (!hit || hit->primitive != fast_hit.primitive) return -1;
    return static_cast<int>(hit->primitive);
}

/// What is seen in 200 random orientations; -1 if it is not always the same.
int always_seen(const scenes::Material& first, const scenes::Material& second, bool from_front)
{
    Random random(1);
    const int one = seen(first, second, from_front, random);
    for (int i = 0; i < 200; ++i)
        if (seen(first, second, from_front, random) != one) return -1;
    return one;
}

} // namespace

TEST(CoincidentSurfaces, TheRuleDecidesInAnyOrderOfTheFile)
{
    for (const bool front : {true, false}) {
        EXPECT_EQ(always_seen(diffuse, glass, front), 0);
        EXPECT_EQ(always_seen(glass, diffuse, front), 1);
        EXPECT_EQ(always_seen(diffuse, diffuse, front), 0); // of the same kind, the first in the file
        EXPECT_EQ(always_seen(glass, glass, front), 0);
    }
    // An emitter from its emitting side is before all others, and from its back behind all.
    EXPECT_EQ(always_seen(diffuse, lamp, true), 1);
    EXPECT_EQ(always_seen(lamp, diffuse, true), 0);
    EXPECT_EQ(always_seen(diffuse, lamp, false), 0);
    EXPECT_EQ(always_seen(lamp, glass, false), 1);
}

} // namespace extremes
