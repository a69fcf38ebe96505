#include "cuda/trees/scene_geometry.h"

#include "cuda/parallel/executor.h"
#include "scenes/largest_component.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fast {

bool has_area_in_double(const scenes::Triangle& triangle)
{
    const auto& v = triangle.vertices;
    scenes::Vec3 e1 = v[1] - v[0];
    scenes::Vec3 e2 = v[2] - v[0];
    const double size = std::max(scenes::largest_component(e1), scenes::largest_component(e2));
    if (size == 0) return false;
    // Scaled by an exact power of two to edges of about 1, so that no square overflows or underflows.
    const double scale = std::ldexp(1.0, -std::clamp(std::ilogb(size), -1000, 1000));
    e1 *= scale;
    e2 *= scale;
    const scenes::Vec3 e3 = e2 - e1;
    const scenes::Vec3 across = glm::cross(e1, e2); // height times longest edge
    const double longest2 = std::max({glm::dot(e1, e1), glm::dot(e2, e2), glm::dot(e3, e3)});
    const double rounding = 0x1p-48 * scale *
                            std::max({scenes::largest_component(v[0]), scenes::largest_component(v[1]),
                                      scenes::largest_component(v[2])});
    // NaN counts as area here; the tree build rejects it later.
    return !(glm::dot(across, across) <= rounding * rounding * longest2);
}

namespace {

/// Computed in double, where differences and products of floats are exact unless they are of very
/// different size; and rounding does not make equal products differ.
bool has_area_in_float(const Triangle& triangle)
{
    const auto& v = triangle.vertices;
    const scenes::Vec3 e1 = scenes::Vec3(v[1]) - scenes::Vec3(v[0]);
    const scenes::Vec3 e2 = scenes::Vec3(v[2]) - scenes::Vec3(v[0]);
    return e1.y * e2.z != e1.z * e2.y || e1.z * e2.x != e1.x * e2.z || e1.x * e2.y != e1.y * e2.x;
}

Triangle rounded(const scenes::Triangle& triangle, const Placement& place)
{
    const auto& v = triangle.vertices;
    return {{place(v[0]), place(v[1]), place(v[2])}};
}

} // namespace

bool has_area(const scenes::Triangle& triangle, const Placement& place)
{
    const Triangle floats = rounded(triangle, place);
    for (const Vec3& vertex : floats.vertices)
        if (!is_finite(vertex)) return true; // the tree build rejects it
    return has_area_in_double(triangle) && has_area_in_float(floats);
}

std::vector<Triangle> triangles_of(const scenes::Scene& scene, const Placement& place)
{
    std::vector<Triangle> triangles;
    triangles.reserve(scene.triangles.size());
    for (const scenes::Triangle& triangle : scene.triangles) {
        Triangle& floats = triangles.emplace_back(rounded(triangle, place));
        if (!has_area(triangle, place)) floats.vertices[1] = floats.vertices[2] = floats.vertices[0];
    }
    return triangles;
}

std::vector<Sphere> spheres_of(const scenes::Scene& scene, const Placement& place)
{
    std::vector<Sphere> spheres;
    spheres.reserve(scene.spheres.size());
    for (const scenes::Sphere& sphere : scene.spheres)
        spheres.push_back({place(sphere.center), static_cast<float>(sphere.radius * place.scale)});
    return spheres;
}

std::vector<Aabb> boxes_of(const scenes::Scene& scene, const Placement& place)
{
    const std::vector<Triangle> triangles = triangles_of(scene, place);
    const std::vector<Sphere> spheres = spheres_of(scene, place);
    std::vector<Aabb> boxes(triangles.size() + spheres.size());
    const std::span<Aabb> all(boxes);
    SerialExecutor executor;
    executor(static_cast<std::uint32_t>(triangles.size()),
             BoundTriangles{triangles, all.first(triangles.size())});
    executor(static_cast<std::uint32_t>(spheres.size()),
             BoundSpheres{spheres, all.subspan(triangles.size())});
    return boxes;
}

} // namespace fast
