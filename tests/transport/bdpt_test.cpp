// Bidirectional path tracing and light tracing as a whole: against path tracing, against closed forms by
// path length, and against themselves in other clothes.

#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/render.h"
#include "tests/transport/changed_scene.h"
#include "tests/transport/estimate.h"
#include "tests/transport/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace {

using ref::Contribution;
using ref::Rgb;
using ref::Vec3;
using tests::moved;
using tests::scaled;
constexpr double pi = std::numbers::pi;

/// PLUMBLINE_LONG multiplies the samples, for a night's run.
int effort()
{
    return std::getenv("PLUMBLINE_LONG") != nullptr ? 16 : 1;
}

/// A scene, its samples per batch, the longest paths, and the bias of a whole picture that a comparison
/// finds with 99% power (in its quarters: three times that): of path tracing, with four times the
/// samples, and light tracing, likewise, against both ways. 0: it cannot see everything, because mirror
/// or glass stands between a scattering surface and the eye.
struct Case {
    const char* scene;
    int batch_size;
    int edges;
    double path, light;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.scene;
}

class Integrators : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(
    Scenes, Integrators,
    testing::Values(
        Case{"all_emitters", 8, 4, 0.12, 0.15}, Case{"area_light_over_plane", 4, 3, 0.05, 0.1},
        Case{"camera_in_glass", 12, 5, 0.12, 0.0}, Case{"camera_in_glass_furnace", 2, 6, 0.06, 0.0},
        Case{"ceiling_lamp", 2, 5, 0.3, 0.08}, Case{"cornell_diffuse", 3, 5, 0.06, 0.08},
        Case{"cornell_glass", 3, 6, 0.15, 0.0}, Case{"directional_over_plane", 4, 3, 0.05, 0.15},
        Case{"door_ajar", 3, 5, 1.5, 0.7}, Case{"furnace", 2, 6, 0.03, 0.0},
        Case{"furnace_grey", 12, 4, 0.03, 0.0}, Case{"integrating_sphere", 2, 6, 0.03, 0.1},
        Case{"integrating_sphere_lamp", 3, 6, 0.06, 0.15}, Case{"light_in_glass", 32, 4, 0.3, 0.0},
        Case{"mirror_image", 8, 4, 0.09, 0.0}, Case{"near_occluder", 8, 3, 0.06, 0.1},
        Case{"point_over_plane", 4, 3, 0.05, 0.1}, Case{"sphere_over_plane", 8, 3, 0.05, 0.1},
        Case{"spot_over_plane", 4, 3, 0.05, 0.1}),
    [](const auto& name) { return std::string(name.param.scene); });

void expect_same_pictures(const tests::Batches& a, const tests::Batches& b, double specification)
{
    const int w = a.front().width;
    const int h = a.front().height;
    for (int channel = 0; channel < 3; ++channel)
        tests::expect_equal_means(tests::measure(a, {0, 0, w, h}, channel),
                                  tests::measure(b, {0, 0, w, h}, channel), specification);
    for (const tests::Region& quarter : {tests::Region{0, 0, w / 2, h / 2},
                                         {w / 2, 0, w, h / 2},
                                         {0, h / 2, w / 2, h},
                                         {w / 2, h / 2, w, h}}) {
        const auto p = tests::measure(a, quarter, 1);
        if (p.mean < 0.1 * tests::measure(a, {0, 0, w, h}, 1).mean) continue;
        tests::expect_equal_means(p, tests::measure(b, quarter, 1), 3.0 * specification);
    }
}

TEST_P(Integrators, MakeTheSamePicture)
{
    const Case& c = GetParam();
    const scenes::Scene scene = tests::our_scene(c.scene);
    const ref::World world(scene, 24, 16);
    const auto picture = [&](ref::Integrator integrator, std::uint64_t seed, int more) {
        return tests::estimate(world, integrator,
                               {.batches = 32,
                                .batch_size = more * c.batch_size * effort(),
                                .path = {.seed = seed, .max_edges = c.edges}});
    };
    const double root = std::sqrt(effort());
    const auto both = picture(ref::trace_bidirectionally, 42, 1);
    {
        SCOPED_TRACE("path tracing");
        expect_same_pictures(picture(ref::trace_path, 41, 4), both, c.path / root);
    }
    if (c.light > 0.0) {
        SCOPED_TRACE("light tracing");
        expect_same_pictures(picture(ref::trace_light, 44, 4), both, c.light / root);
    }
}

