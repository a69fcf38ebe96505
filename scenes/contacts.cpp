#include "scenes/contacts.h"

#include "scenes/largest_component.h"
#include "scenes/overlapping_boxes.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace scenes {
namespace {

/// The unit normal; std::nullopt for a triangle without area. The edges are first scaled to a length of
/// about 1, so that no square under- or overflows.
std::optional<Vec3> normal_of(const Triangle& triangle)
{
    const auto& v = triangle.vertices;
    const Vec3 e1 = v[1] - v[0];
    const Vec3 e2 = v[2] - v[0];
    const double size = std::max(largest_component(e1), largest_component(e2));
    if (!(size > 0)) return std::nullopt;
    const Vec3 across = glm::cross(e1 / size, e2 / size);
    const double length = glm::length(across);
    if (!(length > 0)) return std::nullopt;
    return across / length;
}

double largest_coordinate(const Triangle& triangle)
{
    double largest = 0;
    for (const Vec3& v : triangle.vertices) largest = std::max(largest, largest_component(v));
    return largest;
}

/// At most the distance of `p` from the bounding box of a triangle.
double distance_to_box(const Triangle& triangle, const Vec3& p)
{
    const auto& v = triangle.vertices;
    const Vec3 below = glm::min(glm::min(v[0], v[1]), v[2]) - p;
    const Vec3 above = p - glm::max(glm::max(v[0], v[1]), v[2]);
    const Vec3 outside = glm::max(below, above);
    return std::max({outside.x, outside.y, outside.z});
}

/// The vector from `p` to the nearest point of a triangle: perpendicular to its plane if the foot point
/// is inside, otherwise to the nearest edge.
Vec3 to_nearest_point(const Triangle& triangle, const Vec3& normal, const Vec3& p)
{
    const auto& v = triangle.vertices;
    bool inside = true;
    Vec3 nearest(0);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 edge = v[(i + 1) % 3] - v[i];
        const Vec3 from = p - v[i];
        inside = inside && glm::dot(glm::cross(edge, from), normal) >= 0;
        const double square = glm::dot(edge, edge);
        const double t = square > 0 ? std::clamp(glm::dot(from, edge) / square, 0.0, 1.0) : 0.0;
        const Vec3 to = t * edge - from;
        if (const double distance = glm::length(to); distance < least) {
            least = distance;
            nearest = to;
        }
    }
    return inside ? glm::dot(v[0] - p, normal) * normal : nearest;
}

/// A convex polygon of at most six corners.
using Polygon = std::vector<Vec3>;

/// The part of `polygon` where dot(x - point, normal) >= 0 [Sutherland and Hodgman 1974].
Polygon clipped(const Polygon& polygon, const Vec3& point, const Vec3& normal)
{
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3& a = polygon[i];
        const Vec3& b = polygon[(i + 1) % polygon.size()];
        const double height_a = glm::dot(a - point, normal);
        const double height_b = glm::dot(b - point, normal);
        if (height_a >= 0) result.push_back(a);
        if ((height_a >= 0) != (height_b >= 0))
            result.push_back(a + height_a / (height_a - height_b) * (b - a));
    }
    return result;
}

double area_of(const Polygon& polygon)
{
    Vec3 sum(0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return glm::length(sum) / 2;
}

double perimeter_of(const Polygon& polygon)
{
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        sum += glm::length(polygon[(i + 1) % polygon.size()] - polygon[i]);
    return sum;
}

/// The triangle in units of 2^exponent: scaling changes no bit.
Triangle in_units_of(int exponent, Triangle triangle)
{
    for (Vec3& v : triangle.vertices)
        for (int axis = 0; axis < 3; ++axis) v[axis] = std::ldexp(v[axis], -exponent);
    return triangle;
}

/// Whether two planes are parallel enough to share more than a narrow band. `a`, `b`: their normals.
bool nearly_parallel(const std::optional<Vec3>& a, const std::optional<Vec3>& b)
{
    return a && b && !(glm::length(glm::cross(*a, *b)) > 0.01);
}

/// Whether two triangles coincide that are nearly parallel; `normal` is that of the first. They are
/// first scaled to a size of about 1: an area is a product of two lengths, and its square a product of
/// four.
bool coincide(const Triangle& a_in_file, const Vec3& normal, const Triangle& b_in_file, double on,
              double at_least)
{
    int exponent = 0;
    std::frexp(std::max(largest_coordinate(a_in_file), largest_coordinate(b_in_file)), &exponent);
    const Triangle a = in_units_of(exponent, a_in_file);
    const Triangle b = in_units_of(exponent, b_in_file);
    const double tolerance = std::max(on * std::max(largest_coordinate(a), largest_coordinate(b)),
                                      std::ldexp(at_least, -exponent));
    Polygon overlap(b.vertices.begin(), b.vertices.end());
    for (std::size_t i = 0; i < 3 && overlap.size() >= 3; ++i) {
        const Vec3 edge = a.vertices[(i + 1) % 3] - a.vertices[i];
        overlap = clipped(overlap, a.vertices[i], glm::normalize(glm::cross(normal, edge)));
    }
    // Neighbours that share an edge overlap because of rounding, in a strip no wider than the tolerance.
    if (overlap.size() < 3 || area_of(overlap) <= tolerance * perimeter_of(overlap)) return false;
    return std::ranges::all_of(overlap, [&](const Vec3& corner) {
        return std::abs(glm::dot(corner - a.vertices[0], normal)) <= tolerance;
    });
}

bool coincide(const Sphere& a, const Sphere& b, double on, double at_least)
{
    const double largest =
        std::max({largest_component(a.center), largest_component(b.center), a.radius});
    const double tolerance = std::max(on * largest, at_least);
    return largest_component(a.center - b.center) <= tolerance &&
           std::abs(a.radius - b.radius) <= tolerance;
}

/// Boxes of all primitives, grown by the tolerance.
std::vector<Bounds> grown_boxes(const Scene& scene, double on, double at_least)
{
    std::vector<Bounds> boxes;
    for (const Triangle& t : scene.triangles) {
        const auto& v = t.vertices;
        const Vec3 more(std::max(on * largest_coordinate(t), at_least));
        boxes.push_back(
            {glm::min(glm::min(v[0], v[1]), v[2]) - more, glm::max(glm::max(v[0], v[1]), v[2]) + more});
    }
    for (const Sphere& s : scene.spheres) {
        const Vec3 reach(s.radius + std::max(on * (largest_component(s.center) + s.radius), at_least));
        boxes.push_back({s.center - reach, s.center + reach});
    }
    return boxes;
}

} // namespace

