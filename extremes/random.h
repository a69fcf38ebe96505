#pragma once

// Random cases. One seed gives the same cases to every method, so that methods differ by what they
// compute and not by what they are given.

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace extremes {

class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    [[nodiscard]] std::uint64_t bits() { return engine_(); }
    /// In [0, 1), a multiple of 2^-53.
    [[nodiscard]] double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
    [[nodiscard]] double between(double lower, double upper)
    {
        return lower + (upper - lower) * uniform();
    }
    /// Between two positive numbers, with a uniform logarithm.
    [[nodiscard]] double log_between(double lower, double upper)
    {
        return lower * std::pow(upper / lower, uniform());
    }
    [[nodiscard]] double sign() { return (engine_() & 1) != 0 ? 1.0 : -1.0; }
    /// Below `count`, which must be at least 1.
    [[nodiscard]] std::uint64_t below(std::uint64_t count)
    {
        return std::uniform_int_distribution<std::uint64_t>(0, count - 1)(engine_);
    }
    /// Uniform on the unit sphere, up to rounding.
    [[nodiscard]] glm::dvec3 direction()
    {
        const double z = between(-1.0, 1.0);
        const double phi = 2.0 * std::numbers::pi * uniform();
        const double r = std::sqrt(1.0 - z * z);
        return {r * std::cos(phi), r * std::sin(phi), z};
    }

    /// Whether both give the same numbers from now on.
    friend bool operator==(const Random&, const Random&) = default;

private:
    std::mt19937_64 engine_;
};

} // namespace extremes