// Another heuristic distributes the same light otherwise: not only the sums, each path's shares add up
// to 1 (mis_weight_test.cpp), here in the mean.
TEST(Heuristics, MakeTheSamePicture)
{
    const scenes::Scene scene = tests::our_scene("all_emitters");
    const ref::World world(scene, 24, 16);
    const auto picture = [&](ref::Heuristic heuristic, std::uint64_t seed) {
        return tests::estimate(world, ref::trace_bidirectionally,
                               {.batches = 32,
                                .batch_size = 12,
                                .path = {.seed = seed, .max_edges = 4, .heuristic = heuristic}});
    };
    expect_same_pictures(picture(ref::Heuristic::balance, 45), picture(ref::Heuristic::power, 46), 0.12);
}

// Paths from a point light in glass to a scattering plane: next event is never possible, so a path
// tracer is black; the light image alone finds them. With j reflections inside the ball E_j = (1-F) F^j
// I cos / d^2, F = 0.04, at 3 + j edges.
TEST(ClosedFormBothWays, PointInGlassIsSeenByLightWalksAlone)
{
    const scenes::Scene scene = tests::our_scene("point_in_glass");
    constexpr int width = 24;
    constexpr int height = 16;
    const ref::World world(scene, width, height);
    const auto& camera = *scene.camera;
    const Vec3 light = scene.point_lights[0].position;
    const Rgb albedo = std::get<scenes::Lambertian>(scene.materials[scene.triangles[0].material]).albedo;
    golden::Image expected(width, height); // at 3 edges, green
    constexpr int steps = 16;
    const double pixel = 2.0 * std::tan(camera.fov / 2) / height;
    double beside_the_ball = 0.0;
    for (int y = 0; y < height * steps; ++y)
        for (int x = 0; x < width * steps; ++x) {
            const Vec3 d = -camera.backward + ((x + 0.5) / steps - width / 2.0) * pixel * camera.right -
                           ((y + 0.5) / steps - height / 2.0) * pixel * camera.up;
            const Vec3 p = camera.eye - camera.eye.z / d.z * d;
            const double past =
                glm::length(glm::cross(glm::normalize(d), scene.spheres[0].center - camera.eye));
            if (past < scene.spheres[0].radius) continue; // the plane is seen through the ball
            ++beside_the_ball;
            const double r = glm::length(light - p);
            expected.at(x / steps, y / steps) += 0.96 * scene.point_lights[0].intensity * albedo / pi *
                                                 light.z / (r * r * r) /
                                                 static_cast<double>(steps * steps);
        }
    ASSERT_GT(beside_the_ball, 1000.0);
    for (const auto integrator : {ref::trace_bidirectionally, ref::trace_light}) {
        const auto batches = tests::estimate(
            world, integrator, {.batches = 32, .batch_size = 64, .path = {.seed = 5, .max_edges = 4}}, 5,
            [](const Contribution& c) { return c.t == 1 ? edges(c) : -1; });
        for (int channel = 0; channel < 3; ++channel) {
            const double e = tests::mean_over(expected, {0, 0, width, height}, channel);
            tests::expect_mean(tests::measure(batches[3], {0, 0, width, height}, channel), e, 0.05);
            tests::expect_mean(tests::measure(batches[4], {0, 0, width, height}, channel), 0.04 * e,
                               0.3);
        }
    }
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 4096; ++i)
        trace_path(world, {.seed = 5, .max_edges = 6}, {5, i % (width * height), i}, out);
    EXPECT_TRUE(out.empty());
}

