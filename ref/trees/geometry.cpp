#include "ref/trees/geometry.h"

#include "ref/trees/intersect.h"
#include "ref/trees/rounding.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ref {

namespace {

/// The diagonal of the box around everything: no two points of surfaces are further apart.
double box_diagonal(const scenes::Scene& scene)
{
    Vec3 lower(std::numeric_limits<double>::infinity());
    Vec3 upper = -lower;
    const auto grow = [&](const Vec3& from, const Vec3& to) {
        lower = glm::min(lower, from);
        upper = glm::max(upper, to);
    };
    for (const scenes::Triangle& triangle : scene.triangles)
        for (const Vec3& vertex : triangle.vertices) grow(vertex, vertex);
    for (const scenes::Sphere& sphere : scene.spheres)
        grow(sphere.center - sphere.radius, sphere.center + sphere.radius);
    return primitive_count(scene) == 0 ? 0 : glm::length(upper - lower);
}

} // namespace

Geometry::Geometry(const scenes::Scene& scene) : scene_(&scene), diagonal_(box_diagonal(scene)) {}

std::optional<Hit> intersect(const Geometry& geometry, const Ray& ray)
{
    const scenes::Scene& scene = geometry.scene();
    const ShearedRay sheared(ray);
    std::optional<Hit> closest;
    std::uint32_t primitive = 0;
    for (const scenes::Triangle& triangle : scene.triangles) {
        const auto hit = intersect_triangle(sheared, triangle.vertices);
        if (hit && (!closest || hit->t < closest->t)) closest = Hit{hit->t, primitive, hit->barycentric};
        ++primitive;
    }
    for (const scenes::Sphere& sphere : scene.spheres) {
        const auto t = intersect_sphere(ray, sphere.center, sphere.radius);
        if (t && (!closest || *t < closest->t)) closest = Hit{*t, primitive, Vec3(0)};
        ++primitive;
    }
    return closest;
}

bool occluded(const Geometry& geometry, const Ray& ray)
{
    const scenes::Scene& scene = geometry.scene();
    const ShearedRay sheared(ray);
    for (const scenes::Triangle& triangle : scene.triangles)
        if (intersect_triangle(sheared, triangle.vertices)) return true;
    for (const scenes::Sphere& sphere : scene.spheres)
        if (intersect_sphere(ray, sphere.center, sphere.radius)) return true;
    return false;
}

// How far a point must be from a surface for a ray that starts there, or ends there, to be clear of it.
//
// Let u be the unit roundoff and D the diagonal of the scene, so that no coordinate of a difference of
// two points exceeds D. Distances below are along the normal n; a bound per coordinate e counts as sum
// |n_i| e_i.
//
// 1. The computed position. Triangle: the weights U/det, V/det, W/det of the doubles U, V, W are those
// of
//    a point P inside the triangle, wherever the ray really met it. Its coordinates are computed as
//    v0 + (b1 e1 + b2 e2): each b carries 3 roundings (two in det, the division), the edge e 1, product
//    and inner sum 2, and writing the bound with the computed b another: gamma_7 (b1 |e1| + b2 |e2|);
//    the outer sum rounds by u |p|. Sphere: p = c + r (w / |w|): |w| has gamma_3, the division and the
//    product 1 each: gamma_5 r |n_i|; the sum rounds by u |p|.
// 2. The origin o = p + s n rounds by u |o|, or u |p| up to what is far below 4.
// 3. A query does not see the vertex v but a perturbed one, and its answer is exact for that:
// intersect.h
//    decides "inside" exactly for the sheared vertices, and reports no t whose sign rounding could have
//    changed. So if the perturbed vertices all lie on one side of the plane through o parallel to the
//    triangle, and the direction points to the other side (or along it), there is no hit. Shearing
//    perturbs z by 3 u D (difference, 1/dz, product) and x and y each by u D (difference) + 2 u D (S and
//    product) + 2 u D (the last difference) + 2 u D (that z is perturbed by more than it entered with):
//    sqrt(7^2 + 7^2 + 3^2) u D < 10.4 u D along n. This holds for the surface left, as well as for the
//    one on which a segment ends, |v - o| <= D in both cases; there t - t_max adds u D, and the
//    direction q' - p' is rounded, by u D: 12.4 u D. The sphere test errs by less: f = o - c has u D, l
//    - f and l each another, |l|^2 and r^2 the like of 3 u r, and 2 r <= D: 5 u D. Its sign of |f|^2 -
//    r^2 is certain from 4 u r on.
// 4. Rounding of s n, of s and the error of n itself (a relative 1e-15 times the aspect ratio of the
//    triangle) are covered by counting 16 u D for 3.
//
// What it cannot promise: n has an angular error of about 4 u times the aspect ratio (longest edge over
// smallest height). Which side a direction closer than this to the surface points to is not known.
SurfacePoint triangle_point(const Geometry& geometry, std::uint32_t triangle, const Vec3& barycentric)
{
    const auto& v = geometry.scene().triangles[triangle].vertices;
    const Vec3 e1 = v[1] - v[0];
    const Vec3 e2 = v[2] - v[0];
    const double b1 = barycentric[1];
    const double b2 = barycentric[2];
    SurfacePoint point{};
    point.primitive = triangle;
    point.material = geometry.scene().triangles[triangle].material;
    point.position = v[0] + (b1 * e1 + b2 * e2);
    point.normal = glm::normalize(glm::cross(e1, e2));
    point.error = gamma_bound(7) * (b1 * glm::abs(e1) + b2 * glm::abs(e2)) +
                  2 * unit_roundoff * glm::abs(point.position) + 16 * unit_roundoff * geometry.diagonal();
    return point;
}

SurfacePoint sphere_point(const Geometry& geometry, std::uint32_t sphere, const Vec3& direction)
{
    const scenes::Sphere& s = geometry.scene().spheres[sphere];
    SurfacePoint point{};
    point.primitive = static_cast<std::uint32_t>(geometry.scene().triangles.size()) + sphere;
    point.material = s.material;
    point.normal = glm::normalize(direction);
    point.position = s.center + s.radius * point.normal;
    point.error = gamma_bound(5) * s.radius * glm::abs(point.normal) +
                  2 * unit_roundoff * glm::abs(point.position) + 16 * unit_roundoff * geometry.diagonal();
    return point;
}

SurfacePoint surface_point(const Geometry& geometry, const Ray& ray, const Hit& hit)
{
    const auto triangles = static_cast<std::uint32_t>(geometry.scene().triangles.size());
    if (hit.primitive < triangles) return triangle_point(geometry, hit.primitive, hit.barycentric);
    const std::uint32_t sphere = hit.primitive - triangles;
    const Vec3& center = geometry.scene().spheres[sphere].center;
    return sphere_point(geometry, sphere, ray.origin + hit.t * ray.direction - center);
}

Vec3 leave_surface(const SurfacePoint& point, const Vec3& direction)
{
    const double distance = glm::dot(glm::abs(point.normal), point.error);
    const double side = glm::dot(direction, point.normal) < 0 ? -1 : 1;
    return point.position + side * distance * point.normal;
}

} // namespace ref
