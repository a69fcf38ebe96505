#pragma once

// Geometrical optics from first principles, on the plain data of a scene: the parts of closed forms.
// It uses no code of ref/, only the layout of its numbers, so that no mistake can cancel.

#include "scenes/scene.h"
#include "tests/ref/transport/estimate.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

namespace transport_test {

using scenes::Rgb;
using scenes::Vec3;
using std::numbers::pi;

struct Line {
    Vec3 from;
    Vec3 direction; // of unit length
};

/// The line from the camera through the film point (x, y), in pixels from the top left.
inline Line camera_line(const scenes::Camera& camera, int width, int height, double x, double y)
{
    const double span = 2.0 * std::tan(camera.fov / 2.0);
    const double pixel = span / (camera.fov_axis == scenes::FovAxis::vertical ? height : width);
    return {camera.eye, glm::normalize(-camera.backward + (x - 0.5 * width) * pixel * camera.right -
                                       (y - 0.5 * height) * pixel * camera.up)};
}

struct Seen {
    std::uint32_t primitive;
    double distance;
    Vec3 point;
    Vec3 normal; // geometric, of unit length
};

/// The distances along `line` at which it crosses a sphere; nullopt if it misses.
inline std::optional<std::array<double, 2>> crossings(const scenes::Sphere& sphere, const Line& line)
{
    const Vec3 to_center = sphere.center - line.from;
    const double middle = glm::dot(to_center, line.direction);
    const double past = glm::length(to_center - middle * line.direction);
    if (past >= sphere.radius) return std::nullopt;
    const double half = std::sqrt(sphere.radius * sphere.radius - past * past);
    return std::array{middle - half, middle + half};
}

/// The first surface along `line`, at a distance of more than 1e-9 from its start (scenes here are of
/// unit size). Within about 1e-15 of an edge rounding decides, and the answer may differ from that of
/// ref/.
inline std::optional<Seen> first_seen(const scenes::Scene& scene, const Line& line)
{
    constexpr double nearest = 1e-9;
    std::optional<Seen> seen;
    const auto consider = [&](std::size_t primitive, double distance, const Vec3& normal) {
        if (distance < nearest || (seen && seen->distance <= distance)) return;
        const Vec3 point = line.from + distance * line.direction;
        seen = Seen{static_cast<std::uint32_t>(primitive), distance, point, normal};
    };
    for (std::size_t i = 0; i < scene.triangles.size(); ++i) {
        const auto& [a, b, c] = scene.triangles[i].vertices;
        const Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        const double distance = glm::dot(a - line.from, normal) / glm::dot(line.direction, normal);
        const Vec3 p = line.from + distance * line.direction;
        const auto left_of = [&](const Vec3& from, const Vec3& to) {
            return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0;
        };
        if (left_of(a, b) && left_of(b, c) && left_of(c, a)) consider(i, distance, normal);
    }
    for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
        const scenes::Sphere& sphere = scene.spheres[i];
        if (const auto both = crossings(sphere, line))
            for (const double distance : *both) {
                const Vec3 point = line.from + distance * line.direction;
                consider(scene.triangles.size() + i, distance, (point - sphere.center) / sphere.radius);
            }
    }
    return seen;
}

inline const scenes::Material& material_at(const scenes::Scene& scene, const Seen& seen)
{
    return scene.materials[scenes::material_of(scene, seen.primitive)];
}

template <class Material>
bool is(const scenes::Scene& scene, const std::optional<Seen>& seen)
{
    return seen && std::holds_alternative<Material>(material_at(scene, *seen));
}

inline Rgb albedo_at(const scenes::Scene& scene, const Seen& seen)
{
    return std::get<scenes::Lambertian>(material_at(scene, seen)).albedo;
}

inline Line reflected(const Line& line, const Seen& seen)
{
    return {seen.point, line.direction - 2.0 * glm::dot(line.direction, seen.normal) * seen.normal};
}

/// Fresnel's reflectance of a boundary from index `n1` to `n2`, from the angles [Born & Wolf 1999,
/// sec. 1.5.2, eq. 21 and 21a]; `sine` is that of the angle of incidence.
inline double reflectance(double sine, double n1, double n2)
{
    if (n1 * sine >= n2) return 1.0;
    if (sine < 1e-7) return (n1 - n2) / (n1 + n2) * ((n1 - n2) / (n1 + n2)); // its error is sine^2
    const double i = std::asin(sine);
    const double t = std::asin(n1 * sine / n2);
    const double perpendicular = std::sin(i - t) / std::sin(i + t);
    const double parallel = std::tan(i - t) / std::tan(i + t);
    return (perpendicular * perpendicular + parallel * parallel) / 2.0;
}

/// The continuation of `line` behind the boundary at `seen`, from index `n1` to `n2` [Snell]. The
/// caller must exclude total reflection.
inline Line refracted(const Line& line, const Seen& seen, double n1, double n2)
{
    const Vec3 along = line.direction - glm::dot(line.direction, seen.normal) * seen.normal;
    const Vec3 sines = n1 / n2 * along;
    const double cosine = std::sqrt(1.0 - glm::dot(sines, sines));
    return {seen.point,
            sines + std::copysign(cosine, glm::dot(line.direction, seen.normal)) * seen.normal};
}