// The integrating sphere by path length, as for the path tracer: rho^(k-1) I / (pi R^2).
TEST(ClosedFormBothWays, IntegratingSphereByPathLength)
{
    const scenes::Scene scene = tests::our_scene("integrating_sphere");
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[scene.spheres[0].material]).albedo;
    const ref::World world(scene, 16, 16);
    constexpr int longest = 7;
    struct {
        ref::Integrator integrator;
        double specification;
    } const cases[] = {{ref::trace_bidirectionally, 0.01}, {ref::trace_light, 0.08}};
    for (const auto& [integrator, specification] : cases) {
        const auto batches =
            tests::estimate(world, integrator,
                            {.batches = 32, .batch_size = 12, .path = {.seed = 6, .max_edges = longest}},
                            longest + 1, [](const Contribution& c) { return edges(c); });
        for (int k = 3; k <= longest; ++k)
            for (int channel = 0; channel < 3; ++channel) {
                const double expected =
                    std::pow(rho[channel], k - 1) * scene.point_lights[0].intensity[channel] / pi;
                const auto& b = batches[static_cast<std::size_t>(k)];
                tests::expect_mean(tests::measure(b, {0, 0, 16, 16}, channel), expected,
                                   k <= 6 ? specification : 3 * specification);
                tests::expect_mean(tests::measure(b, {3, 8, 16, 16}, channel), expected,
                                   3 * specification);
            }
    }
}

// A luminous sphere in an integrating sphere: on the wall rho L q (rho (1 - q))^(k-2), q = 0.09. Pixels
// that see the lamp or its edge are left out.
TEST(ClosedFormBothWays, IntegratingSphereWithALampByPathLength)
{
    const scenes::Scene scene = tests::our_scene("integrating_sphere_lamp");
    const ref::World world(scene, 16, 16);
    std::uint32_t wall_material = 0;
    Rgb radiance(0.0);
    double q = 0.0;
    const scenes::Sphere* lamp = nullptr;
    for (const auto& sphere : scene.spheres)
        if (const auto* e = std::get_if<scenes::Emission>(&scene.materials[sphere.material])) {
            radiance = e->radiance;
            q = sphere.radius * sphere.radius;
            lamp = &sphere;
        } else {
            wall_material = sphere.material;
        }
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[wall_material]).albedo;
    std::vector<int> wall; // pixels whose corners are all well beside the lamp
    for (int i = 0; i < 256; ++i) {
        double nearest = 1.0;
        for (const glm::dvec2 c : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
            const Vec3 d = world.camera.ray({i % 16 + c.x, i / 16 + c.y}).direction;
            nearest = std::min(nearest, glm::length(glm::cross(d, lamp->center - world.camera.eye())));
        }
        if (nearest > 1.2 * lamp->radius) wall.push_back(i);
    }
    ASSERT_GT(wall.size(), 64u);
    constexpr int longest = 6;
    struct {
        ref::Integrator integrator;
        double specification;
    } const cases[] = {{ref::trace_bidirectionally, 0.07}, {ref::trace_light, 0.16}};
    for (const auto& [integrator, specification] : cases) {
        const auto batches =
            tests::estimate(world, integrator,
                            {.batches = 32, .batch_size = 16, .path = {.seed = 8, .max_edges = longest}},
                            longest + 1, [](const Contribution& c) { return edges(c); });
        for (int k = 2; k <= longest; ++k)
            for (int channel = 0; channel < 3; ++channel) {
                const double expected =
                    rho[channel] * radiance[channel] * q * std::pow(rho[channel] * (1 - q), k - 2);
                std::vector<double> means;
                for (const auto& image : batches[static_cast<std::size_t>(k)]) {
                    double sum = 0.0;
                    for (const int i : wall) sum += image.pixels[static_cast<std::size_t>(i)][channel];
                    means.push_back(sum / static_cast<double>(wall.size()));
                }
                tests::expect_mean(tests::measure(means), expected, specification);
            }
    }
}

// Total reflection, Fresnel and eta^2 in one: n^2 Le (1 - F^(edges - 1)), see the scene's head. Weighted
// bidirectionally nothing but the emission hit remains, with weight exactly 1.
TEST(ClosedFormBothWays, CameraInGlassSeesTheSkyByHittingItAlone)
{
    const scenes::Scene scene = tests::our_scene("camera_in_glass_furnace");
    const ref::World world(scene, 24, 16);
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 24 * 16 * 8; ++i)
        trace_bidirectionally(world, {.seed = 3, .max_edges = 3}, {3, i % (24 * 16), i}, out);
    ASSERT_GT(out.size(), 1000u);
    for (const Contribution& c : out) {
        EXPECT_EQ(c.s, 0);
        EXPECT_EQ(c.weight, 1.0);
        EXPECT_NEAR(c.value.x, 2.25 * scene.environment->x, 1e-14);
    }
}

