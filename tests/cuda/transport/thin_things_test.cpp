// Surfaces closer together than 2^-20 of the scene, on the fast path: the clearance depends on the
// surface that a ray leaves, not on the size of the scene. Compared with the reference, from the same
// random numbers.

#include "cuda/launch/renderer.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/cuda/transport/batch_means.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using scenes::Rgb;
using scenes::Vec3;

void add_quad(scenes::Scene& scene, const Vec3& p, const Vec3& a, const Vec3& b, std::uint32_t material)
{
    scene.triangles.push_back({{p, p + a, p + a + b}, material});
    scene.triangles.push_back({{p, p + a + b, p + b}, material});
}

/// The unit cube as an affine map: p + [0, 1] a + [0, 1] b + [0, 1] c, facing outwards if a, b, c are
/// right-handed.
void add_box(scenes::Scene& scene, const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c,
             std::uint32_t material)
{
    add_quad(scene, p, b, a, material);
    add_quad(scene, p + c, a, b, material);
    add_quad(scene, p, c, b, material);
    add_quad(scene, p + a, b, c, material);
    add_quad(scene, p, a, c, material);
    add_quad(scene, p + b, c, a, material);
}

/// An orthonormal frame in which no coordinate is exact.
const Vec3 x(0.8, 0.48, 0.36);
const Vec3 y(-0.6, 0.64, 0.48);
const Vec3 z(0.0, -0.6, 0.8);

Vec3 at(double a, double b, double c)
{
    return a * x + b * y + c * z;
}

/// A matte room with a lamp under its ceiling and a pane of glass over its floor, turned so that no
/// coordinate is exact.
scenes::Scene room_with_pane(double thickness)
{
    scenes::Scene scene;
    scene.name = "pane";
    scene.materials = {scenes::Lambertian{Rgb(0.6, 0.54, 0.48)}, scenes::Emission{Rgb(5.0, 4.0, 3.0)},
                       scenes::Glass{Rgb(0.9), Rgb(0.9), 1.5}};
    scene.material_names = {"wall", "lamp", "pane"};
    // Facing inwards, because left-handed.
    add_box(scene, at(-1, -1, -1), 2.0 * y, 2.0 * x, 2.0 * z, 0);
    add_quad(scene, at(-0.4, 0.4, 0.9), 0.8 * x, -0.8 * y, 1);
    add_box(scene, at(-0.9, -0.9, -0.95), 1.8 * x, 1.8 * y, thickness * z, 2);
    scene.camera = scenes::Camera{at(0, -0.9, 0),
                                  x,
                                  z,
                                  -y, // looks along y
                                  scenes::FovAxis::horizontal,
                                  1.2};
    return scene;
}

/// Both wings make the same paths, except for about one sample in 2^14 that rounding changes, which
/// changes the mean by about as much. 7 standard errors are exceeded by chance once in 10^7 times.
void expect_same(const fast_transport_test::Means& floats, const fast_transport_test::Means& doubles,
                 const char* what)
{
    fast_transport_test::Means differences;
    for (std::size_t i = 0; i < floats.size(); ++i) differences.push_back(floats[i] - doubles[i]);
    EXPECT_LT(std::abs(fast_transport_test::average(differences)),
              7 * fast_transport_test::error_of(differences) +
                  1e-4 * fast_transport_test::average(doubles))
        << what << ": " << fast_transport_test::average(floats) << ", "
        << fast_transport_test::average(doubles);
    // Otherwise the test would be weak.
    EXPECT_LT(7 * fast_transport_test::error_of(differences),
              0.01 * fast_transport_test::average(doubles))
        << what;
}

void expect_as_by_the_reference(const scenes::Scene& scene, int max_edges)
{
    constexpr fast_transport_test::Samples samples{16, 32, 4};
    expect_same(means_by_host(scene, fast::Integrator::path, max_edges, 1, samples),
                means_by_ref(scene, ref::trace_path, max_edges, 1, samples), "path");
    expect_same(means_by_host(scene, fast::Integrator::bdpt, max_edges, 1, samples),
                means_by_ref(scene, ref::trace_bidirectionally, max_edges, 1, samples), "bdpt");
}

// A clearance of 16 u times the diagonal would be 3.3e-6 here: a ray that had entered the pane would
// start beyond it.
TEST(ThinThings, APaneOfGlassIsSeenThrough)
{
    for (const double thickness : {3e-5, 3e-6}) {
        SCOPED_TRACE(thickness);
        expect_as_by_the_reference(room_with_pane(thickness), 8);
    }
}

