// Eye and light exchanged. A point light of intensity 1 at A causes the fluence (radiance integrated
// over all directions) Phi at B. With the light at B, A receives the same, up to the square of the
// indices: Phi_B / n_B^2 = Phi_A / n_A^2 [Veach 1997, sec. 6.2]. With glass around one of them the two
// pictures are made by different strategies: the light image for one, next event for the other.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "tests/ref/transport/estimate.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using ref::Contribution;
using ref::Rgb;
using ref::Vec3;
using std::numbers::pi;

/// A room of two matte walls, a mirror and a glass ball, otherwise open; without a light.
scenes::Scene stage()
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{Rgb(0.7, 0.5, 0.3)}, scenes::Lambertian{Rgb(0.4, 0.6, 0.8)},
                       scenes::Mirror{Rgb(0.9, 0.8, 0.7)},
                       scenes::Glass{Rgb(0.9, 1.0, 0.8), Rgb(1.0, 0.9, 0.8), 1.5}};
    scene.material_names = {"floor", "wall", "mirror", "glass"};
    const auto square = [&](Vec3 corner, Vec3 a, Vec3 b, std::uint32_t material) {
        scene.triangles.push_back({{corner, corner + a, corner + a + b}, material});
        scene.triangles.push_back({{corner, corner + a + b, corner + b}, material});
    };
    square(Vec3(-3, -3, 0), Vec3(6, 0, 0), Vec3(0, 6, 0), 0);
    square(Vec3(-3, 3, 0), Vec3(6, 0, 0), Vec3(0, 0, 4), 1);
    square(Vec3(-3, -3, 0), Vec3(0, 6, 0), Vec3(0, 0, 4), 2);
    scene.spheres.push_back({Vec3(0.9, 0.8, 0.6), 0.5, 3});
    return scene;
}

/// The fluence at `eye` (green) of a point light at `light`: one picture for each face of a cube. A
/// pixel is weighted by its solid angle: cos^3 at its middle times its area, with an error of the
/// order of 1 / n^2.
transport_test::Measured fluence(scenes::Scene scene, const Vec3& eye, const Vec3& light,
                                 ref::Integrator integrator, std::uint64_t seed)
{
    constexpr int n = 12;
    constexpr int batches = 24;
    scene.point_lights.push_back({light, Rgb(1.0)});
    std::vector<double> sums(batches, 0.0);
    for (int face = 0; face < 6; ++face) {
        Vec3 backward(0.0);
        backward[face % 3] = face < 3 ? 1.0 : -1.0;
        Vec3 right(0.0);
        right[(face + 1) % 3] = 1.0;
        scene.camera = scenes::Camera{
            eye, right, glm::cross(backward, right), backward, scenes::FovAxis::horizontal, pi / 2};
        const ref::World world(scene, n, n);
        const auto images = transport_test::estimate(
            world, integrator,
            {.batches = batches,

             .batch_size = 24,
             .path = {.seed = seed + static_cast<std::uint64_t>(face), .max_edges = 5}});
        for (std::size_t i = 0; i < images.size(); ++i)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const double u = (2 * x + 1.0) / n - 1.0;
                    const double v = (2 * y + 1.0) / n - 1.0;
                    sums[i] += images[i].at(x, y).y * 4.0 / (n * n) / std::pow(1 + u * u + v * v, 1.5);
                }
    }
    return transport_test::measure(sums);
}

transport_test::Measured times(transport_test::Measured m, double factor)
{
    return {m.mean * factor, m.standard_error * factor, m.batches};
}

class Reciprocity : public testing::TestWithParam<ref::Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Reciprocity,
                         testing::Values(&ref::trace_path, &ref::trace_bidirectionally,
                                         &ref::trace_light),
                         [](const auto& name) {
                             return name.param == &ref::trace_light  ? "light"
                                    : name.param == &ref::trace_path ? "path"
                                                                     : "bdpt";
                         });

const Vec3 a(-0.7, -0.9, 1.6);
const Vec3 b(0.4, 1.7, 0.5);

// Light tracing misses light that the eye sees only by way of mirrors and glass. Path tracing misses
// light that reaches a surface from a point light only by way of these. After the exchange the missing
// part is another one. Therefore these two are tested with all materials made matte.
TEST_P(Reciprocity, EyeAndLightInAirCanBeExchanged)
{
    scenes::Scene scene = stage();
    if (GetParam() != &ref::trace_bidirectionally)
        for (auto& material : scene.materials) material = scenes::Lambertian{Rgb(0.6, 0.5, 0.4)};
    transport_test::expect_equal_means(fluence(scene, a, b, GetParam(), 10),
                                       fluence(scene, b, a, GetParam(), 20),
                                       GetParam() == &ref::trace_light ? 0.16 : 0.06);
}

// n^2 = 2.25 if correct; 1 or 5.06 if eta^2 is missing or applied on both walks.
TEST(ReciprocityInGlass, EyeAndLightDifferByTheSquareOfTheIndex)
{
    scenes::Scene scene = stage();
    const Vec3 in_glass = scene.spheres[0].center + Vec3(0.1, -0.15, 0.05);
    const auto seen_in_glass = fluence(scene, in_glass, a, ref::trace_bidirectionally, 30);
    const auto lit_in_glass = fluence(scene, a, in_glass, ref::trace_bidirectionally, 40);
    transport_test::expect_equal_means(times(seen_in_glass, 1 / 2.25), lit_in_glass, 0.25);
}

} // namespace
