#include "ref/trees/geometry.h"

#include "ref/trees/intersect_primitive.h"
#include "ref/trees/rounding.h"
#include "ref/trees/scaled_length.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace ref {

Geometry::Geometry(const scenes::Scene& scene, const BuildOptions& tree, scenes::Coincidences coincident)
    : scene_(&scene), tree_(build(primitive_bounds(scene), tree)), coincident_(std::move(coincident))
{
    if (tree_.nodes.empty()) return;
    const Aabb& box = tree_.bounds[0];
    diagonal_ = glm::length(box.upper - box.lower);
    const Vec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper));
    slack_ = scenes::double_rounding * std::max({farthest.x, farthest.y, farthest.z});
}

namespace {

/// Whether `ray` reaches `primitive`, which it hits at `t`, from the side that the normal points to.
bool comes_from_front(const scenes::Scene& scene, const Ray& ray, double t, std::uint32_t primitive)
{
    if (primitive >= scene.triangles.size()) {
        const Vec3& center = scene.spheres[primitive - scene.triangles.size()].center;
        return glm::dot(ray.origin + t * ray.direction - center, ray.direction) < 0;
    }
    const auto& v = scene.triangles[primitive].vertices;
    return glm::dot(glm::cross(v[1] - v[0], v[2] - v[0]), ray.direction) < 0;
}

/// `hit` is on one of several coincident surfaces. Returns the hit on the one of them that `ray` sees
/// (scenes/contacts.h).
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
        std::optional<Hit> candidate = Hit{hit.t, other, Vec3(0)}; // every ray hits a coincident sphere
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
    // The ray starts one diagonal away, so that neither bound on t is near the surface.
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

// How far must a point be from a surface so that rays can start and segments can end there?
//
// Let u be the unit roundoff. Distances are measured along the normal n. A bound e_i on the error of
// each coordinate gives the bound sum |n_i| e_i along n. For a triangle, a_i is the extent of its box
// along axis i, and a is the largest a_i.
//
// 1. The computed position.
//    On a triangle, the computed U, V, W are rounded, but their weights U/det, V/det, W/det are still
//    the weights of a point inside the triangle, wherever the ray really met it. The position is
//    computed as v0 + (b1 e1 + b2 e2). Each b carries 3 roundings (two in det, one in the division),
//    each e carries 1, and the product and the inner sum carry 2. The bound is computed from the
//    rounded b, which costs one more: gamma_7 (b1 |e1| + b2 |e2|). The outer sum adds u |p|.
//    On a sphere the position is c + r (w / |w|). Here |w| carries 3 roundings, and the division and
//    the product carry 2: gamma_5 r |n_i|. The sum adds u |p|.
// 2. The origin o = p + s n is rounded by u |o|, which equals u |p| up to terms of second order.
// 3. A query is exact for perturbed vertices.
//    intersect_triangle decides exactly whether the ray passes inside the sheared vertices, and it
//    reports no t that rounding could have moved across 0 or t_max. So a ray cannot hit the triangle
//    if all perturbed vertices lie strictly below a plane parallel to the triangle and the ray does
//    not go below that plane. The same holds for a segment that has both ends above the plane.
//    Let m = v - o for a vertex v, and let |m| be the largest component of m. Along an axis i across
//    the ray, the vertex is perturbed
//      by u |m_i| in the difference v - o,
//      by 3 u |m| in S, in the product, and in the m_z part of the last difference,
//      by u |m_i| in the other part of the last difference,
//      by 2 u |m| along the ray, because t carries 2 roundings.
//    The sum is 2 u |m_i| + 5 u |m|. Along the longest axis it is 3 u |m|.
//    Where a ray starts on the triangle, |m_i| <= a_i: the sum is 2 u a_i + 5 u a. The size of the
//    scene does not matter.
//    Where a segment d ends on the triangle, |m_i| <= |d_i| + a_i. The comparison of t with t_max
//    adds u |d_i|, and the rounded direction adds another u |d_i|. This is 4 u |d_i| + 5 u |d| more
//    than at a start, which along n is less than 12.7 u |d| (where |d| is now the Euclidean length).
//    So the end of a segment is placed 16 u |d| farther off than a start.
//    The errors of the sphere test are smaller. Where a ray starts, f = o - c has an error of u r,
//    (b/a) d and l have one of u r each, and |l|^2 and r^2 act like 3 u r: 6 u r in total. The sign
//    of |f|^2 - r^2 is certain from 4 u r on. Where a segment ends, |f| <= |d| + r, which adds
//    3 u |d|, and t_max and the direction add another 3 u |d|.
// 4. The rounding in s n and the error of n are of second order. Counting 6 u a for 5 u a, and 8 u r
//    for 6 u r, covers them.
// 5. A surface that coincides with this one may be larger. In that case a and r are the diagonal of
//    the scene. A neighbour in the same plane needs no more than this triangle does where they share
//    an edge: next to the edge, the plane of the perturbed neighbour is that of the ends of the edge.
//
// The limit of every offset: n itself is wrong by an angle of about 4 u times the aspect ratio of the
// triangle (longest edge over smallest height). For a direction closer to the surface than that angle,
// the side to which it points is unknown. A path end that is not on a surface (a camera, a point
// light) needs no offset: Ray::on lists the surfaces that it lies on.

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