/// A matte room, a cube from -1.5 to 1.5. Under its ceiling a strong lamp covers a faint one of the
/// same size at a distance of `gap`; the faint one is `below` the ceiling. If `outside` > 0, a box of
/// that half width surrounds everything.
scenes::Scene room_with_covered_lamp(double below, double gap, double outside)
{
    scenes::Scene scene;
    scene.name = "covered lamp";
    scene.materials = {scenes::Lambertian{Rgb(0.5)}, scenes::Emission{Rgb(1e-4)},
                       scenes::Emission{Rgb(1)}};
    scene.material_names = {"wall", "faint", "strong"};
    add_box(scene, at(-1.5, -1.5, -1.5), 3.0 * y, 3.0 * x, 3.0 * z, 0);
    add_quad(scene, at(-0.5, 0.5, 1.5 - below), x, -y, 1);
    add_quad(scene, at(-0.5, 0.5, 1.5 - below - gap), x, -y, 2);
    if (outside > 0.0) {
        const double w = outside;
        add_box(scene, at(-w, -w, -w), 2 * w * x, 2 * w * y, 2 * w * z, 0);
    }
    scene.camera = scenes::Camera{at(0, -1.2, 0),
                                  x,
                                  z,
                                  -y, // looks along y
                                  scenes::FovAxis::horizontal,
                                  1.2};
    return scene;
}

// The strong lamp is black here, so that the light of the faint one can be measured: only the light
// that leaves the gap at its sides.
TEST(ThinThings, ALampThatCoversAnotherHidesIt)
{
    for (const double below : {0.0, 0.1})
        for (const double outside : {0.0, 1000.0})
            for (const double gap : {1e-8, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3}) {
                SCOPED_TRACE(testing::Message()
                             << "below " << below << ", outside " << outside << ", gap " << gap);
                scenes::Scene scene = room_with_covered_lamp(below, gap, outside);
                std::get<scenes::Emission>(scene.materials[2]).radiance = Rgb(0.0);
                scenes::Scene uncovered = scene;
                uncovered.triangles.erase(uncovered.triangles.begin() + 14,
                                          uncovered.triangles.begin() + 16);
                constexpr fast_transport_test::Samples samples{8, 4, 4};
                for (const auto integrator :
                     {fast::Integrator::path, fast::Integrator::bdpt, fast::Integrator::light}) {
                    const double seen =
                        fast_transport_test::average(means_by_host(scene, integrator, 3, 1, samples));
                    const double all = fast_transport_test::average(
                        means_by_host(uncovered, integrator, 3, 1, samples));
                    EXPECT_GT(all, 1e-6);
                    // The sides of the gap have 4 gap of the lamp's area of 1; a path through the gap
                    // loses light by reflections.
                    EXPECT_LT(seen, (1e-4 + 4 * gap) * all) << static_cast<int>(integrator);
                }
            }
}

// With a lamp close under the ceiling, a segment to the ceiling is tested from both ends. Both tests
// must not miss an object that is exactly in the middle.
TEST(ThinThings, AShelfHalfWayToACeilingWithALampIsNotSeenThrough)
{
    scenes::Scene scene = room_with_covered_lamp(4e-6, 0.1, 0);
    scene.triangles.resize(scene.triangles.size() - 2); // no second lamp
    std::get<scenes::Emission>(scene.materials[1]).radiance = Rgb(1.0);
    add_quad(scene, at(-1.5, -0.9, 0), 3.0 * x, 2.4 * y, 0);
    scene.camera->eye = at(0, -1.2, -0.7);
    expect_as_by_the_reference(scene, 5);
}

// Glass so close over a wall that a segment to the wall could end in it. (If it is closer than 1e-6,
// rays that leave the glass start beyond the wall: float_notices.h reports it.)
TEST(ThinThings, APaneCloseOverAWallIsNotLeftOut)
{
    for (const double gap : {0.0, 3e-6, 1e-5}) {
        SCOPED_TRACE(gap);
        scenes::Scene scene = room_with_pane(0.01);
        const Vec3 to_floor = (gap - 0.05) * z;
        for (scenes::Triangle& triangle : scene.triangles)
            if (triangle.material == 2)
                for (Vec3& v : triangle.vertices) v += to_floor;
        expect_as_by_the_reference(scene, 6);
    }
}

// Around a lamp in glass: distant objects do not move refracted rays.
TEST(ThinThings, AWideGroundDoesNotChangeWhatGlassRefracts)
{
    for (const double wider : {1.0, 1e2, 1e3}) {
        SCOPED_TRACE(wider);
        scenes::Scene scene = transport_test::our_scene("light_in_glass");
        for (scenes::Triangle& triangle : scene.triangles)
            if (std::holds_alternative<scenes::Lambertian>(scene.materials[triangle.material]))
                for (Vec3& v : triangle.vertices) v = {wider * v.x, wider * v.y, v.z};
        expect_as_by_the_reference(scene, 6);
    }
}

} // namespace
