// Very bright and very dim light.

#include "extremes/axes/axes.h"
#include "extremes/light/small_render.h"

#include "scenes/placed.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace extremes {

namespace {

constexpr int pixels_of_radiance = 8; // along each side
constexpr double albedo_of_radiance = 0.5;

/// What emits the light: a sky around a sphere, a square lamp over a floor, or a point light over it.
enum class Lit { by_sky, by_lamp, by_point };

void add_square(scenes::Scene& scene, double half, double z, bool up, std::uint32_t material)
{
    const scenes::Vec3 a(-half, -half, z);
    const scenes::Vec3 b(half, -half, z);
    const scenes::Vec3 c(half, half, z);
    const scenes::Vec3 d(-half, half, z);
    scene.triangles.push_back({up ? std::array{a, b, c} : std::array{a, c, b}, material});
    scene.triangles.push_back({up ? std::array{a, c, d} : std::array{a, d, c}, material});
}

/// A scene about one unit large, so that scenes::placed does not scale it. The eye is above it.
scenes::Scene lit_scene(Lit lit, double radiance)
{
    scenes::Scene scene;
    scene.name = "light";
    scene.materials = {scenes::Lambertian{scenes::Rgb(albedo_of_radiance)},
                       scenes::Emission{scenes::Rgb(radiance)}};
    scene.material_names = {"grey", "lamp"};
    if (lit == Lit::by_sky) {
        scene.spheres = {{scenes::Vec3(0), 0.5, 0}};
        scene.environment = scenes::Rgb(radiance);
    } else {
        add_square(scene, 0.5, 0, true, 0);
        if (lit == Lit::by_lamp)
            add_square(scene, 0.2, 0.7, false, 1);
        else
            scene.point_lights = {{scenes::Vec3(0.1, 0.2, 0.7), scenes::Rgb(radiance)}};
    }
    if (lit != Lit::by_lamp) {
        scene.materials.pop_back();
        scene.material_names.pop_back();
    }
    // From beside the lamp down to the middle: all pixels see the sphere or the floor.
    const double tilt = lit == Lit::by_sky ? 0.0 : 0.4;
    const scenes::Vec3 backward(std::sin(tilt), 0, std::cos(tilt));
    scene.camera = scenes::Camera{
        1.2 * backward, scenes::Vec3(0, 1, 0),       scenes::Vec3(-std::cos(tilt), 0, std::sin(tilt)),
        backward,       scenes::FovAxis::horizontal, 0.4};
    return scene;
}

/// Whether the mean of the pixels, which are independent, differs from `truth` by more than 6 of its
/// standard errors.
bool is_biased(const images::Image& image, double truth)
{
    double sum = 0;
    double squares = 0;
    for (const images::Rgb& pixel : image.pixels) {
        const double value = pixel.r / truth - 1;
        sum += value;
        squares += value * value;
    }
    const auto n = static_cast<double>(image.pixels.size());
    const double mean = sum / n;
    return mean * mean > 36 * (squares / n - mean * mean) / (n - 1) + 1e-12;
}

void compare_radiance(const images::Image& image, const images::Image& one, double radiance,
                      Tally& tally)
{
    double largest = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            const double expected = one.pixels[i][channel];
            const double value = image.pixels[i][channel];
            if (!std::isfinite(value)) return tally.add(Failure::not_finite);
            if (expected > 0 && value == 0) return tally.add(Failure::missed);
            if (expected > 0) largest = std::max(largest, std::abs(value / radiance / expected - 1));
        }
    tally.add(largest);
}

