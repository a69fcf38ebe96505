// Scenes around one luminaire: the surfaces that it lights, those that it must not light, and its own
// appearance.

#include "tests/ref/transport/integrators.h"
#include "tests/ref/transport/known_light.h"
#include "tests/ref/transport/scene_files.h"

#include <gtest/gtest.h>

namespace {

using ref::Contribution;
using ref::Rgb;
using ref::Vec3;
using transport_test::Line;

constexpr int width = 36;
constexpr int height = 24;
const Vec3 upwards(0.0, 0.0, 1.0);

class LuminaireScene : public transport_test::OfEveryIntegrator {};

INSTANTIATE_TEST_SUITE_P(Integrators, LuminaireScene, transport_test::integrators(),
                         transport_test::name_of);
INSTANTIATE_TEST_SUITE_P(LightTracer, LuminaireScene, transport_test::light_tracer(),
                         transport_test::name_of);

int by_edges(const Contribution& c)
{
    return edges(c);
}

/// The luminaire of a scene with exactly one, a convex planar quadrangle of two triangles that share a
/// diagonal.
struct Quadrangle {
    std::vector<Vec3> corners; // those of the first triangle, in order, with the other's corner inserted
    Vec3 center;
    Vec3 normal;
    Rgb radiance;
};

Quadrangle luminaire_of(const scenes::Scene& scene)
{
    std::vector<const scenes::Triangle*> lit;
    for (const auto& triangle : scene.triangles)
        if (std::holds_alternative<scenes::Emission>(scene.materials[triangle.material]))
            lit.push_back(&triangle);
    if (lit.size() != 2) throw std::logic_error(scene.name + ": not one quadrangle of two triangles");
    const auto& a = lit[0]->vertices;
    Quadrangle q{{a.begin(), a.end()},
                 Vec3(0.0),
                 glm::normalize(glm::cross(a[1] - a[0], a[2] - a[0])),
                 std::get<scenes::Emission>(scene.materials[lit[0]->material]).radiance};
    for (const Vec3& v : lit[1]->vertices)
        if (std::find(a.begin(), a.end(), v) == a.end()) {
            // Inserted between the two ends of the diagonal, opposite the remaining corner.
            for (std::size_t i = 0; i < 3; ++i) {
                const auto& b = lit[1]->vertices;
                if (std::find(b.begin(), b.end(), a[i]) == b.end())
                    q.corners.insert(q.corners.begin() + static_cast<std::ptrdiff_t>((i + 2) % 3), v);
            }
            break;
        }
    for (const Vec3& v : q.corners) q.center += v / 4.0;
    return q;
}

Rgb sum_of(const std::vector<Contribution>& contributions)
{
    Rgb sum(0.0);
    for (const Contribution& c : contributions) sum += c.weight * c.value;
    return sum;
}

// The eye sees the plane, which is lit in front of the light and dark behind it, and the back of the
// light, which is black.
TEST_P(LuminaireScene, AnAreaLightShinesForwardsOnly)
{
    const scenes::Scene scene = transport_test::our_scene("area_light_over_plane");
    const ref::World world(scene, width, height);
    const Quadrangle light = luminaire_of(scene);
    const auto known = transport_test::known_picture(
        *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
            const auto seen = transport_test::first_seen(scene, line);
            if (!transport_test::is<scenes::Lambertian>(scene, seen)) return Rgb(0.0); // its back
            if (glm::dot(seen->point - light.center, light.normal) <= 0.0) return Rgb(0.0);
            return transport_test::albedo_at(scene, *seen) / transport_test::pi * light.radiance *
                   transport_test::polygon_irradiance(seen->point, upwards, light.corners);
        });
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(24), .path = {.seed = 52}});
    transport_test::expect_picture(batches, known, GetParam().bias(0.03));
}