// An empty scene has no extent for light from infinity to shine on: the eye sees the sky by hitting it,
// and no walk begins there.
TEST(Infinity, AnEmptySceneShowsTheSky)
{
    scenes::Scene scene;
    scene.environment = Rgb(0.9, 0.6, 0.3);
    scene.camera = scenes::Camera{
        Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.5};
    const ref::World world(scene, 12, 8);
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 96; ++i)
        trace_bidirectionally(world, {.max_edges = 3}, {0, i, 0}, out);
    ASSERT_EQ(out.size(), 96u);
    for (const Contribution& c : out) EXPECT_EQ(c.weight * c.value, *scene.environment);
}

// With a black ball behind the eye it can be chosen, too, and seen as a light image of one vertex: a hit
// has the density 1 / (A c^3), a choice 1 / (4 pi). For a picture of 1.86 sr seen by way of both, every
// share is known: c^-3 / (c^-3 + A / (4 pi)).
TEST(Infinity, TheSkyIsHitAndChosenWithTheirShares)
{
    scenes::Scene scene;
    scene.materials = {scenes::Lambertian{Rgb(0.0)}};
    scene.material_names = {"black"};
    scene.spheres.push_back({Vec3(0, 0, 5), 1.0, 0});
    scene.environment = Rgb(0.9, 0.6, 0.3);
    scene.camera = scenes::Camera{
        Vec3(0.0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), scenes::FovAxis::horizontal, 1.5};
    const ref::World world(scene, 12, 8);
    const double area = std::pow(2.0 * std::tan(0.75), 2) * 8 / 12;
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < 96 * 16; ++i) {
        const ref::SampleId id{0, i % 96, i / 96};
        out.clear();
        trace_bidirectionally(world, {.max_edges = 3}, id, out);
        ASSERT_FALSE(out.empty());
        EXPECT_EQ(out[0].s, 0);
        const double c = -camera_ray(world, id).direction.z;
        EXPECT_NEAR(out[0].weight, 1.0 / (1.0 + area * c * c * c / (4.0 * pi)), 1e-14);
    }
    const auto both = tests::estimate(world, ref::trace_bidirectionally,
                                      {.batches = 32, .batch_size = 256, .path = {.max_edges = 3}});
    for (int channel = 0; channel < 3; ++channel)
        tests::expect_mean(tests::measure(both, {0, 0, 12, 8}, channel), (*scene.environment)[channel],
                           0.02);
}

// --- the same light in other clothes ---------------------------------------------------------------

std::vector<Contribution> samples(const scenes::Scene& scene, int max_edges, std::uint32_t count)
{
    const ref::World world(scene, 24, 16);
    std::vector<Contribution> out;
    for (std::uint32_t i = 0; i < count; ++i)
        trace_bidirectionally(world, {.seed = 9, .max_edges = max_edges}, {9, i % (24 * 16), i}, out);
    return out;
}

/// How many contributions differ in more than rounding; all, if their number does.
std::size_t different(const std::vector<Contribution>& a, const std::vector<Contribution>& b,
                      double tolerance)
{
    if (a.size() != b.size()) return std::max(a.size(), b.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        bool same = a[i].pixel == b[i].pixel && a[i].s == b[i].s && a[i].t == b[i].t &&
                    std::abs(a[i].weight - b[i].weight) <= tolerance * a[i].weight;
        for (int channel = 0; channel < 3; ++channel)
            same = same && std::abs(a[i].value[channel] - b[i].value[channel]) <=
                               tolerance * a[i].value[channel];
        count += same ? 0 : 1;
    }
    return count;
}

class InOtherClothes : public testing::TestWithParam<const char*> {
protected:
    scenes::Scene scene = tests::our_scene(GetParam());
    std::vector<Contribution> original = samples(scene, 6, 3000);
};
INSTANTIATE_TEST_SUITE_P(Scenes, InOtherClothes, testing::Values("cornell_glass", "all_emitters"),
                         [](const auto& name) { return std::string(name.param); });

// By a power of two nothing is rounded differently but the many factors of the densities, whose product
// stays within range: no bit may change.
TEST_P(InOtherClothes, ScalingByAPowerOfTwoChangesNoBit)
{
    EXPECT_EQ(different(original, samples(scaled(scene, 1024.0), 6, 3000), 0.0), 0u);
    EXPECT_EQ(different(original, samples(scaled(scene, 1.0 / 1024.0), 6, 3000), 0.0), 0u);
}

