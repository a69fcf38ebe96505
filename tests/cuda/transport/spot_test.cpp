// Spot lights from wide to very narrow, and from constant to very peaked, compared with a closed form.
//
// A spot is at height h straight over a Lambertian plane of albedo rho, and a pinhole on the same
// axis, at height H, looks down. A point of the plane that the spot sees at angle theta from the axis
// has the radiance rho/pi I cos(theta)^(n+3) / h^2. It lies at r = h tan(theta) from the axis, on the
// film at r/H. With A the area of the film at distance 1, which contains everything that is lit, and t
// = cos(theta),
//
//   mean of the picture = rho/pi I / (h^2 H^2 A) int cos^(n+3) 2 pi r dr
//                       = rho/pi I / (H^2 A) 2 pi int_c^1 t^n dt = rho I Omega / (pi H^2 A),
//
// where Omega is the integral of t^n over the cone, 2 pi (1 - c^(n+1)) / (n+1). I is chosen so that
// the mean is 1.
//
// The difference between the fast path and 1 may be, besides noise:
// 1. Fewer than 100 roundings of factors: 100 u = 6e-6, u = 2^-24. The uniform numbers of 24 bits,
//    from which the directions of a peaked lobe are sampled: 1.3e-5 (versine_cutoff in
//    scene_arrays.cpp). Together 2e-5 is allowed.
// 2. Directions are rounded to a grid of about u. Each grid point is in the cone, of half angle a, or
//    not; so errors add up only along the rim. A circle of radius a/u grid steps holds as many points
//    as its area, up to about (a/u)^(2/3) [van der Corput]. The relative error is (u/a)^(4/3); 2
//    (u/a)^(4/3) is allowed. The directions of the film are rounded in the same way. For a peaked
//    lobe, its width 1/sqrt(n) takes the place of a.
// 3. The lengths of unit vectors are rounded: (8 u / a)^2 of the versine (emitter.h).
// 4. The rounded axis is tilted by up to 1.5 u: the lit disc moves by as much, with no other effect.
//
// A comparison is a t test over independent batches. 7 standard errors with 31 degrees of freedom are
// exceeded by chance once in 10^7 times.

#include "cuda/launch/renderer.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/renderer.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

