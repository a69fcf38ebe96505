#include "ref/trees/geometry.h"

#include "ref/trees/intersect_primitive.h"
#include "ref/trees/rounding.h"
#include "ref/trees/scaled_length.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace ref {

Geometry::Geometry(const scenes::Scene& scene, Builder builder, scenes::Coincidences coincident)
    : scene_(&scene), tree_(build(primitive_bounds(scene), builder)), coincident_(std::move(coincident))
{
    if (tree_.nodes.empty()) return;
    const Aabb& box = tree_.bounds[0];
    diagonal_ = glm::length(box.upper - box.lower);
    const Vec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    slack_ = scenes::double_rounding * std::max({farthest.x, farthest.y, farthest.z});
}

namespace {

/// Whether `ray` comes from the side of the normal of `primitive`, which it meets at `t`.
bool comes_from_front(const scenes::Scene& scene, const Ray& ray, double t, std::uint32_t primitive)
{
    if (primitive >= scene.triangles.size()) {
        const Vec3& center = scene.spheres[primitive - scene.triangles.size()].center;
        return glm::dot(ray.origin + t * ray.direction - center, ray.direction) < 0;
    }
    const auto& v = scene.triangles[primitive].vertices;
    return glm::dot(glm::cross(v[1] - v[0], v[2] - v[0]), ray.direction) < 0;
}

/// Of the surfaces that coincide where `hit` is, the hit of the one that `ray` sees (scenes/contacts.h).
Hit first_of_coincident(const Geometry& geometry, const Ray& ray, const Hit& hit)
{
    const scenes::Scene& scene = geometry.scene();
    const auto order = [&](const Hit& h) {
        const auto& material = scene.materials[scenes::material_of(scene, h.primitive)];
        return std::pair(scenes::meeting_rank(material, comes_from_front(scene, ray, h.t, h.primitive)),
                         h.primitive);
    };
    const ShearedRay sheared(ray);
    Hit first = hit;
    for (const std::uint32_t other : geometry.coincident().of(hit.primitive)) {
        std::optional<Hit> candidate = Hit{hit.t, other, Vec3(0)}; // a sphere is met everywhere
        if (other < scene.triangles.size()) candidate = intersect_primitive(scene, ray, sheared, other);
        if (candidate && order(*candidate) < order(first)) first = *candidate;
    }
    return first;
}

} // namespace

std::optional<Hit> intersect(const Geometry& geometry, const Ray& ray, TraversalCounts* counts)
{
    const ShearedRay sheared(ray);
    std::optional<Hit> closest;
    const TraversalCounts done = traverse(geometry.tree(), ray, [&](std::uint32_t primitive) {
        const auto hit = intersect_primitive(geometry.scene(), ray, sheared, primitive);
        if (hit && (!closest || comes_before(*hit, *closest))) closest = hit;
        return closest ? closest->t : ray.t_max;
    });
    if (counts != nullptr) *counts += done;
    if (closest && !geometry.coincident().empty()) return first_of_coincident(geometry, ray, *closest);
    return closest;
}

bool sees_first(const Geometry& geometry, const SurfacePoint& point, const Vec3& towards)
{
    if (geometry.coincident().of(point.primitive).empty()) return true;
    // From a diagonal away, so that no bound on t is near the surface.
    const Ray ray{point.position + geometry.diagonal() * towards, -towards};
    const Hit hit{geometry.diagonal(), point.primitive, Vec3(0)};
    return first_of_coincident(geometry, ray, hit).primitive == point.primitive;
}

bool occluded(const Geometry& geometry, const Ray& ray, TraversalCounts* counts)
{
    const ShearedRay sheared(ray);
    bool hit = false;
    const TraversalCounts done = traverse(geometry.tree(), ray, [&](std::uint32_t primitive) {
        hit = hit || intersect_primitive(geometry.scene(), ray, sheared, primitive);
        return hit ? -1 : ray.t_max;
    });
    if (counts != nullptr) *counts += done;
    return hit;
}