TEST(LuminaireSceneBySample, BehindAnAreaLightItIsDark)
{
    const scenes::Scene scene = transport_test::our_scene("area_light_over_plane");
    const ref::World world(scene, width, height);
    const Quadrangle light = luminaire_of(scene);
    int dark = 0;
    int back = 0;
    transport_test::for_every_sample(world, ref::trace_path, {.seed = 53}, 16,
                                     [&](const Line& line, const std::vector<Contribution>& all) {
                                         const auto seen = transport_test::first_seen(scene, line);
                                         if (!transport_test::is<scenes::Lambertian>(scene, seen))
                                             ++back;
                                         else if (glm::dot(seen->point - light.center, light.normal) <=
                                                  0.0)
                                             ++dark;
                                         else
                                             return;
                                         ASSERT_EQ(sum_of(all), Rgb(0.0));
                                     });
    EXPECT_GT(dark, 1000);
    EXPECT_GT(back, 100);
}

// A card just below the luminaire: umbra and full light are known, the penumbra is left out.
TEST_P(LuminaireScene, ACardCloseToALuminaireCastsItsShadow)
{
    const scenes::Scene scene = transport_test::our_scene("near_occluder");
    const ref::World world(scene, width, height);
    const Quadrangle light = luminaire_of(scene);
    const auto known = transport_test::known_picture(
        *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
            const auto seen = transport_test::first_seen(scene, line);
            if (!seen || seen->point.z > 1e-9) return Rgb(0.0); // card or the luminaire's back: black
            const Vec3 from_axis = seen->point - light.center;
            const double farther = std::max(std::abs(from_axis.x), std::abs(from_axis.y));
            if (farther < 0.27) return Rgb(0.0);
            if (farther < 1.23) return std::nullopt;
            return transport_test::albedo_at(scene, *seen) / transport_test::pi * light.radiance *
                   transport_test::polygon_irradiance(seen->point, upwards, light.corners);
        });
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(8), .path = {.seed = 54}});
    transport_test::expect_picture(batches, known, GetParam().bias(0.03));
}

TEST(LuminaireSceneBySample, NothingLeaksPastACardCloseToALuminaire)
{
    const scenes::Scene scene = transport_test::our_scene("near_occluder");
    const ref::World world(scene, 72, 48);
    const Vec3 center = luminaire_of(scene).center;
    int umbra = 0;
    transport_test::for_every_sample(
        world, ref::trace_path, {.seed = 55}, 16,
        [&](const Line& line, const std::vector<Contribution>& all) {
            const auto seen = transport_test::first_seen(scene, line);
            const Vec3 from_axis = seen->point - center;
            const bool on_plane = seen->point.z < 1e-9;
            if (on_plane && std::max(std::abs(from_axis.x), std::abs(from_axis.y)) > 0.27 - 1e-9) return;
            ASSERT_EQ(sum_of(all), Rgb(0.0)); // umbra, card, or the luminaire's back
            umbra += on_plane ? 1 : 0;
        });
    EXPECT_GT(umbra, 500);
}

// The luminaire faces up from a bowl: paths of two edges light the ceiling and the inside of the bowl,
// and longer paths the whole room.
TEST(LuminaireSceneBySample, ACeilingLampLightsNothingElseDirectly)
{
    const scenes::Scene scene = transport_test::our_scene("ceiling_lamp");
    const ref::World world(scene, width, height);
    const Vec3 lamp = luminaire_of(scene).center;
    int elsewhere = 0;
    int indirectly_lit = 0;
    transport_test::for_every_sample(
        world, ref::trace_path, {.seed = 56, .max_edges = 3}, 8,
        [&](const Line& line, const std::vector<Contribution>& all) {
            const auto seen = transport_test::first_seen(scene, line);
            const Vec3 from_lamp = seen->point - lamp;
            const bool ceiling = from_lamp.z > 1.0 - 1e-9;
            const bool bowl = from_lamp.z > -1e-9 && from_lamp.z < 0.25 + 1e-9 &&
                              std::max(std::abs(from_lamp.x), std::abs(from_lamp.y)) < 0.3 + 1e-9;
            if (ceiling || bowl) return;
            ++elsewhere;
            for (const Contribution& c : all) {
                ASSERT_GE(edges(c), 3);
                indirectly_lit += c.weight * c.value.x > 0.0 ? 1 : 0;
            }
        });
    EXPECT_GT(elsewhere, 1000);
    EXPECT_GT(indirectly_lit, 20);
}

