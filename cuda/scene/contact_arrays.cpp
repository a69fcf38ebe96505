#include "cuda/scene/contact_arrays.h"

#include "cuda/transport/surface_point.h"
#include "cuda/trees/clearance.h"
#include "scenes/contacts.h"
#include "scenes/for_each_light.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace fast {

namespace {

/// The largest distance of surfaces that coincide as floats, relative to a coordinate. Each coordinate
/// of both surfaces is rounded once, and this changes the distance of their planes by up to sqrt(3)
/// times as much.
constexpr double float_rounding = 4 * unit_roundoff;

/// The largest clearance of any surface, at the end of the longest segment, in units of the scene's
/// diagonal: 18 u for the rounding of the ray, the end and the surface (end_clearance), plus that of
/// clearance.h; for a sphere 30 u.
constexpr double largest_clearance = 30 * unit_roundoff + clearance_per_length;

/// The scene where the arrays have it, in double precision. Its materials and names are left out.
scenes::Scene moved(const scenes::Scene& scene, const Placement& place)
{
    scenes::Scene result;
    result.triangles = scene.triangles;
    result.spheres = scene.spheres;
    const auto move = [&](scenes::Vec3& x) { x = (x - place.origin) * place.scale; };
    for (auto& triangle : result.triangles)
        for (scenes::Vec3& v : triangle.vertices) move(v);
    for (auto& sphere : result.spheres) {
        move(sphere.center);
        sphere.radius *= place.scale;
    }
    return result;
}

/// On which side of triangle `a` the middle of triangle `b` is: 1 that of the normal.
int side_of(const scenes::Triangle& a, const scenes::Triangle& b)
{
    const auto& v = a.vertices;
    const scenes::Vec3 middle = (b.vertices[0] + b.vertices[1] + b.vertices[2]) / 3.0;
    const double height = glm::dot(glm::cross(v[1] - v[0], v[2] - v[0]), middle - v[0]);
    return height < 0 ? -1 : height > 0 ? 1 : 0;
}

/// The same for any two primitives that coincide as floats.
int side_of(const scenes::Scene& here, std::uint32_t a, std::uint32_t b)
{
    const auto triangles = static_cast<std::uint32_t>(here.triangles.size());
    if (a < triangles) return side_of(here.triangles[a], here.triangles[b]);
    return here.spheres[b - triangles].radius < here.spheres[a - triangles].radius ? -1 : 1;
}

/// On which side of the plane of `a` all corners of `b` are; 0 if they are not on one side.
int side_of_all(const scenes::Triangle& a, const scenes::Triangle& b)
{
    const auto& v = a.vertices;
    const scenes::Vec3 across = glm::cross(v[1] - v[0], v[2] - v[0]);
    double low = 0;
    double high = 0;
    for (const scenes::Vec3& corner : b.vertices) {
        const double height = glm::dot(across, corner - v[0]);
        low = std::min(low, height);
        high = std::max(high, height);
    }
    return low < 0 && high > 0 ? 0 : high > 0 ? 1 : low < 0 ? -1 : 0;
}

/// On which side of `a` the whole of `b` is that lies over it; 0 where they cross: then floats decide,
/// which tell them apart almost everywhere.
int side_if_apart(const scenes::Scene& here, std::uint32_t a, std::uint32_t b)
{
    if (a >= here.triangles.size()) return side_of(here, a, b);
    const scenes::Triangle& ta = here.triangles[a];
    const scenes::Triangle& tb = here.triangles[b];
    if (const int side = side_of_all(ta, tb); side != 0) return side;
    const auto across = [](const scenes::Triangle& t) {
        return glm::cross(t.vertices[1] - t.vertices[0], t.vertices[2] - t.vertices[0]);
    };
    return glm::dot(across(ta), across(tb)) > 0 ? -side_of_all(tb, ta) : side_of_all(tb, ta);
}

float largest_extent(const Triangle& triangle)
{
    const auto& v = triangle.vertices;
    return max_component(triangle_extent(v[1] - v[0], v[2] - v[0]));
}

void add_coincident(SceneArrays& arrays, const scenes::Scene& scene, const scenes::Scene& here)
{
    const scenes::Coincidences near =
        scenes::coincidences(here, float_rounding, nullptr, largest_clearance * arrays.diagonal);
    const scenes::Coincidences in_floats = scenes::coincidences(here, float_rounding);
    // Neither has all of the other: triangles that are smaller than a distance are not that near.
    if (near.empty() && in_floats.empty()) return;
    const scenes::Coincidences in_doubles = scenes::coincidences(scene);
    for (std::uint32_t i = 0; i < scenes::primitive_count(here); ++i) {
        SurfaceContacts contacts{static_cast<std::uint32_t>(arrays.coincident.size()), 0, 0};
        const auto coincident = in_floats.of(i);
        const bool is_triangle = i < here.triangles.size();
        float largest = is_triangle ? largest_extent(arrays.triangles[i])
                                    : 2 * arrays.spheres[i - here.triangles.size()].radius;
        if (is_triangle)
            for (const std::uint32_t other : coincident)
                largest = std::max(largest, largest_extent(arrays.triangles[other]));
        for (const std::uint32_t other : coincident) {
            const bool known = !std::ranges::binary_search(in_doubles.of(i), other);
            arrays.coincident.push_back({other, known ? side_of(here, i, other) : 0, largest});
        }
        contacts.coincident_count = static_cast<std::uint32_t>(coincident.size());
        for (const std::uint32_t other : near.of(i)) {
            if (std::ranges::binary_search(coincident, other)) continue;
            const int side = side_if_apart(here, i, other);
            if (side == 0) continue;
            arrays.coincident.push_back({other, side, largest});
            ++contacts.near_count;
        }
        if (arrays.coincident.size() > std::numeric_limits<std::uint32_t>::max())
            throw std::invalid_argument("more than 2^32 - 1 pairs of surfaces that coincide");
        if (contacts.coincident_count + contacts.near_count == 0) continue;
        arrays.surfaces[i].contacts = static_cast<std::uint32_t>(arrays.surface_contacts.size());
        arrays.surface_contacts.push_back(contacts);
    }
}

bool coincides(const SceneArrays& arrays, const Surface& surface)
{
    return arrays.surface_contacts[surface.contacts].coincident_count > 0;
}

/// The extent of the largest surface that coincides with this one.
float largest_coincident(const SceneArrays& arrays, const Surface& surface)
{
    return arrays.coincident[arrays.surface_contacts[surface.contacts].first_coincident].largest_size;
}

/// And the normals and margins of triangles.
void add_clearances(SceneArrays& arrays)
{
    for (std::size_t i = 0; i < arrays.triangles.size(); ++i) {
        const auto& v = arrays.triangles[i].vertices;
        const Vec3 e1 = v[1] - v[0];
        const Vec3 e2 = v[2] - v[0];
        Surface& surface = arrays.surfaces[i];
        const Vec3 extent = coincides(arrays, surface) ? Vec3(largest_coincident(arrays, surface))
                                                       : triangle_extent(e1, e2);
        surface.normal = unit_normal(e1, e2);
        surface.edge_margin = edge_margin(v[0], e1, e2);
        surface.clearance = triangle_clearance(surface.normal, e1, e2, extent);
    }
    for (std::size_t i = 0; i < arrays.spheres.size(); ++i)
        arrays.surfaces[arrays.triangles.size() + i].clearance =
            sphere_clearance(arrays.spheres[i].radius);
}

/// A plane that an end lies on or near.
struct Plane {
    scenes::Vec3 normal;
    int side;         // 0: on it
    double clearance; // how far a ray from the end must be moved; negative where it is clear already
};

/// The distance from a primitive at which a ray must begin that leaves an end at `position` on the
/// primitive or near it, in the arrays' unit of length. It is the clearance of clearance.h plus the
/// errors of the end and of the surface, which were rounded to floats after the contacts had been found.
/// Both move along every axis by up to u times their coordinate, and so does the sum that is the origin
/// of the ray: along the normal by sqrt(3) times that.
double end_clearance(const SceneArrays& arrays, std::uint32_t primitive, const Vec3& position)
{
    const auto largest = [](const Vec3& v) { return static_cast<double>(max_component(glm::abs(v))); };
    const double root_3 = std::sqrt(3.0);
    const double rounded = 2 * root_3 * largest(position);
    if (primitive >= arrays.triangles.size()) {
        const Sphere& sphere = arrays.spheres[primitive - arrays.triangles.size()];
        return unit_roundoff * (rounded + root_3 * largest(sphere.center) + 50.0 * sphere.radius);
    }
    const auto& v = arrays.triangles[primitive].vertices;
    const Surface& surface = arrays.surfaces[primitive];
    const double extent = coincides(arrays, surface)
                              ? largest_coincident(arrays, surface)
                              : largest(triangle_extent(v[1] - v[0], v[2] - v[0]));
    const double farthest = std::max({largest(v[0]), largest(v[1]), largest(v[2])});
    return unit_roundoff * (rounded + root_3 * farthest + 8 * root_3 * extent);
}

/// The distance of `position` from a sphere, or from the plane of a triangle.
double distance_from(const scenes::Scene& scene, const scenes::NearSurface& surface,
                     const scenes::Vec3& position)
{
    if (surface.primitive < scene.triangles.size())
        return std::abs(
            glm::dot(position - scene.triangles[surface.primitive].vertices[0], surface.normal));
    const scenes::Sphere& sphere = scene.spheres[surface.primitive - scene.triangles.size()];
    return std::abs(glm::length(position - sphere.center) - sphere.radius);
}

/// The component of `v` orthogonal to the normals of `planes`, which are independent.
scenes::Vec3 orthogonal_part(scenes::Vec3 v, const std::vector<Plane>& planes)
{
    std::vector<scenes::Vec3> basis; // orthonormal, of that span [Gram-Schmidt]
    for (const Plane& plane : planes) {
        scenes::Vec3 axis = plane.normal;
        for (const scenes::Vec3& b : basis) axis -= glm::dot(axis, b) * b;
        basis.push_back(glm::normalize(axis));
    }
    for (const scenes::Vec3& b : basis) v -= glm::dot(v, b) * b;
    return v;
}

/// Up to three planes whose normals are independent: those that the end is on first. A plane that is
/// nearly parallel to one of them is the same plane; a fourth is left out.
std::vector<Plane> independent(std::vector<Plane> planes)
{
    std::ranges::stable_sort(planes, {}, [](const Plane& plane) { return plane.side != 0; });
    std::vector<Plane> result;
    for (const Plane& plane : planes)
        if (glm::length(orthogonal_part(plane.normal, result)) > 1e-3) result.push_back(plane);
    return result;
}

/// The vectors m_i in the span of the normals n_j with dot(m_i, n_j) = 1 for i = j and 0 else: a step
/// along m_i changes the distance from plane i alone.
std::vector<scenes::Vec3> dual_basis(const std::vector<Plane>& planes)
{
    std::vector<scenes::Vec3> dual;
    for (std::size_t i = 0; i < planes.size(); ++i) {
        std::vector<Plane> others = planes;
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        const scenes::Vec3 m = orthogonal_part(planes[i].normal, others);
        dual.push_back(m / glm::dot(m, planes[i].normal));
    }
    return dual;
}

/// The surfaces that an end at `position` of the scene touches. They are found from the coordinates of
/// the file, in double.
EndContacts contacts_of(SceneArrays& arrays, const scenes::Scene& scene, const scenes::Vec3& position)
{
    const double D = arrays.diagonal;
    const double near = largest_clearance * D;
    EndContacts contacts{};
    contacts.first_plane = static_cast<std::uint32_t>(arrays.contact_planes.size());
    contacts.first_triangle = static_cast<std::uint32_t>(arrays.contact_triangles.size());
    std::vector<Plane> planes;
    for (const scenes::NearSurface& surface :
         scenes::surfaces_near(scene, position, near / arrays.place.scale)) {
        const double distance =
            surface.side == 0 ? 0 : distance_from(scene, surface, position) * arrays.place.scale;
        const double clearance =
            end_clearance(arrays, surface.primitive, arrays.place(position)) - distance;
        if (!(clearance + clearance_per_length * D > 0)) continue;
        planes.push_back({surface.normal, surface.side, clearance});
        if (surface.primitive < scene.triangles.size() && surface.side == 0)
            arrays.contact_triangles.push_back(surface.primitive);
    }
    planes = independent(std::move(planes));
    const std::vector<scenes::Vec3> dual = dual_basis(planes);
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const auto clearance = static_cast<float>(planes[i].clearance);
        if (planes[i].side == 0)
            arrays.contact_planes.push_back({Vec3(planes[i].normal), Vec3(dual[i]), clearance});
        else
            arrays.contact_planes.push_back(
                {Vec3(0.0f), Vec3(static_cast<double>(planes[i].side) * dual[i]), clearance});
    }
    contacts.plane_count =
        static_cast<std::uint32_t>(arrays.contact_planes.size()) - contacts.first_plane;
    contacts.triangle_count =
        static_cast<std::uint32_t>(arrays.contact_triangles.size()) - contacts.first_triangle;
    return contacts;
}

} // namespace

void add_contacts(SceneArrays& arrays, const scenes::Scene& scene)
{
    add_coincident(arrays, scene, moved(scene, arrays.place));
    add_clearances(arrays);
    // Lights follow the surfaces among the emitters, in the order of for_each_light.
    auto emitter = static_cast<std::size_t>(
        std::ranges::find_if(arrays.emitters,
                             [](const Emitter& e) { return !is_surface<any_needs>(e); }) -
        arrays.emitters.begin());
    scenes::for_each_light(scene, [&](const auto& light, std::size_t) {
        if constexpr (scenes::has_position<decltype(light)>)
            arrays.lights[emitter].contacts = contacts_of(arrays, scene, light.position);
        ++emitter;
    });
    if (scene.camera) arrays.eye_contacts = contacts_of(arrays, scene, scene.camera->eye);
}

} // namespace fast
