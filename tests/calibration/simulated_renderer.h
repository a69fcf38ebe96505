#pragma once

// A renderer of which everything is known: a picture, times noise of mean 1 whose tail can be chosen.
// What it takes hours to render it draws in seconds, as often as the rates of errors need.

#include "images/image.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace calibration {

/// How the samples of a pixel are distributed around its mean.
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

/// What is wrong with a picture: factors on the brightness of parts of it.
struct Bias {
    double everywhere = 1.0;
    double in_caustic = 1.0;
    double in_shadow = 1.0;
};

/// Draws batches of 4 samples per pixel of a picture with a gradient, a quarter in shadow, a caustic on
/// 3% of the pixels and a black corner. In the shadow half of the samples find no light, in the caustic
/// 90% (so their noise is larger), as happens to shadow rays and to paths that must hit a small lamp.
class SimulatedRenderer {
public:
    SimulatedRenderer(int size, Noise noise);

    /// Batch number `batch` of the render with this seed. Red and green have the same noise, as under
    /// white light; that of blue is independent.
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
    /// By part: means of four samples, as many as make a fair population; its mean is exactly 1.
    std::array<std::vector<float>, 3> population_;
};

/// Random words as a function of their place [Steele et al. 2014].
inline std::uint64_t mix(std::uint64_t x)
{
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
}

} // namespace calibration