TEST_P(LuminaireScene, ACeilingLampLightsTheCeilingDirectly)
{
    const scenes::Scene scene = transport_test::our_scene("ceiling_lamp");
    const ref::World world(scene, width, height);
    const Quadrangle lamp = luminaire_of(scene);
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(8), .path = {.seed = 57, .max_edges = 2}}, 3,
        by_edges);
    const auto known = transport_test::known_picture(
        *scene.camera, width, height, [&](const Line& line) -> std::optional<Rgb> {
            const auto seen = transport_test::first_seen(scene, line);
            const Vec3 from_lamp = seen->point - lamp.center;
            const double aside = std::max(std::abs(from_lamp.x), std::abs(from_lamp.y));
            if (from_lamp.z > 1.0 - 1e-9) {
                if (aside > 1.56) return Rgb(0.0);
                if (aside > 0.84) return std::nullopt;
                return transport_test::albedo_at(scene, *seen) / transport_test::pi * lamp.radiance *
                       transport_test::polygon_irradiance(seen->point, upwards, lamp.corners);
            }
            if (from_lamp.z > -1e-9 && aside < 0.3 + 1e-9) return std::nullopt; // the bowl
            return Rgb(0.0);
        });
    transport_test::expect_picture(batches[2], known, GetParam().bias(0.03), 1);
}

// All light in the first room has passed through the slit, after a bounce behind it.
TEST(LuminaireSceneBySample, BehindADoorThatIsAjarThereIsNoDirectLight)
{
    const scenes::Scene scene = transport_test::our_scene("door_ajar");
    const ref::World world(scene, width, height);
    int in_first_room = 0;
    int through_slit = 0;
    int indirectly_lit = 0;
    transport_test::for_every_sample(world, ref::trace_path, {.seed = 58, .max_edges = 4}, 32,
                                     [&](const Line& line, const std::vector<Contribution>& all) {
                                         const auto seen = transport_test::first_seen(scene, line);
                                         ASSERT_TRUE(seen);
                                         for (const Contribution& c : all) {
                                             if (c.weight * c.value.x == 0.0) continue;
                                             if (seen->point.y > 2.0 + 1e-9) {
                                                 through_slit += edges(c) == 2 ? 1 : 0;
                                                 continue;
                                             }
                                             ASSERT_GE(edges(c), 3);
                                             ++indirectly_lit;
                                         }
                                         in_first_room += seen->point.y <= 2.0 ? 1 : 0;
                                     });
    EXPECT_GT(in_first_room, 10000);
    EXPECT_GT(through_slit, 20);
    EXPECT_GT(indirectly_lit, 20);
}

// The luminaire of a Cornell box has radiance L where the eye sees it, and 0.9 L in the mirror: in
// every sample, exactly.
TEST(LuminaireSceneBySample, ALuminaireIsAsBrightAsItSaysAndInAMirrorAsThatReflects)
{
    const scenes::Scene scene = transport_test::our_scene("cornell_glass");
    const ref::World world(scene, 90, 60);
    const Rgb radiance = luminaire_of(scene).radiance;
    int seen_directly = 0;
    int seen_in_mirror = 0;
    transport_test::for_every_sample(
        world, ref::trace_path, {.seed = 59, .max_edges = 2}, 8,
        [&](const Line& line, const std::vector<Contribution>& all) {
            const auto seen = transport_test::first_seen(scene, line);
            if (transport_test::is<scenes::Emission>(scene, seen)) {
                ++seen_directly;
                ASSERT_EQ(sum_of(all), radiance);
            }
            if (!transport_test::is<scenes::Mirror>(scene, seen)) return;
            const auto behind =
                transport_test::first_seen(scene, transport_test::reflected(line, *seen));
            const bool lit = transport_test::is<scenes::Emission>(scene, behind);
            seen_in_mirror += lit ? 1 : 0;
            for (int i = 0; i < 3; ++i) // one rounded product
                ASSERT_NEAR(sum_of(all)[i], lit ? 0.9 * radiance[i] : 0.0, 1e-14);
        });
    EXPECT_GT(seen_directly, 100);
    EXPECT_GT(seen_in_mirror, 10);
}

} // namespace
