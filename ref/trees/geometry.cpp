#include "ref/trees/geometry.h"

#include "ref/trees/intersect_primitive.h"
#include "ref/trees/rounding.h"

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

std::optional<Hit> intersect(const Geometry& geometry, const Ray& ray, Work* work)
{
    const ShearedRay sheared(ray);
    std::optional<Hit> closest;
    const Work done = traverse(geometry.tree(), ray, [&](std::uint32_t primitive) {
        const auto hit = intersect_primitive(geometry.scene(), ray, sheared, primitive);
        if (hit && (!closest || comes_before(*hit, *closest))) closest = hit;
        return closest ? closest->t : ray.t_max;
    });
    if (work != nullptr) *work += done;
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

bool occluded(const Geometry& geometry, const Ray& ray, Work* work)
{
    const ShearedRay sheared(ray);
    bool hit = false;
    const Work done = traverse(geometry.tree(), ray, [&](std::uint32_t primitive) {
        hit = hit || intersect_primitive(geometry.scene(), ray, sheared, primitive);
        return hit ? -1 : ray.t_max;
    });
    if (work != nullptr) *work += done;
    return hit;
}

// How far must a point be from a surface so that rays may start and segments end there?
//
// Let u be the unit roundoff and D the diagonal of the scene: two points of surfaces differ by at most
// D in every coordinate. Distances below count along the normal n; a bound e_i per coordinate makes
// sum |n_i| e_i.
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
//    ends above it. The shear perturbs z by 3 u D (difference, 1/dz, product), and x and y by 7 u D
//    each (the difference 1; S and the product 2; the last difference 2; and 2 for z's own
//    perturbation): sqrt(7^2 + 7^2 + 3^2) u D, less than 10.4 u D along n. That holds where a ray
//    starts and where a segment ends, since |v - o| <= D in both cases; at the end t - t_max adds u D,
//    and the rounded direction q' - p' another: 12.4 u D. The sphere test errs less: f = o - c by u D,
//    (b/a) d and l by u D each, |l|^2 and r^2 like 3 u r, and 2 r <= D: 5 u D; the sign of |f|^2 - r^2
//    is certain from 4 u r on.
// 4. Rounding in s n, and the error of n, are of second order: counting 16 u D for step 3 covers them.
//
// What no offset can promise: n itself is wrong by an angle of about 4 u times the triangle's aspect
// ratio (longest edge over smallest height). To which side a direction closer to the surface points is
// not known. An end that is no surface (a camera, a point light) needs no offset: the surfaces that it
// lies on are known by name (Ray::on).

namespace {

/// Steps 1 to 4, given the part of step 1 that depends on the shape; and beyond the surfaces that
/// coincide with this one.
Vec3 clearance(const Geometry& geometry, std::uint32_t primitive, const Vec3& position,
               const Vec3& shape_error)
{
    return shape_error + 2 * unit_roundoff * glm::abs(position) +
           16 * unit_roundoff * geometry.diagonal() + geometry.coincidence_slack(primitive);
}

} // namespace

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
    point.error = clearance(geometry, triangle, point.position,
                            gamma_bound(7) * (b1 * glm::abs(e1) + b2 * glm::abs(e2)));
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
    point.error = clearance(geometry, point.primitive, point.position,
                            gamma_bound(5) * s.radius * glm::abs(point.normal));
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
