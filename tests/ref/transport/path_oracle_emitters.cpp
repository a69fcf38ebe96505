// The emission of emitters, and the start of light walks.

#include "tests/ref/transport/path_oracle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace transport_test {

namespace {

using std::numbers::pi;
using Kind = Place::Kind;

double mean(const Rgb& v)
{
    return (v.x + v.y + v.z) / 3.0;
}

/// Converts powers to probabilities: the unit interval has 2^24 cells. Each emitter with power gets
/// one cell first; half of the others are given in proportion to power, half equally, and rounded at
/// the borders between emitters.
void share_out(std::vector<Share>& shares)
{
    long double total = 0;
    long double n = 0;
    for (const Share& share : shares) {
        total += share.probability;
        n += share.probability > 0 ? 1 : 0;
    }
    const long double cells = 16'777'216 - n;
    long double power_before = 0;
    long double number_before = 0;
    const auto taken = [&] {
        const long double share = total > 0 ? (power_before / total + number_before / n) / 2 : 0;
        return number_before + std::round(cells * share);
    };
    for (Share& share : shares) {
        const long double begin = taken();
        power_before += share.probability;
        number_before += share.probability > 0 ? 1 : 0;
        share.probability = static_cast<double>((taken() - begin) / 16'777'216);
    }
}

} // namespace

PathOracle::PathOracle(const scenes::Scene& scene, int width, int height, bool roulette,
                       int roulette_from)
    : scene_(scene), width_(width), height_(height), roulette_(roulette), roulette_from_(roulette_from)
{
    const double tan_half = std::tan(scene.camera->fov / 2.0);
    const bool horizontal = scene.camera->fov_axis == scenes::FovAxis::horizontal;
    tan_x_ = horizontal ? tan_half : tan_half * width / height;
    tan_y_ = horizontal ? tan_half * height / width : tan_half;

    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    const auto include = [&](const Vec3& p) {
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    };
    for (const auto& triangle : scene.triangles)
        for (const Vec3& v : triangle.vertices) include(v);
    for (const auto& sphere : scene.spheres) {
        include(sphere.center + Vec3(sphere.radius));
        include(sphere.center - Vec3(sphere.radius));
    }
    const bool empty = scenes::primitive_count(scene) == 0;
    radius_ = empty ? 0.0 : glm::distance(low, high) / 2.0;

    const auto emission = [&](std::uint32_t m) {
        const auto* e = std::get_if<scenes::Emission>(&scene.materials[m]);
        return e != nullptr ? mean(e->radiance) : 0.0;
    };
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const auto& v = scene.triangles[i].vertices;
        const double area = 0.5 * glm::length(glm::cross(v[2] - v[1], v[0] - v[1]));
        shares_.push_back({Kind::surface, i, area, pi * area * emission(scene.triangles[i].material)});
    }
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
        const double area = 4.0 * pi * std::pow(scene.spheres[i].radius, 2);
        shares_.push_back({Kind::surface, static_cast<std::uint32_t>(scene.triangles.size()) + i, area,
                           pi * area * emission(scene.spheres[i].material)});
    }
    for (std::uint32_t i = 0; i < scene.point_lights.size(); ++i)
        shares_.push_back({Kind::point, i, 0.0, 4.0 * pi * mean(scene.point_lights[i].intensity)});
    for (std::uint32_t i = 0; i < scene.spot_lights.size(); ++i) {
        const auto& spot = scene.spot_lights[i]; // by the integral of the intensity over the cone
        const double c = spot.exponent > 0.0 ? std::max(spot.cos_cutoff, 0.0) : spot.cos_cutoff;
        const double n = spot.exponent + 1.0;
        shares_.push_back(
            {Kind::spot, i, 0.0, mean(spot.intensity) * 2.0 * pi * (1.0 - std::pow(c, n)) / n});
    }
    for (std::uint32_t i = 0; i < scene.directional_lights.size(); ++i)
        shares_.push_back({Kind::directional, i, 0.0,
                           pi * radius_ * radius_ * mean(scene.directional_lights[i].irradiance)});
    if (scene.environment)
        shares_.push_back(
            {Kind::environment, 0, 0.0, 4.0 * std::pow(pi * radius_, 2) * mean(*scene.environment)});

    share_out(shares_);
}

Share PathOracle::share_of(const Place& place) const
{
    for (const Share& share : shares_)
        if (share.kind == place.kind && share.index == place.index) return share;
    return {place.kind, place.index, 0.0, 0.0};
}

Rgb PathOracle::emitted(const Place& x0, const Vec3& w) const
{
    switch (x0.kind) {
    case Kind::eye:
        break;
    case Kind::surface: {
        const auto* emission = std::get_if<scenes::Emission>(&material(x0));
        const bool front = glm::dot(normal(x0), w) > 0.0;
        return emission != nullptr && front ? emission->radiance : Rgb(0.0);
    }
    case Kind::point:
        return scene_.point_lights[x0.index].intensity;
    case Kind::spot: {
        const auto& spot = scene_.spot_lights[x0.index];
        const double c = glm::dot(spot.direction, w);
        if (c <= spot.cos_cutoff || (c <= 0.0 && spot.exponent > 0.0)) return Rgb(0.0);
        return spot.intensity * (spot.exponent > 0.0 ? std::pow(c, spot.exponent) : 1.0);
    }
    case Kind::directional:
        return scene_.directional_lights[x0.index].irradiance;
    case Kind::environment:
        return *scene_.environment;
    }
    return Rgb(0.0);
}

/// The density of the light walk's first direction w, per solid angle; from infinity, of its position
/// on the disc.
double PathOracle::pdf_start(const Place& x0, const Vec3& w) const
{
    switch (x0.kind) {
    case Kind::eye:
        return 0.0;
    case Kind::surface:
        return std::max(0.0, glm::dot(normal(x0), w)) / pi;
    case Kind::point:
        return 1.0 / (4.0 * pi);
    case Kind::spot: {
        const auto& spot = scene_.spot_lights[x0.index];
        const bool inside = glm::dot(spot.direction, w) > spot.cos_cutoff;
        return inside ? 1.0 / (2.0 * pi * (1.0 - spot.cos_cutoff)) : 0.0;
    }
    case Kind::directional:
    case Kind::environment:
        break;
    }
    return 1.0 / (pi * radius_ * radius_);
}

} // namespace transport_test