std::vector<NearSurface> surfaces_near(const Scene& scene, const Vec3& point, double near, double on)
{
    std::vector<NearSurface> result;
    const double size = largest_component(point);
    const auto add = [&](std::uint32_t primitive, const Vec3& to, const Vec3& normal, double largest) {
        const double distance = glm::length(to);
        const double on_it = on * std::max(size, largest);
        if (!(distance <= std::max(near, on_it))) return;
        // In the plane of a triangle, beside it, the sign of the height would come from rounding.
        const double height = -glm::dot(to, normal);
        const int side = std::abs(height) <= on_it ? 0 : height > 0 ? 1 : -1;
        result.push_back({primitive, side, normal});
    };
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const Triangle& triangle = scene.triangles[i];
        const double largest = largest_coordinate(triangle);
        // Most triangles are far away, and their boxes tell; twice, because a distance is rounded.
        if (distance_to_box(triangle, point) > 2 * std::max(near, on * std::max(size, largest)))
            continue;
        if (const auto normal = normal_of(triangle))
            add(i, to_nearest_point(triangle, *normal, point), *normal, largest);
    }
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
        const Sphere& sphere = scene.spheres[i];
        const Vec3 from_center = point - sphere.center;
        const double distance = glm::length(from_center);
        if (!(distance > 0)) continue; // at the centre
        const Vec3 normal = from_center / distance;
        add(static_cast<std::uint32_t>(scene.triangles.size()) + i, (sphere.radius - distance) * normal,
            normal, largest_component(sphere.center) + sphere.radius);
    }
    return result;
}

std::vector<std::uint32_t> surfaces_at(const Scene& scene, const Vec3& point)
{
    std::vector<std::uint32_t> numbers;
    for (const NearSurface& surface : surfaces_near(scene, point)) numbers.push_back(surface.primitive);
    return numbers;
}

Coincidences::Coincidences(std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs,
                           std::uint32_t primitives)
{
    if (pairs.empty()) return;
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    begin_.assign(primitives + std::size_t{1}, 0);
    for (const auto& [a, b] : pairs) {
        ++begin_[a + 1];
        others_.push_back(b);
    }
    for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

Coincidences coincidences(const Scene& scene, double on, bool* complete, double at_least)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
    std::vector<std::optional<Vec3>> normals; // computed once: each is used by all its neighbours
    normals.reserve(triangles);
    for (const Triangle& triangle : scene.triangles) normals.push_back(normal_of(triangle));
    const bool all =
        for_each_overlap(grown_boxes(scene, on, at_least), [&](std::uint32_t a, std::uint32_t b) {
            if ((a < triangles) != (b < triangles)) return; // a plane and a sphere share no area
            const bool same =
                a < triangles
                    ? nearly_parallel(normals[a], normals[b]) &&
                          coincide(scene.triangles[a], *normals[a], scene.triangles[b], on, at_least)
                    : coincide(scene.spheres[a - triangles], scene.spheres[b - triangles], on, at_least);
            if (!same) return;
            pairs.emplace_back(a, b);
            pairs.emplace_back(b, a);
        });
    if (complete != nullptr) *complete = all;
    return {std::move(pairs), primitive_count(scene)};
}

int meeting_rank(const Material& material, bool from_front)
{
    if (std::holds_alternative<Emission>(material)) return from_front ? 0 : 3;
    return std::holds_alternative<Glass>(material) ? 2 : 1;
}

} // namespace scenes
