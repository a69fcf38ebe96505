// mirror_image.dae: the whole picture in closed form, at all path lengths.

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

/// The data of the scene, and the radiance along a line from the eye for each length.
class MirrorImage : public transport_test::OfEveryIntegrator {
protected:
    const scenes::Scene scene = transport_test::our_scene("mirror_image");
    const scenes::Sphere& lamp = scene.spheres.at(0);
    const Rgb radiance = std::get<scenes::Emission>(scene.materials[lamp.material]).radiance;
    static constexpr double mirror_y = 1.4;
    const Vec3 image{lamp.center.x, 2.0 * mirror_y - lamp.center.y, lamp.center.z};

    [[nodiscard]] Rgb mirror_colour() const
    {
        for (const auto& material : scene.materials)
            if (const auto* mirror = std::get_if<scenes::Mirror>(&material)) return mirror->reflectance;
        return Rgb(0.0);
    }
    [[nodiscard]] Rgb diffusely_reflected(const transport_test::Seen& seen, const Vec3& center) const
    {
        return transport_test::albedo_at(scene, seen) / transport_test::pi * radiance *
               transport_test::sphere_irradiance(seen.point, {0.0, 0.0, 1.0}, center, lamp.radius);
    }
    /// Whether the sphere may be between `p` and some part of its own image: their cones overlap.
    [[nodiscard]] bool hides_its_image(const Vec3& p) const
    {
        const double d = glm::length(lamp.center - p);
        const double to_image = glm::length(image - p);
        const double between =
            std::acos(std::clamp(glm::dot(lamp.center - p, image - p) / (d * to_image), -1.0, 1.0));
        return between < std::asin(lamp.radius / d) + std::asin(lamp.radius / to_image);
    }
    /// The light of paths with `k` edges along `line`, on the side of the mirror where the eye is.
    [[nodiscard]] std::optional<Rgb> light(const Line& line, int k) const
    {
        const auto seen = transport_test::first_seen(scene, line);
        if (!seen || k < 1) return Rgb(0.0);
        if (transport_test::is<scenes::Emission>(scene, seen)) return k == 1 ? radiance : Rgb(0.0);
        if (transport_test::is<scenes::Mirror>(scene, seen)) {
            const auto behind = light(transport_test::reflected(line, *seen), k - 1);
            return behind ? std::optional(mirror_colour() * *behind) : std::nullopt;
        }
        if (k == 2) return diffusely_reflected(*seen, lamp.center);
        if (k == 3 && hides_its_image(seen->point)) return std::nullopt;
        return k == 3 ? mirror_colour() * diffusely_reflected(*seen, image) : Rgb(0.0);
    }
};

INSTANTIATE_TEST_SUITE_P(Integrators, MirrorImage, transport_test::integrators(),
                         transport_test::name_of);

TEST_P(MirrorImage, EachLengthIsKnown)
{
    const ref::World world(scene, width, height);
    constexpr int longest = 4;
    const auto batches = transport_test::estimate(
        world, GetParam().integrator,
        {.batches = 32, .batch_size = GetParam().samples(24), .path = {.seed = 51, .max_edges = 7}},
        longest + 2, [](const Contribution& c) { return std::min(edges(c), longest + 1); });
    // Light that reaches the surface by way of the mirror is a caustic, found only by hitting the
    // sphere.
    constexpr std::array specification = {0.0, 0.04, 0.04, 0.4, 0.5};
    for (int k = 1; k <= longest; ++k) {
        SCOPED_TRACE(std::to_string(k) + " edges");
        transport_test::expect_picture(
            batches[static_cast<std::size_t>(k)],
            transport_test::known_picture(*scene.camera, width, height,
                                          [&](const Line& line) { return light(line, k); }),
            GetParam().bias(specification.at(static_cast<std::size_t>(k))), k == 1 || k == 4 ? 1 : 2);
    }
    for (const auto& batch : batches[longest + 1]) // no path is longer
        EXPECT_EQ(batch, images::Image(width, height));
}

} // namespace
