#include "scenes/polygons/triangulate.h"

#include "scenes/largest_component.h"
#include "scenes/polygons/cut.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>

namespace scenes::polygons {
namespace {

/// Twice the area times the unit normal.
Vec3 area_vector(const Corners& c)
{
    return glm::cross(c[1] - c[0], c[2] - c[0]);
}

/// The corners of all rings, those of the outline first, scaled by a power of two so that all
/// coordinates are below 1. That changes no digit, and no product of a few of them overflows.
std::vector<Vec3> scaled(std::span<const Vec3> corners)
{
    double largest = 0;
    for (const Vec3& corner : corners) largest = std::max(largest, largest_component(corner));
    int exponent = 0;
    std::frexp(largest, &exponent);
    std::vector<Vec3> result;
    for (const Vec3& c : corners)
        result.emplace_back(std::ldexp(c.x, -exponent), std::ldexp(c.y, -exponent),
                            std::ldexp(c.z, -exponent));
    return result;
}

/// The position of a polygon in space.
struct Pose {
    enum class Kind { flat, crossed, planar, warped } kind; // flat: no area, crossed: areas sum to zero
    Vec3 normal;
};

/// The plane goes through the mean of the corners.
bool is_planar(std::span<const Vec3> corners, const Vec3& normal)
{
    Vec3 center(0.0);
    for (const Vec3& corner : corners) center += corner / static_cast<double>(corners.size());
    double size = 0;      // extent of the polygon
    double magnitude = 0; // of the numbers in the file, which carry about seven digits
    double height = 0;    // above or below the plane
    for (const Vec3& corner : corners) {
        const Vec3 from_center = corner - center;
        size = std::max(size, largest_component(from_center));
        magnitude = std::max(magnitude, largest_component(corner));
        height = std::max(height, std::abs(glm::dot(normal, from_center)));
    }
    return height <= 1e-5 * size + 1e-6 * magnitude;
}

Pose pose_of(std::span<const Vec3> corners, std::size_t outline_size)
{
    Vec3 sum(0.0);
    double total = 0;
    double size = 0;
    for (std::size_t i = 1; i < outline_size; ++i)
        size = std::max(size, largest_component(corners[i] - corners[0]));
    for (std::size_t i = 1; i + 1 < outline_size; ++i) {
        const Vec3 area = area_vector({corners[0], corners[i], corners[i + 1]});
        sum += area;
        total += glm::length(area);
    }
    // A product of two differences is off by a few roundings of its factors, and each corner is rounded
    // itself, to a relative 2^-53 of the largest coordinate, 1.
    const double rounding =
        8 * static_cast<double>(outline_size) * std::numeric_limits<double>::epsilon() * size;
    if (total <= rounding) return {Pose::Kind::flat, {}};
    const double length = glm::length(sum);
    if (length <= rounding) return {Pose::Kind::crossed, {}};
    const Vec3 normal = sum / length;
    return {is_planar(corners, normal) ? Pose::Kind::planar : Pose::Kind::warped, normal};
}

/// Coordinates in the plane, right-handed about the normal. Those of a planar polygon are two of its
/// three, without rounding.
std::vector<Point> projected(std::span<const Vec3> corners, const Pose& pose)
{
    const Vec3 n = glm::abs(pose.normal);
    const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2; // nearest to the normal
    Vec3 right(0.0);
    right[(axis + 1) % 3] = 1;
    Vec3 up(0.0);
    up[(axis + 2) % 3] = 1;
    if (pose.normal[axis] < 0) std::swap(right, up);
    Vec3 origin(0.0);
    if (pose.kind == Pose::Kind::warped) {
        origin = corners[0];
        right = glm::normalize(right - glm::dot(right, pose.normal) * pose.normal);
        up = glm::cross(pose.normal, right);
    }
    // So small numbers do not matter beside a coordinate near 1, and their products would leave the
    // range of doubles.
    const auto without_tiny = [](double x) { return std::abs(x) < 0x1p-400 ? 0.0 : x; };
    std::vector<Point> points;
    for (const Vec3& corner : corners)
        points.emplace_back(without_tiny(glm::dot(corner - origin, right)),
                            without_tiny(glm::dot(corner - origin, up)));
    return points;
}

/// The polygon cut in its plane, by indices of corners; std::nullopt if it cannot be cut.
std::optional<std::vector<PointTriangle>>
cut(std::span<const Vec3> in_space, std::span<const std::uint32_t> sizes, PolygonFaults& faults)
{
    const std::vector<Vec3> corners = scaled(in_space);
    const Pose pose = pose_of(corners, sizes[0]);
    if (pose.kind == Pose::Kind::warped) ++faults.non_planar;
    if (pose.kind == Pose::Kind::flat) return std::nullopt;
    std::optional<std::vector<PointTriangle>> triangles;
    if (pose.kind != Pose::Kind::crossed) {
        std::vector<Ring> rings;
        std::uint32_t next = 0;
        for (const std::uint32_t size : sizes) {
            Ring& ring = rings.emplace_back();
            for (std::uint32_t i = 0; i < size; ++i) ring.push_back(next++);
        }
        triangles = cut_polygon(projected(corners, pose), rings);
    }
    if (!triangles) ++faults.crossed;
    return triangles;
}

/// One polygon, given by the corners of its rings.
void append(std::span<const Vec3> corners, std::span<const std::uint32_t> sizes,
            std::vector<Corners>& triangles, PolygonFaults& faults)
{
    const std::size_t before = triangles.size();
    const bool is_triangle = sizes.size() == 1 && sizes[0] == 3;
    std::optional<std::vector<PointTriangle>> pieces;
    try {
        if (!is_triangle) pieces = cut(corners, sizes, faults);
    } catch (const std::length_error&) {
        ++faults.too_large;
        return;
    }
    if (pieces)
        for (const auto& [a, b, c] : *pieces) triangles.push_back({corners[a], corners[b], corners[c]});
    else
        for (std::size_t i = 1; i + 1 < sizes[0]; ++i)
            triangles.push_back({corners[0], corners[i], corners[i + 1]});
    faults.zero_area += static_cast<std::size_t>(
        std::count_if(triangles.begin() + static_cast<std::ptrdiff_t>(before), triangles.end(),
                      [](const Corners& triangle) { return area_vector(triangle) == Vec3(0.0); }));
}

} // namespace

void triangulate(const Polygons& polygons, const std::vector<Vec3>& positions,
                 std::vector<Corners>& triangles, PolygonFaults& faults)
{
    const std::size_t count = polygons.rings.empty() ? polygons.sizes.size() : polygons.rings.size();
    auto size = polygons.sizes.begin();
    auto corner = polygons.corners.begin();
    std::vector<std::uint32_t> sizes;
    std::vector<Vec3> corners;
    for (std::size_t polygon = 0; polygon < count; ++polygon) {
        sizes.clear();
        corners.clear();
        const std::uint32_t rings = polygons.rings.empty() ? 1 : polygons.rings[polygon];
        const bool too_small = *size < 3;
        if (too_small) ++faults.too_small;
        for (std::uint32_t ring = 0; ring < rings; ++ring, corner += *size, ++size) {
            if (ring > 0 && *size < 3) ++faults.small_holes;
            if (too_small || *size < 3) continue;
            sizes.push_back(*size);
            for (std::uint32_t i = 0; i < *size; ++i) corners.push_back(positions[corner[i]]);
        }
        if (!too_small) append(corners, sizes, triangles, faults);
    }
}

} // namespace scenes::polygons