namespace {

using scenes::Vec3;

constexpr int size = 24;
constexpr std::uint64_t batches = 32;
constexpr double bound = 7;
using std::numbers::pi;
constexpr double roundoff = 0x1p-24;

struct Spot {
    double degrees; // of the whole cone
    double exponent;
    [[nodiscard]] double half_angle() const { return degrees * pi / 360; }
    /// 1 - cos of the half angle, without cancellation.
    [[nodiscard]] double cutoff() const { return 2 * std::pow(std::sin(half_angle() / 2), 2); }
    /// 1 - cos of the half angle or, if that is less, of the lobe: only e^-12 of the power is beyond
    /// it.
    [[nodiscard]] double edge() const { return std::min(cutoff(), -std::expm1(-12 / (exponent + 1))); }
    [[nodiscard]] double solid_angle() const
    {
        return -2 * pi * std::expm1((exponent + 1) * std::log1p(-cutoff())) / (exponent + 1);
    }
    [[nodiscard]] double tolerance() const
    {
        const double width = std::min(half_angle(), 1 / std::sqrt(exponent + 1));
        return 2e-5 + 2 * std::pow(roundoff / width, 4.0 / 3) + std::pow(8 * roundoff / width, 2);
    }
};

/// The axes are not close to any coordinate axis.
scenes::Scene spot_over_plane(const Spot& spot)
{
    const Vec3 normal = glm::normalize(Vec3(0.36, -0.48, 0.8));
    const Vec3 right = glm::normalize(glm::cross(normal, Vec3(0.3, 0.8, -0.5)));
    const Vec3 up = glm::cross(normal, right);
    scenes::Scene scene;
    constexpr double albedo = 0.75;
    scene.materials = {scenes::Lambertian{scenes::Rgb(albedo)}};
    const auto corner = [&](double x, double y) { return x * right + y * up; };
    const Vec3 a = corner(-1.5, -1.7); // no diagonal passes under the spot
    const Vec3 b = corner(1.9, -1.7);
    const Vec3 c = corner(1.9, 1.6);
    const Vec3 d = corner(-1.5, 1.6);
    scene.triangles = {{{a, b, c}, 0}, {{a, c, d}, 0}};

    constexpr double h = 1;
    constexpr double H = 1.25;
    const double tan_edge = std::sqrt(spot.edge() * (2 - spot.edge())) / (1 - spot.edge());
    const double half_width = 1.25 * tan_edge * h / H; // of the film at distance 1
    scene.camera = scenes::Camera{H * normal,
                                  right,
                                  glm::cross(normal, right),
                                  normal,
                                  scenes::FovAxis::horizontal,
                                  2 * std::atan(half_width)};
    const double intensity = pi * H * H * (4 * half_width * half_width) / (albedo * spot.solid_angle());
    scene.spot_lights = {
        {h * normal, -normal, scenes::Rgb(intensity), 1 - spot.cutoff(), spot.exponent}};
    return scene;
}

std::string name_of(fast::Integrator integrator)
{
    using enum fast::Integrator;
    return integrator == path ? "path" : integrator == bdpt ? "bdpt" : "light";
}

class Sums {
public:
    void add(const images::Image& image)
    {
        double sum = 0;
        for (const auto& pixel : image.pixels) sum += pixel.x + pixel.y + pixel.z;
        const double mean = sum / (3.0 * static_cast<double>(image.pixels.size()));
        ++count_;
        sum_ += mean - 1;
        squares_ += (mean - 1) * (mean - 1);
    }
    /// The mean of all pictures, minus 1.
    [[nodiscard]] double off() const { return sum_ / count_; }
    [[nodiscard]] double standard_error() const
    {
        return std::sqrt(std::max(0.0, squares_ / count_ - off() * off()) / (count_ - 1));
    }

private:
    double count_ = 0;
    double sum_ = 0;
    double squares_ = 0;
};

/// Renders pictures on the fast path.
Sums pictures(const scenes::Scene& scene, fast::Integrator integrator, std::uint32_t batch_size)
{
    images::RenderOptions options;
    options.integrator = integrator;
    options.max_edges = 2;
    options.seed = 5;
    options.batch_size = batch_size;
    const auto renderer = fast::host_renderer(scene, size, size, options, 2);
    Sums sums;
    for (std::uint64_t i = 0; i < batches; ++i) {
        const images::Batch batch = *renderer->render_batch(i, {});
        EXPECT_EQ(batch.dropped.count, 0u);
        sums.add(batch.mean);
    }
    return sums;
}

std::ostream& operator<<(std::ostream& out, const Spot& spot)
{
    return out << spot.degrees << " degrees, exponent " << spot.exponent;
}

class SpotLights : public testing::TestWithParam<Spot> {};

TEST_P(SpotLights, ShedThePowerOfTheirConeInEveryIntegrator) // map: emission-spot
{
    const Spot spot = GetParam();
    const scenes::Scene scene = spot_over_plane(spot);
    using enum fast::Integrator;
    for (const auto integrator : {path, bdpt, light}) {
        // Light walks are spread over the whole cone: many miss a lobe that is much narrower.
        const bool hard = integrator != path && spot.exponent > 0;
        const Sums sums = pictures(scene, integrator, hard ? 64 : 8);
        std::ostringstream found;
        found << name_of(integrator) << ": 1 + " << sums.off() << ", standard error "
              << sums.standard_error();
        RecordProperty(name_of(integrator), found.str());
        EXPECT_LT(std::abs(sums.off()), bound * sums.standard_error() + spot.tolerance()) << found.str();
        EXPECT_LT(sums.standard_error(), hard ? 0.015 : 0.002) << found.str(); // else a weak test
    }
}

INSTANTIATE_TEST_SUITE_P(FromWideToNarrow, SpotLights,
                         testing::Values(Spot{90, 0}, Spot{10, 0}, Spot{1, 0}, Spot{0.3, 0},
                                         Spot{0.1, 0}, Spot{0.02, 0}, Spot{0.01, 0}, Spot{0.002, 0},
                                         Spot{90, 8}, Spot{90, 1e4}, Spot{90, 1e7}, Spot{10, 1e3},
                                         Spot{1, 1e7}, Spot{0.6, 1e6}, Spot{0.02, 1e7},
                                         Spot{0.01, 1e9}));

/// The closed form itself, tested with the reference.
TEST(SpotLight, OfTheReferenceShedTheSame)
{
    for (const Spot& spot : {Spot{90, 8}, Spot{0.3, 0}, Spot{0.01, 0}, Spot{0.6, 1e6}}) {
        const scenes::Scene scene = spot_over_plane(spot);
        const ref::World world(scene, size, size);
        const auto renderer = ref::renderer(world, ref::trace_path, {.seed = 5, .max_edges = 2});
        Sums sums;
        for (std::uint64_t i = 0; i < batches; ++i) sums.add(renderer->render_batch(i)->mean);
        EXPECT_LT(std::abs(sums.off()), bound * sums.standard_error() + 1e-6) << spot;
    }
}

std::string refusal_of(const Spot& spot)
{
    scenes::Scene scene = spot_over_plane(Spot{1, 0});
    scene.spot_lights.push_back(spot_over_plane(spot).spot_lights[0]);
    try {
        (void)fast::host_renderer(scene, 1, 1, {}, 1);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

// A spot that floats cannot represent is rejected with a message, and never renders black.
TEST(SpotLight, TooNarrowForFloatsAreRefused)
{
    EXPECT_EQ(refusal_of({0.00176, 0}), "");
    const std::string narrow = refusal_of({0.0017, 0});
    EXPECT_NE(narrow.find("spot light 2: a cone of 0.0017 degrees is too narrow"), std::string::npos)
        << narrow;
    EXPECT_EQ(narrow.find('\n'), std::string::npos);
    EXPECT_EQ(refusal_of({90, 4e9}), "");
    const std::string peaked = refusal_of({90, 1e10});
    EXPECT_NE(peaked.find("spot light 2: an exponent of 1e+10 is too large"), std::string::npos)
        << peaked;
    EXPECT_EQ(peaked.find('\n'), std::string::npos);
}

} // namespace