auto radiance_cases(Wing wing, bool checked)
{
    return [wing, checked](double parameter, Random& random, int cases, Tally& tally) {
        // A power of two: all products are those of radiance 1, scaled exactly.
        const double radiance = std::exp2(std::round(std::log2(parameter)));
        for (int i = 0; i < cases; ++i) {
            const auto lit = static_cast<Lit>(random.below(3));
            images::RenderOptions options;
            options.integrator =
                random.below(2) == 0 ? images::Integrator::path : images::Integrator::bdpt;
            options.max_edges = 4;
            options.batch_size = 8;
            options.seed = random.bits();
            judge_small_render(tally, [&] {
                scenes::Scene scene = lit_scene(lit, radiance);
                if (checked) scene = scenes::placed(scene);
                const images::Image image = small_render(wing, scene, pixels_of_radiance, options);
                const images::Image one =
                    small_render(wing, lit_scene(lit, 1.0), pixels_of_radiance, options);
                if (lit == Lit::by_sky && is_biased(one, albedo_of_radiance))
                    tally.add(Failure::biased);
                else
                    compare_radiance(image, one, radiance, tally);
            });
        }
    };
}

// A factor of 2^k changes no digit of a product or a sum, except of results below 2^-126 or above 2^128.
// Up to 2^99 nothing overflows. The weight of a light walk is at most 4 pi^2 R^2 L / p < 2^8 L: R <= 1
// is the radius of the scene and p >= 1/2 the probability of one of at most two emitters. The rest of a
// path adds cosines, albedos and 1 / d^2, and no two points that see each other here are closer than
// 2^-8. (In a corner they may be: from a distance of 2^-12 on, a connection of bidirectional path
// tracing overflows, and is left out with a notice.) From 1 on nothing is below 2^-126 either: a
// contribution is a product of L and of at most four cosines, none less than 2^-24. In single precision
// and with less light, a contribution below 2^-126 (less than 2^-27 of the light) is rounded anew, and
// each of the sums of a pixel may round to the next float: 8 samples of up to 12 strategies. The picture
// of the reference is a double until it is stored, and no pixel is that dark.
double bound_of_radiance(Format format, double radiance)
{
    return format == Format::binary64 || radiance >= 1 ? 0 : 96 * 0x1p-24;
}

} // namespace

Axis radiance_axis()
{
    Axis axis;
    axis.number = 9;
    axis.name = "radiance";
    axis.title = "Radiance of the light";
    axis.parameter = "radiance (W/m2/sr), irradiance or intensity of the light; a power of two";
    axis.about = "A case is a small picture by path tracing or by bidirectional path tracing: of a "
                 "sphere under a sky, or "
                 "of a floor under a square lamp or a point light. The values are rounded to powers of "
                 "two, so that "
                 "the truth is the picture for light of 1 times the parameter, without any noise; and "
                 "that picture "
                 "itself must agree with the closed form (albedo times radiance, for the sphere) within "
                 "6 standard "
                 "errors. The error is the largest of all pixels, relative to the pixel. A black pixel "
                 "is a miss.";
    axis.ordinary = 1;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-300, -60, 30);
    for (const double value : powers_of_ten(-50, 50, 2)) axis.values.push_back(value);
    for (const double value : powers_of_ten(60, 300, 30)) axis.values.push_back(value);
    axis.most_cases = 1000;
    for (const Wing wing : wings())
        axis.methods.push_back({name_of(wing), format_of(wing), radiance_cases(wing, true)});
    axis.methods.push_back({"not refused (double)", Format::binary64, radiance_cases(Wing::ref, false)});
    axis.methods.push_back({"not refused (float)", Format::binary32, radiance_cases(Wing::host, false)});
    for (const auto& [method, format] :
         {std::pair("ref", Format::binary64), std::pair("host", Format::binary32)}) {
        const auto bound = [format = format](double x) { return bound_of_radiance(format, x); };
        axis.limits.push_back(
            {method, 0x1p99, bound, 0x1p100, Failure::refused,
             "light above 1e30 is refused: a float ends at 3.4e38, and sampling multiplies "
             "light by areas and divides it by probabilities"});
        axis.limits.push_back(
            {method, 0x1p-99, bound, 0x1p-100, Failure::refused,
             "light below 1e-30 is refused: floats lose digits below 1.2e-38, and parts of "
             "a picture are darker than its light"});
    }
    return axis;
}

} // namespace extremes
