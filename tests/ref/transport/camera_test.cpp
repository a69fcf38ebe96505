#include "ref/transport/camera.h"
#include "ref/transport/world.h"
#include "tests/ref/transport/chi_squared.h"
#include "tests/ref/transport/generators.h"
#include "tests/ref/transport/random_scene.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <numbers>

namespace {

using ref::Camera;
using ref::Vec3;

/// A camera that looks along a direction with no special coordinate.
scenes::Camera oblique(double fov, scenes::FovAxis axis)
{
    return {Vec3(0.3, -0.2, 0.5),
            Vec3(0.8, 0.6, 0.0),
            Vec3(-0.36, 0.48, 0.8),
            Vec3(0.48, -0.64, 0.6),
            axis,
            fov};
}

struct View {
    double fov;
    scenes::FovAxis axis;
    int width, height;
};
const View views[] = {{0.6, scenes::FovAxis::horizontal, 30, 20},
                      {1.4, scenes::FovAxis::vertical, 30, 20},
                      {2.0, scenes::FovAxis::horizontal, 10, 14}};

// At the edges of a wide picture the cosine is c = cos(fov / 2): the roundoff of a direction moves the
// film point by 1 / c^2 half widths.
RC_GTEST_PROP(Camera, ProjectsARayBackToItsFilmPoint, ()) // map: camera-projection
{
    const View view = *rc::gen::elementOf(std::vector<View>(std::begin(views), std::end(views)));
    const Camera camera(oblique(view.fov, view.axis), view.width, view.height);
    const glm::dvec2 film(view.width * *transport_test::any_unit(),
                          view.height * *transport_test::any_unit());
    const auto ray = camera.ray(film);
    RC_ASSERT(std::abs(glm::length(ray.direction) - 1.0) < 1e-15);
    RC_ASSERT(ray.origin == camera.eye());
    const auto back = camera.project(ray.direction);
    RC_ASSERT(back.has_value());
    const double c = camera.cosine(ray.direction);
    RC_ASSERT(glm::length(*back - film) <= 16 * 0x1p-53 * 30 / (c * c));
}

// The corners of the picture by their angles: the field of view has the given size, up is up, and
// right is right.
TEST(Camera, SeesTheFieldOfViewThatItIsGiven) // map: camera-ray
{
    for (const View& view : views) {
        const auto data = oblique(view.fov, view.axis);
        const Camera camera(data, view.width, view.height);
        const bool horizontal = view.axis == scenes::FovAxis::horizontal;
        const Vec3 edge = horizontal ? camera.ray({view.width, view.height / 2.0}).direction
                                     : camera.ray({view.width / 2.0, 0.0}).direction;
        EXPECT_NEAR(glm::dot(edge, -data.backward), std::cos(view.fov / 2), 1e-15);
        EXPECT_NEAR(glm::dot(edge, horizontal ? data.right : data.up), std::sin(view.fov / 2), 1e-15);
        // square pixels
        const Vec3 corner = camera.ray({view.width, 0.0}).direction;
        EXPECT_NEAR(glm::dot(corner, data.right) / glm::dot(corner, data.up),
                    static_cast<double>(view.width) / view.height, 1e-13);
    }
}

TEST(Camera, SeesNothingBehindItNorBesideThePicture)
{
    const auto data = oblique(2.4, scenes::FovAxis::horizontal);
    const Camera camera(data, 7, 23);
    EXPECT_FALSE(camera.project(data.backward).has_value());
    for (const Vec3& side : {data.right, data.up, -data.right, -data.up}) {
        EXPECT_FALSE(camera.project(side).has_value());
        EXPECT_FALSE(camera.project(glm::normalize(0.01 * side + data.backward)).has_value());
    }
    // A relative distance of 1e-12 outside and inside each edge.
    const auto around = [&](double x, double y) {
        return camera.project(camera.ray({x, y}).direction).has_value();
    };
    const double tiny = 23e-12;
    EXPECT_TRUE(around(tiny, 10.0));
    EXPECT_FALSE(around(-tiny, 10.0));
    EXPECT_TRUE(around(7.0 - tiny, 10.0));
    EXPECT_FALSE(around(7.0 + tiny, 10.0));
    EXPECT_TRUE(around(3.0, tiny));
    EXPECT_FALSE(around(3.0, -tiny));
    EXPECT_TRUE(around(3.0, 23.0 - tiny));
    EXPECT_FALSE(around(3.0, 23.0 + tiny));
}

// The integer part of a film point is its pixel, and the fraction the position in it; rows are counted
// from the top.
TEST(Camera, CountsPixelsFromTheTopLeft)
{
    const auto data = oblique(1.0, scenes::FovAxis::horizontal);
    const Camera camera(data, 30, 20);
    const Vec3 up_left = glm::normalize(-data.backward - 0.2 * data.right + 0.1 * data.up);
    const auto film = camera.project(up_left);
    ASSERT_TRUE(film.has_value());
    const double half = std::tan(0.5);
    EXPECT_NEAR(film->x, 15 * (1 - 0.2 / half), 1e-13);
    EXPECT_NEAR(film->y, 10 * (1 - 0.1 / (half * 20 / 30)), 1e-13);
}

// Uniform and independent in both directions: the moments E x^2 = E y^2 = 1/3 and E x y = 1/4 have
// standard deviations of sqrt(4/45) and sqrt(7/144) over the root of the number of samples. Five of them
// are allowed; the centre of the pixel for all samples, or one number for both directions, is 16 and
// more away.
TEST(CameraRay, PassesThroughAUniformPointOfItsPixel) // map: film-position
{
    scenes::Scene scene;
    scene.camera = oblique(1.0, scenes::FovAxis::horizontal);
    const ref::World world(scene, 7, 5);
    constexpr std::uint32_t samples = 100;
    constexpr std::uint32_t pixels = 7 * 5;
    Vec3 moments(0.0);
    for (std::uint32_t i = 0; i < samples * pixels; ++i) {
        const std::uint32_t pixel = i / samples;
        const auto film = world.camera.project(camera_ray(world, {3, pixel, i % samples}).direction);
        ASSERT_TRUE(film.has_value());
        const glm::dvec2 in_pixel = *film - glm::dvec2(pixel % 7, pixel / 7);
        ASSERT_TRUE(in_pixel.x > 0 && in_pixel.x < 1 && in_pixel.y > 0 && in_pixel.y < 1) << i;
        moments += Vec3(in_pixel.x * in_pixel.x, in_pixel.y * in_pixel.y, in_pixel.x * in_pixel.y);
    }
    const double five = 5.0 / std::sqrt(samples * pixels);
    moments /= samples * pixels;
    EXPECT_NEAR(moments.x, 1.0 / 3.0, five * std::sqrt(4.0 / 45.0));
    EXPECT_NEAR(moments.y, 1.0 / 3.0, five * std::sqrt(4.0 / 45.0));
    EXPECT_NEAR(moments.z, 0.25, five * std::sqrt(7.0 / 144.0));
}

/// The integral over the directions of the picture, by midpoints in the spherical angles around the
/// camera's axis. Of the camera it uses only whether a direction is in the picture.
template <class Function>
double over_the_picture(const Camera& camera, const scenes::Camera& data, Function f)
{
    constexpr int steps = 1600;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double z = (i + 0.5) / steps; // cosine to the axis
        for (int k = 0; k < steps; ++k) {
            const double phi = 2 * std::numbers::pi * (k + 0.5) / steps;
            const Vec3 w = -z * data.backward +
                           std::sqrt(1 - z * z) * (std::cos(phi) * data.right + std::sin(phi) * data.up);
            if (camera.project(w)) sum += f(w);
        }
    }
    return sum * 2 * std::numbers::pi / (static_cast<double>(steps) * steps);
}

