#pragma once

// A simulated renderer with known truth: a picture, times noise of mean 1 with a chosen tail. It draws
// in seconds pictures whose rendering would take hours, so that rates of errors can be measured.

#include "images/image.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace calibration {

/// The distribution of the samples of a pixel around its mean.
enum class Noise {
    lognormal,  // relative standard deviation 1
    gamma,      // relative standard deviation 1, a thin tail
    pareto_25,  // tail exponent 2.5: a variance, but no third moment
    pareto_20,  // 2.0: the variance diverges slowly
    pareto_15,  // 1.5: no variance
    rare_bright // lognormal, and one sample in ten thousand is 100 times as bright
};
inline constexpr std::array noises = {Noise::lognormal, Noise::gamma,     Noise::pareto_25,
                                      Noise::pareto_20, Noise::pareto_15, Noise::rare_bright};
std::string name(Noise noise);

/// The error of a wrong picture: factors on the brightness of its parts.
struct Bias {
    double everywhere = 1.0;
    double in_caustic = 1.0;
    double in_shadow = 1.0;
};

/// Where the parts of the picture are, in units of its width, and how hard their light is to find.
struct Layout {
    double shadow_left = 0.0, shadow_right = 0.5, shadow_top = 0.5, shadow_bottom = 1.0;
    double caustic_x = 0.7, caustic_y = 0.7;
    double caustic_share = 0.03;     // of all pixels
    double caustic_brightness = 3.0; // times what is around it
    double light_in_shadow = 0.5;    // share of the samples that find light
    double light_in_caustic = 0.1;
};
/// Layouts on which no level or weight of the comparison was chosen.
inline constexpr std::array fresh_layouts = {
    Layout{0.6, 0.9, 0.1, 0.4, 0.3, 0.35, 0.05, 2.0, 0.3, 0.15},
    Layout{0.1, 1.0, 0.8, 0.95, 0.55, 0.3, 0.02, 6.0, 0.7, 0.2},
};

/// Draws batches of 4 samples per pixel of a picture with a gradient, a quarter in shadow, a caustic on
/// 3% of the pixels and a black corner, unless the layout says otherwise. In the shadow 50% of the
/// samples find no light, in the caustic 90%, so their noise is larger. This is how shadow rays, and
/// paths that must hit a small lamp, behave.
class SimulatedRenderer {
public:
    /// `population`: another number draws the populations of samples anew.
    SimulatedRenderer(int size, Noise noise, const Layout& layout = {}, std::uint64_t population = 0);

    /// Batch number `batch` of the render with this seed. Red and green have the same noise, as under
    /// white light; the noise of blue is independent.
    [[nodiscard]] images::Image render(std::uint64_t seed, std::uint64_t batch,
                                       const Bias& bias = {}) const;

private:
    enum Part : std::uint8_t { lit, shadow, caustic, black };
    struct Place {
        Part part;
        images::Rgb mean;
    };
    int size_;
    std::vector<Place> places_;
    /// By part: a large population of means of four samples. The mean of the population is exactly 1.
    std::array<std::vector<float>, 3> population_;
};

/// A random word as a function of its position [Steele et al. 2014].
inline std::uint64_t mix(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

} // namespace calibration