// As for the path tracer (metamorphic_test.cpp), where 1e5 roundoffs are derived for a walk; a path here
// consists of two, and its weight of products of all its factors.
TEST_P(InOtherClothes, ScalingByAnyFactorChangesNothingButRounding)
{
    EXPECT_EQ(different(original, samples(scaled(scene, 1e3), 6, 3000), 1e-7), 0u);
    EXPECT_EQ(different(original, samples(scaled(scene, 1e-3), 6, 3000), 1e-7), 0u);
}

TEST_P(InOtherClothes, TwiceTheRadianceIsTwiceThePicture)
{
    scenes::Scene bright = scene;
    for (auto& material : bright.materials)
        if (auto* emission = std::get_if<scenes::Emission>(&material)) emission->radiance *= 2.0;
    for (auto& light : bright.point_lights) light.intensity *= 2.0;
    for (auto& light : bright.spot_lights) light.intensity *= 2.0;
    for (auto& light : bright.directional_lights) light.irradiance *= 2.0;
    if (bright.environment) *bright.environment *= 2.0;
    for (Contribution& c : original) c.value *= 2.0;
    EXPECT_EQ(different(original, samples(bright, 6, 3000), 0.0), 0u);
}

// 1e3 diameters away coordinates are known to 1e-13 diameters; in corners, where two vertices of a
// connection come close, d^2 magnifies that by (diameter / d)^1: a few in a thousand may differ by more.
TEST_P(InOtherClothes, MovingFarAwayChangesNothingButRounding)
{
    const double diameter = ref::Geometry(scene).diagonal();
    const Vec3 by = diameter * 1e3 * glm::normalize(Vec3(0.6, -0.5, 0.4));
    EXPECT_LE(different(original, samples(moved(scene, by), 6, 3000), 1e-5), original.size() / 1000);
}

// --- rules ------------------------------------------------------------------------------------------

// No contribution is longer than max_edges, and up to there none is missing: fewer edges leave out
// exactly the longer ones and change the weights of none, as no strategy of a shorter path depends on
// longer walks.
TEST(MaxEdges, LeavesOutTheLongerPathsAlone)
{
    const scenes::Scene scene = tests::our_scene("cornell_glass");
    std::vector<Contribution> all = samples(scene, 9, 1000);
    for (int k = 8; k >= 1; --k) {
        std::erase_if(all, [&](const Contribution& c) { return edges(c) > k; });
        auto fewer = samples(scene, k, 1000);
        EXPECT_EQ(different(all, fewer, 0.0), 0u) << k;
    }
    EXPECT_FALSE(all.empty());
}

TEST(Roulette, ChangesNothingInTheMean)
{
    const scenes::Scene scene = tests::our_scene("integrating_sphere_lamp");
    const ref::World world(scene, 12, 12);
    for (const auto integrator : {ref::trace_bidirectionally, ref::trace_light}) {
        const auto long_paths = [&](bool roulette, std::uint64_t seed) {
            const auto batches =
                tests::estimate(world, integrator,
                                {.batches = 32,
                                 .batch_size = 16,
                                 .path = {.seed = seed, .max_edges = 9, .roulette = roulette}},
                                1, [](const Contribution& c) { return edges(c) >= 6 ? 0 : -1; });
            return tests::measure(batches[0], {0, 0, 12, 12}, 1);
        };
        tests::expect_equal_means(long_paths(true, 1), long_paths(false, 2),
                                  integrator == ref::trace_light ? 0.25 : 0.1);
    }
}

class Splats : public testing::TestWithParam<ref::Integrator> {};
INSTANTIATE_TEST_SUITE_P(Integrators, Splats,
                         testing::Values(&ref::trace_bidirectionally, &ref::trace_light),
                         [](const auto& name) {
                             return name.param == &ref::trace_light ? "light" : "bdpt";
                         });

