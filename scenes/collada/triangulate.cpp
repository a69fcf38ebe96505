#include "scenes/collada/triangulate.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <span>

namespace scenes::collada {
namespace {

using Polygon = std::span<const std::uint32_t>;

/// Twice the area times the unit normal.
Vec3 area_vector(const Corners& c)
{
    return glm::cross(c[1] - c[0], c[2] - c[0]);
}

double largest_coordinate(const Vec3& v)
{
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The sum of the fan's area vectors is the same for every fan: the normal of the mean plane
/// [Newell's method, Sutherland et al. 1974]. The plane goes through the mean of the corners.
void examine(const Polygon& polygon, const std::vector<Vec3>& positions, std::span<const Corners> fan,
             PolygonFaults& faults)
{
    Vec3 sum(0.0);
    for (const Corners& triangle : fan) sum += area_vector(triangle);
    const double length = glm::length(sum);
    if (!(length > 0)) return; // zero area in total: nothing to be off
    const Vec3 normal = sum / length;

    Vec3 center(0.0);
    for (const std::uint32_t corner : polygon)
        center += positions[corner] / static_cast<double>(polygon.size());
    double size = 0;      // extent of the polygon
    double magnitude = 0; // of the numbers in the file, which carry about seven digits
    double height = 0;    // above or below the plane
    for (const std::uint32_t corner : polygon) {
        const Vec3 from_center = positions[corner] - center;
        size = std::max(size, largest_coordinate(from_center));
        magnitude = std::max(magnitude, largest_coordinate(positions[corner]));
        height = std::max(height, std::abs(glm::dot(normal, from_center)));
    }
    if (height > 1e-5 * size + 1e-6 * magnitude) ++faults.non_planar;

    const bool folded = std::any_of(fan.begin(), fan.end(), [&](const Corners& triangle) {
        return glm::dot(area_vector(triangle), normal) <
               -1e-6 * length; // more than rounding turns it over
    });
    if (folded) ++faults.folded;
}

} // namespace

void triangulate(const Polygons& polygons, const std::vector<Vec3>& positions,
                 std::vector<Corners>& triangles, PolygonFaults& faults)
{
    std::size_t first = 0;
    for (const std::uint32_t size : polygons.sizes) {
        const Polygon polygon(polygons.corners.data() + first, size);
        first += size;
        if (size < 3) {
            ++faults.too_small;
            continue;
        }
        const std::size_t fan_begin = triangles.size();
        for (std::size_t i = 1; i + 1 < size; ++i)
            triangles.push_back(
                {positions[polygon[0]], positions[polygon[i]], positions[polygon[i + 1]]});
        const std::span<const Corners> fan(triangles.data() + fan_begin, size - 2);
        for (const Corners& triangle : fan)
            if (area_vector(triangle) == Vec3(0.0)) ++faults.zero_area;
        if (size > 3) examine(polygon, positions, fan, faults);
    }
}

} // namespace scenes::collada