// How far must a point be from a surface so that rays may start and segments end there?
//
// Let u be the unit roundoff. Distances count along the normal n; a bound e_i per coordinate makes
// sum |n_i| e_i. Of a triangle let a_i be the extent of its box along axis i, and a the largest of them.
//
// 1. The computed position. On a triangle, the weights U/det, V/det, W/det of the doubles U, V, W are
//    those of a point inside the triangle, wherever the ray really met it. It is computed as v0 + (b1
//    e1 + b2 e2): each b carries 3 roundings (two in det, one division), each e 1, product and inner
//    sum 2, and stating the bound with the computed b one more, gamma_7 (b1 |e1| + b2 |e2|); the outer
//    sum rounds by u |p|. On a sphere it is c + r (w / |w|): |w| carries 3, division and product 2,
//    gamma_5 r |n_i|, and the sum u |p|.
// 2. The origin o = p + s n is rounded by u |o|, which is u |p| but for terms of second order.
// 3. A query answers exactly, but for perturbed vertices: intersect_triangle decides exactly whether
//    the ray passes inside the sheared vertices, and reports no t that rounding could have carried
//    across 0 or t_max. So a ray cannot hit if the perturbed vertices all lie strictly below a plane
//    parallel to the triangle, below which the ray does not go; and likewise a segment that has both
//    ends above it. A vertex at m = v - o is perturbed along an axis i across the ray by u |m_i| (the
//    difference), 3 u |m| (S, the product, and of the last difference the part of m_z) and u |m_i| (the
//    other part), and with t, which carries 2 roundings, by 2 u |m|: 2 u |m_i| + 5 u |m|, where |m| is
//    the largest component. Along the longest axis it is 3 u |m|.
//    Where a ray starts, on the triangle, |m_i| <= a_i: 2 u a_i + 5 u a. The size of the scene does not
//    count. Where a segment d ends on it, |m_i| <= |d_i| + a_i, t - t_max adds u |d_i|, and the rounded
//    direction another: 4 u |d_i| + 5 u |d| more, which along n is less than 12.7 u |d| (now the
//    Euclidean length): the end is 16 u |d| further off than a start.
//    The sphere test errs less. Where a ray starts, f = o - c errs by u r, (b/a) d and l by u r each,
//    |l|^2 and r^2 like 3 u r: 6 u r; the sign of |f|^2 - r^2 is certain from 4 u r on. Where a segment
//    ends, |f| <= |d| + r: 3 u |d| more, and 3 u |d| for t_max and direction.
// 4. Rounding in s n, and the error of n, are of second order: counting 6 u a for 5 u a and 8 u r for
//    6 u r covers them.
// 5. A surface that coincides with this one may be larger: then a and r are the diagonal of the scene.
//    A neighbour in the same plane needs no more than this triangle does, where they share an edge: next
//    to it the plane of the neighbour as perturbed is that of the edge's ends.
//
// What no offset can promise: n itself is wrong by an angle of about 4 u times the triangle's aspect
// ratio (longest edge over smallest height). To which side a direction closer to the surface points is
// not known. An end that is no surface (a camera, a point light) needs no offset: the surfaces that it
// lies on are known by name (Ray::on).

SurfacePoint triangle_point(const Geometry& geometry, std::uint32_t triangle, const Vec3& barycentric)
{
    const auto& v = geometry.scene().triangles[triangle].vertices;
    const Vec3 e1 = v[1] - v[0];
    const Vec3 e2 = v[2] - v[0];
    const double b1 = barycentric[1];
    const double b2 = barycentric[2];
    const Vec3 box = glm::max(glm::max(v[0], v[1]), v[2]) - glm::min(glm::min(v[0], v[1]), v[2]);
    const Vec3 a = geometry.extent(triangle, box);
    SurfacePoint point{};
    point.primitive = triangle;
    point.material = geometry.scene().triangles[triangle].material;
    point.position = v[0] + (b1 * e1 + b2 * e2);
    point.normal = scaled_normalize(glm::cross(e1, e2));
    point.error =
        gamma_bound(7) * (b1 * glm::abs(e1) + b2 * glm::abs(e2)) +
        unit_roundoff * (2.0 * glm::abs(point.position) + 2.0 * a + 6 * scenes::largest_component(a)) +
        geometry.coincidence_slack(triangle);
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
                  unit_roundoff * (2.0 * glm::abs(point.position) +
                                   8.0 * geometry.extent(point.primitive, Vec3(s.radius))) +
                  geometry.coincidence_slack(point.primitive);
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

namespace {

/// `point.position` moved off the surface by `distance`, to the side that `direction` points to.
Vec3 moved_off(const SurfacePoint& point, const Vec3& direction, double distance)
{
    const double side = glm::dot(direction, point.normal) < 0 ? -1 : 1;
    return point.position + side * distance * point.normal;
}

} // namespace

Vec3 leave_surface(const SurfacePoint& point, const Vec3& direction)
{
    return moved_off(point, direction, glm::dot(glm::abs(point.normal), point.error));
}

Vec3 end_at_surface(const SurfacePoint& point, const Vec3& back)
{
    return moved_off(point, back,
                     glm::dot(glm::abs(point.normal), point.error) +
                         16 * unit_roundoff * glm::length(back));
}

} // namespace ref