// pdf and W_e cos are 1 / (A c^3). At the border of the picture the midpoint rule has an error of less
// than one cell, at each of about 2 x 1600 cells, and errors of both signs cancel. The tolerance of
// 1e-3 is 20 times the observed error; a wrong power of the cosine or a missing area is 5% and more.
TEST(Camera, DensityAndImportanceIntegrateToOne) // map: importance, camera-density
{
    for (const View& view : views) {
        const auto data = oblique(view.fov, view.axis);
        const Camera camera(data, view.width, view.height);
        EXPECT_NEAR(
            over_the_picture(camera, data, [&](const Vec3& w) { return camera.pdf_solid_angle(w); }),
            1.0, 1e-3);
        // W_e measures the flux through the pinhole, whose normal is tilted to the ray.
        EXPECT_NEAR(over_the_picture(camera, data,
                                     [&](const Vec3& w) {
                                         return camera.importance(w) * -glm::dot(w, data.backward);
                                     }),
                    1.0, 1e-3);
    }
}

// Uniform film points over the whole picture give directions with the camera's density: on the unit
// square of (1 - z, phi), equal in area, as far from the axis as the picture extends.
TEST(Camera, DirectionsFollowTheirDensity) // map: camera-density
{
    for (const View& view : views) {
        const auto data = oblique(view.fov, view.axis);
        const Camera camera(data, view.width, view.height);
        const double reach = 1.0 - camera.cosine(camera.ray({0.0, 0.0}).direction);
        constexpr double two_pi = 2 * std::numbers::pi;
        const auto sample = [&](const ref::Uniforms& u) {
            const Vec3 w = camera.ray({u[0] * view.width, u[1] * view.height}).direction;
            const double phi = std::atan2(glm::dot(w, data.up), glm::dot(w, data.right));
            return std::optional(glm::dvec2((1.0 + glm::dot(w, data.backward)) / reach,
                                            (phi < 0.0 ? phi + two_pi : phi) / two_pi));
        };
        const auto density = [&](const glm::dvec2& p) {
            const double z = 1.0 - reach * p.x;
            const double phi = two_pi * p.y;
            const Vec3 w = -z * data.backward +
                           std::sqrt(1 - z * z) * (std::cos(phi) * data.right + std::sin(phi) * data.up);
            return camera.project(w) ? reach * two_pi * camera.pdf_solid_angle(w) : 0.0;
        };
        transport_test::expect_samples_follow_density(sample, density, transport_test::coarse, 100);
        transport_test::expect_samples_follow_density(sample, density, transport_test::fine, 30);
    }
}

} // namespace
