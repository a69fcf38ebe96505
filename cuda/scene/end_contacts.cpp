#include "cuda/scene/end_contacts.h"

#include "cuda/scene/coincident_arrays.h"
#include "cuda/trees/clearance.h"
#include "scenes/contacts.h"
#include "scenes/for_each_light.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace fast {

namespace {

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

void add_end_contacts(SceneArrays& arrays, const scenes::Scene& scene)
{
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