// The mean radiance of a picture does not depend on the number of its pixels; nor does that of a part
// that another shape of the picture shows as well. Splats divided by the wrong number would show here.
TEST_P(Splats, HaveTheSameScaleInEverySizeAndShape)
{
    const scenes::Scene scene = tests::our_scene("cornell_diffuse"); // horizontal field of view
    const auto part = [&](int width, int height, int batch_size, const tests::Region& region) {
        const ref::World world(scene, width, height);
        const auto batches = tests::estimate(
            world, GetParam(),
            {.batches = 32, .batch_size = batch_size, .path = {.seed = 13, .max_edges = 3}});
        return tests::measure(batches, region, 0);
    };
    const auto wide = part(24, 16, 12, {0, 4, 24, 12});
    const auto small = part(6, 4, 200, {0, 1, 6, 3});
    const auto strip = part(24, 8, 24, {0, 0, 24, 8});   // the middle half of the picture
    const auto tall = part(12, 24, 16, {0, 10, 12, 14}); // 12 x 4 in the middle of it
    tests::expect_equal_means(wide, small, 0.06);
    tests::expect_equal_means(wide, strip, 0.06);
    tests::expect_equal_means(strip, tall, 0.06);
}

// Every pixel, to the edges: a constant picture, of four edges in the integrating sphere, has no dark
// rim.
TEST(LightImage, ReachesTheEdgesOfTheFilm)
{
    const scenes::Scene scene = tests::our_scene("integrating_sphere");
    constexpr int n = 16;
    const ref::World world(scene, n, n);
    const Rgb rho = std::get<scenes::Lambertian>(scene.materials[scene.spheres[0].material]).albedo;
    const double expected = std::pow(rho.x, 3) * scene.point_lights[0].intensity.x / pi;
    const auto batches =
        tests::estimate(world, ref::trace_light,
                        {.batches = 32, .batch_size = 48, .weighted = false, .path = {.max_edges = 4}},
                        1, [](const Contribution& c) { return c.s == 4 ? 0 : -1; })
            .front();
    for (const tests::Region& rim :
         {tests::Region{0, 0, n, 1}, {0, n - 1, n, n}, {0, 0, 1, n}, {n - 1, 0, n, n}})
        tests::expect_mean(tests::measure(batches, rim, 0), expected, 0.2);
}

// A film is the same to the last bit whatever the number of threads, and whether it was rendered at once
// or in two parts: splats cross tiles, and 40 x 24 pixels are six of them.
TEST_P(Splats, FallInTheSameOrderWhateverTheThreads)
{
    const scenes::Scene scene = tests::our_scene("cornell_glass");
    const ref::World world(scene, 40, 24);
    const auto film = [&](unsigned threads, std::uint64_t first_part) {
        golden::Film result(40, 24);
        ref::RenderOptions options{
            .path = {.seed = 2, .max_edges = 5}, .batches = 4, .batch_size = 1, .threads = threads};
        if (first_part > 0) {
            options.batches = first_part;
            EXPECT_TRUE(render(world, GetParam(), options, result));
            options.batches = 4;
            result = golden::Film(result.mean(), result.squares(), result.batches());
        }
        EXPECT_TRUE(render(world, GetParam(), options, result));
        return result;
    };
    const golden::Film one = film(1, 0);
    EXPECT_TRUE(one == film(2, 0));
    EXPECT_TRUE(one == film(5, 0));
    EXPECT_TRUE(one == film(3, 1));
    EXPECT_FALSE(one.mean() == golden::Image(40, 24));
}

// render() and a plain sum over the contributions are the same picture, up to the order of summation.
TEST_P(Splats, AreDividedBySamplesPerPixelOnce)
{
    const scenes::Scene scene = tests::our_scene("cornell_diffuse");
    const ref::World world(scene, 20, 12);
    golden::Film film(20, 12);
    const ref::RenderOptions options{
        .path = {.seed = 6, .max_edges = 4}, .batches = 2, .batch_size = 3, .threads = 2};
    ASSERT_TRUE(render(world, GetParam(), options, film));
    golden::Image sum(20, 12);
    std::vector<Contribution> out;
    for (std::uint32_t pixel = 0; pixel < 20 * 12; ++pixel)
        for (std::uint32_t i = 0; i < 6; ++i) GetParam()(world, options.path, {6, pixel, i}, out);
    for (const Contribution& c : out) sum.pixels[c.pixel] += c.weight * c.value / 6.0;
    for (std::size_t i = 0; i < sum.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(film.mean().pixels[i][channel], sum.pixels[i][channel],
                        1e-12 * sum.pixels[i][channel]);
}

} // namespace
