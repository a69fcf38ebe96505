// Compares a fixed distance with an error bound for rays that leave a surface, at several scene scales.
// In single precision, where the difference is large: a sphere of radius 1 at distance 10 from the
// origin, all lengths times the scale.
// Usage: figure_epsilon --help

#include "docs/figures/program.h"
#include "ref/transport/sampling.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>

namespace {

using Vec3f = glm::vec3;
constexpr float unit_roundoff = std::numeric_limits<float>::epsilon() / 2;

/// The smallest t > 0 at which the ray meets the sphere, as a careful float renderer computes it.
std::optional<float> intersect(const Vec3f& origin, const Vec3f& d, const Vec3f& center, float radius)
{
    const Vec3f f = origin - center;
    const float b = -glm::dot(f, d);
    const Vec3f l = f + b * d;
    const float discriminant = radius * radius - glm::dot(l, l);
    if (discriminant < 0) return std::nullopt;
    const float q = b + std::copysign(std::sqrt(discriminant), b);
    const float c = glm::dot(f, f) - radius * radius;
    const float t0 = std::min(c / q, q);
    const float t1 = std::max(c / q, q);
    if (t0 > 0) return t0;
    if (t1 > 0) return t1;
    return std::nullopt;
}

struct Outcome {
    double meets_itself = 0.0; // share of outward rays that hit the sphere again: dark specks and rings
    double misses = 0.0;       // share that start beyond a plate at radius / 100 above: light leaks
};

/// `epsilon` < 0: no fixed distance along the ray, but the bound of ref/trees/geometry.cpp along the
/// normal, with the unit roundoff of float: gamma_5 r for the point, and 2 |p| + 16 D (D the diagonal).
Outcome measure(float scale, float epsilon)
{
    const float radius = scale;
    const Vec3f center = scale * Vec3f(6.0F, -5.0F, 6.2F);
    std::mt19937 random(1); // fixed, so that the table can be reproduced
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    Outcome outcome;
    constexpr int count = 400'000;
    for (int i = 0; i < count; ++i) {
        const auto next = [&] { return uniform(random); };
        const Vec3f n(ref::sample_sphere(next(), next()));
        const Vec3f p = center + radius * n;
        const ref::Frame frame(glm::normalize(glm::dvec3(n)));
        const glm::dvec3 local =
            ref::sample_sphere(next(), next()); // uniform, so that there are grazing rays
        const Vec3f w(glm::normalize(frame.to_world({local.x, local.y, std::abs(local.z)})));
        Vec3f origin = p + epsilon * w;
        if (epsilon < 0.0F) {
            const float diagonal = 2.0F * std::sqrt(3.0F) * radius;
            const Vec3f error = 5 * unit_roundoff * radius * glm::abs(n) +
                                2 * unit_roundoff * glm::abs(p) + Vec3f(16 * unit_roundoff * diagonal);
            origin = p + glm::dot(glm::abs(n), error) * n;
        }
        if (intersect(origin, w, center, radius)) outcome.meets_itself += 1.0 / count;
        // A plate parallel to the surface at height radius / 100: met unless the origin is beyond it.
        if (glm::dot(glm::dvec3(origin) - glm::dvec3(center), glm::dvec3(n)) > 1.01 * radius)
            outcome.misses += 1.0 / count;
    }
    return outcome;
}

void print_table()
{
    constexpr std::array<float, 4> methods = {1e-2F, 1e-4F, 1e-6F, -1.0F};
    std::printf(
        "| scale | 1e-2: itself | leaks | 1e-4: itself | leaks | 1e-6: itself | leaks | error bound: "
        "itself | leaks |\n|---|---|---|---|---|---|---|---|---|\n");
    for (int exponent = -6; exponent <= 6; exponent += 2) {
        std::printf("| 1e%+d |", exponent);
        for (const float epsilon : methods) {
            const Outcome outcome = measure(static_cast<float>(std::pow(10.0, exponent)), epsilon);
            std::printf(" %.2f%% | %.2f%% |", 100.0 * outcome.meets_itself, 100.0 * outcome.misses);
        }
        std::printf("\n");
    }
}

} // namespace

int main(int argc, char** argv)
{
    figures::Program program(
        "Prints the table of docs/bdpt.md on distances by which rays leave a surface", "figure_epsilon");
    return program.run(argc, argv, print_table);
}
