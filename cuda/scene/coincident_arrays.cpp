#include "cuda/scene/coincident_arrays.h"

#include "cuda/transport/surface_point.h"
#include "cuda/trees/clearance.h"
#include "scenes/contacts.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace fast {

namespace {

/// The largest distance of surfaces that coincide as floats, relative to a coordinate. Each coordinate
/// of both surfaces is rounded once, and this changes the distance of their planes by up to sqrt(3)
/// times as much.
constexpr double float_rounding = 4 * unit_roundoff;

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

} // namespace

void add_coincident(SceneArrays& arrays, const scenes::Scene& scene)
{
    const scenes::Scene here = moved(scene, arrays.place);
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

float largest_coincident(const SceneArrays& arrays, const Surface& surface)
{
    return arrays.coincident[arrays.surface_contacts[surface.contacts].first_coincident].largest_size;
}

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

} // namespace fast
