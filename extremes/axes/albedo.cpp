// A closed room that absorbs hardly any light: how long must a walk be, and how does roulette end it?

#include "extremes/axes/axes.h"
#include "extremes/light/small_render.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace extremes {

namespace {

constexpr int pixels_of_albedo = 8; // along each side
constexpr int samples_of_albedo = 8;
constexpr double most_bounces_of_albedo = 1e7; // of a case

/// A sphere seen from inside, with a point light in its centre that makes the direct light, albedo / pi
/// times 1, the same everywhere. So all light of a walk is a sum of equal terms, times its throughput,
/// and the only noise is that of roulette.
scenes::Scene white_room(double albedo)
{
    scenes::Scene scene;
    scene.name = "room";
    scene.materials = {scenes::Lambertian{scenes::Rgb(albedo)}};
    scene.material_names = {"wall"};
    scene.spheres = {{scenes::Vec3(0), 1.0, 0}};
    scene.point_lights = {{scenes::Vec3(0), scenes::Rgb(1)}};
    scene.camera = scenes::Camera{
        {0.1, -0.5, 0.3}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, scenes::FovAxis::horizontal, 1.0};
    return scene;
}

/// Pixels by a renderer, in units of the direct light.
std::vector<double> rendered(Wing wing, double absorbed, std::uint64_t seed)
{
    images::RenderOptions options;
    options.integrator = images::Integrator::path;
    options.batch_size = samples_of_albedo;
    options.seed = seed;
    std::vector<double> pixels;
    const double direct = (1 - absorbed) * std::numbers::inv_pi;
    for (const images::Rgb& pixel :
         small_render(wing, white_room(1 - absorbed), pixels_of_albedo, options).pixels)
        pixels.push_back(pixel.r / direct);
    return pixels;
}

/// The same by walks without a scene: each goes on from the fifth bounce with the probability
/// `survival`.
std::vector<double> simulated(double absorbed, double survival, std::uint64_t seed)
{
    Random random(seed);
    std::vector<double> pixels;
    for (int pixel = 0; pixel < pixels_of_albedo * pixels_of_albedo; ++pixel) {
        double sum = 0;
        for (int i = 0; i < samples_of_albedo; ++i) {
            double throughput = 1;
            for (int bounce = 1;; ++bounce) {
                sum += throughput;
                const double chance = bounce < 5 ? 1 : survival;
                if (random.uniform() >= chance) break;
                throughput *= (1 - absorbed) / chance;
            }
        }
        pixels.push_back(sum / samples_of_albedo);
    }
    return pixels;
}

/// The truth is 1 / absorbed = 1 + albedo + albedo^2 + ...
void judge_albedo(const std::vector<double>& pixels, double absorbed, Tally& tally)
{
    const auto n = static_cast<double>(pixels.size());
    double sum = 0;
    double squares = 0;
    for (const double pixel : pixels) {
        const double value = pixel * absorbed - 1;
        sum += value;
        squares += value * value;
    }
    const double mean = sum / n;
    const double standard_error = std::sqrt((squares / n - mean * mean) / (n - 1));
    if (!std::isfinite(mean)) return tally.add(Failure::not_finite);
    if (std::abs(mean) > 6 * standard_error) return tally.add(Failure::biased);
    tally.add(0.0);
}

using Walks = std::function<std::vector<double>(double absorbed, std::uint64_t seed)>;

auto albedo_cases(const Walks& walks, double (*bounces)(double absorbed))
{
    return [walks, bounces](double absorbed, Random& random, int cases, Tally& tally) {
        for (int i = 0; i < cases; ++i) {
            const std::uint64_t seed = random.bits();
            if (bounces(absorbed) * pixels_of_albedo * pixels_of_albedo * samples_of_albedo >
                most_bounces_of_albedo)
                tally.add(Failure::endless);
            else
                judge_albedo(walks(absorbed, seed), absorbed, tally);
        }
    };
}

/// The mean number of bounces of a walk that roulette ends at 1 - albedo, and at least at 1 -
/// `survival`.
template <int per_mille>
double at_survival(double absorbed)
{
    return 5 + 1 / std::max(absorbed, 1 - per_mille / 1000.0);
}

} // namespace

Axis albedo_axis()
{
    Axis axis;
    axis.number = 10;
    axis.name = "albedo";
    axis.title = "Albedo of a closed room";
    axis.parameter = "1 - albedo";
    axis.about =
        "A white sphere from inside, lit by a point light in its centre; paths of any length. A case is "
        "the mean of 512 samples. It is biased if it differs from the truth, the sum of a geometric "
        "series, by "
        "more than 6 of its standard errors. Nothing else is counted: the error of all other cases is "
        "0. "
        "The two methods without a renderer draw only the lengths of walks and their throughput.";
    axis.ordinary = 0.5;
    axis.logarithmic = true;
    axis.values = powers_of_ten(-6, -2, 0.5);
    for (const double value : {0.02, 0.025, 0.03, 0.05, 0.1, 0.2, 0.5}) axis.values.push_back(value);
    axis.most_cases = 15;
    for (const Wing wing : wings())
        axis.methods.push_back(
            {name_of(wing), format_of(wing),
             albedo_cases(
                 [wing](double absorbed, std::uint64_t seed) { return rendered(wing, absorbed, seed); },
                 at_survival<999>)});
    axis.methods.push_back({"survival min(0.95, albedo)", Format::binary64,
                            albedo_cases(
                                [](double absorbed, std::uint64_t seed) {
                                    return simulated(absorbed, std::min(0.95, 1 - absorbed), seed);
                                },
                                at_survival<950>)});
    axis.methods.push_back(
        {"survival = albedo", Format::binary64,
         albedo_cases(
             [](double absorbed, std::uint64_t seed) { return simulated(absorbed, 1 - absorbed, seed); },
             at_survival<1000>)});
    // No error, and 6 standard errors of 64 independent means: exceeded in one case of 10^7.
    for (const char* method : {"ref", "host"})
        axis.limits.push_back({method, 0.001, [](double) { return 0.0; }, 1e-4, Failure::biased,
                               "roulette lets a walk go on with the probability min(0.999, albedo): "
                               "above 0.999 its throughput grows by albedo / 0.999 at each bounce, and "
                               "from sqrt(0.999) = 0.9995 on its variance is infinite"});
    axis.derivation =
        "a walk survives $n$ bounces with the probability $q^n$, $q = \\min(q_{max}, \\rho)$, and then "
        "has the throughput $(\\rho / q)^n$. Up to $\\rho = q_{max}$ it stays constant, and all moments "
        "are finite. Beyond, the second moment $\\sum (\\rho^2 / q_{max})^n$ is infinite where "
        "$\\rho^2 \\ge q_{max}$, and the probability of a throughput above $t$ falls only as $t^{-a}$ "
        "with "
        "$a = \\ln (1 / q_{max}) / \\ln (\\rho / q_{max})$. For $q_{max} = 0.95$ it is 2 at "
        "$\\rho = 0.975$, 1.25 at 0.99, and 1.02 at 0.999; for $q_{max} = 0.999$ it is 2 at 0.9995 and "
        "1.11 at 0.9999. Means of any practical number of samples are then too low, and so are their "
        "standard errors.";
    return axis;
}

} // namespace extremes