/// The irradiance per radiance, at a point with unit normal `n`, from a polygon that is wholly above
/// its horizon [Lambert 1760]: half the sum, over its edges, of the angle that an edge subtends times
/// the cosine between n and the normal of the plane through the edge and the point.
inline double polygon_irradiance(const Vec3& point, const Vec3& n, const std::vector<Vec3>& corners)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec3 a = glm::normalize(corners[i] - point);
        const Vec3 b = glm::normalize(corners[(i + 1) % corners.size()] - point);
        const Vec3 across = glm::cross(a, b);
        const double angle = std::atan2(glm::length(across), glm::dot(a, b));
        sum += angle * glm::dot(n, glm::normalize(across));
    }
    return std::abs(sum) / 2.0;
}

/// The irradiance per radiance from a luminous sphere wholly above the horizon.
inline double sphere_irradiance(const Vec3& point, const Vec3& n, const Vec3& center, double radius)
{
    const double d = glm::length(center - point);
    return pi * radius * radius * glm::dot(n, center - point) / (d * d * d);
}

/// A picture in closed form; some pixels are left out.
struct KnownPicture {
    images::Image radiance;
    std::vector<std::size_t> pixels; // the pixels that are known
};

/// The radiance along a line from the eye; nullopt where it is unknown.
using LineRadiance = std::function<std::optional<Rgb>(const Line&)>;

/// `radiance` integrated over each pixel with 8 x 8 points. A pixel is known if all of its points are.
inline KnownPicture known_picture(const scenes::Camera& camera, int width, int height,
                                  const LineRadiance& radiance)
{
    KnownPicture known{{width, height}, {}};
    constexpr int steps = 8;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            Rgb sum(0.0);
            bool all = true;
            for (int i = 0; i < steps * steps && all; ++i) {
                const auto here =
                    radiance(camera_line(camera, width, height, x + (i % steps + 0.5) / steps,
                                         y + (i / steps + 0.5) / steps));
                all = here.has_value();
                if (all) sum += *here / static_cast<double>(steps * steps);
            }
            if (!all) continue;
            known.radiance.at(x, y) = sum;
            known.pixels.push_back(static_cast<std::size_t>(y * width + x));
        }
    return known;
}

inline double mean_over(const images::Image& image, std::span<const std::size_t> pixels, int channel)
{
    double sum = 0.0;
    for (const std::size_t pixel : pixels) sum += image.pixels[pixel][channel];
    return sum / static_cast<double>(pixels.size());
}

/// Compares the means over all known pixels, and over `strata` groups of similar brightness, with the
/// expected values: a wrong factor changes the whole, a wrong falloff the groups. Groups without light
/// are left to exact tests. For groups, `specification` is multiplied by the root of their number.
inline void expect_picture(const Batches& batches, KnownPicture known, double specification,
                           std::size_t strata = 4)
{
    ASSERT_FALSE(known.pixels.empty());
    std::erase_if(known.pixels, [&](std::size_t i) { return known.radiance.pixels[i] == Rgb(0.0); });
    ASSERT_GE(known.pixels.size(), 8 * strata) << "hardly anything is lit";
    std::sort(known.pixels.begin(), known.pixels.end(), [&](std::size_t a, std::size_t b) {
        return known.radiance.pixels[a].x < known.radiance.pixels[b].x;
    });
    const auto compare = [&](std::span<const std::size_t> pixels, double bias) {
        for (int channel = 0; channel < 3; ++channel) {
            std::vector<double> values;
            for (const images::Image& batch : batches)
                values.push_back(mean_over(batch, pixels, channel));
            expect_mean(measure(values), mean_over(known.radiance, pixels, channel), bias);
        }
    };
    const std::span<const std::size_t> all = known.pixels;
    compare(all, specification);
    for (std::size_t i = 0; i < strata; ++i) {
        const std::size_t begin = all.size() * i / strata;
        compare(all.subspan(begin, all.size() * (i + 1) / strata - begin),
                specification * std::sqrt(static_cast<double>(strata)));
    }
}

/// Calls `judge` for each of `samples` samples per pixel, with the line from the eye through its film
/// point.
inline void
for_every_sample(const ref::World& world, ref::Integrator integrator, const ref::PathOptions& options,
                 std::uint32_t samples,
                 const std::function<void(const Line&, const std::vector<ref::Contribution>&)>& judge)
{
    const int width = world.camera.width();
    const int height = world.camera.height();
    std::vector<ref::Contribution> contributions;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (std::uint32_t sample = 0; sample < samples; ++sample) {
                const ref::SampleId id{options.seed, static_cast<std::uint32_t>(y * width + x), sample};
                const auto u = ref::uniforms(id, ref::Event::camera);
                contributions.clear();
                integrator(world, options, id, contributions);
                judge(camera_line(*world.scene.camera, width, height, x + u[0], y + u[1]),
                      contributions);
                if (testing::Test::HasFatalFailure()) return;
            }
}

} // namespace transport_test
