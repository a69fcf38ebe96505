#include "scenes/longest_path.h"

#include "scenes/is_emitter.h"

#include <algorithm>
#include <variant>

namespace scenes {

namespace {

/// Whether a path can go on from a surface of this material.
bool scatters_light(const Material& material)
{
    if (const auto* lambertian = std::get_if<Lambertian>(&material))
        return lambertian->albedo != Rgb(0.0);
    return !std::holds_alternative<Emission>(material);
}

/// Whether all scattering triangles have the same coordinate `axis` at all their corners.
bool lie_in_one_plane(const Scene& scene, int axis)
{
    std::optional<double> plane;
    return std::ranges::all_of(scene.triangles, [&](const Triangle& triangle) {
        if (!scatters_light(scene.materials[triangle.material])) return true;
        return std::ranges::all_of(triangle.vertices, [&](const Vec3& corner) {
            if (!plane) plane = corner[axis];
            return corner[axis] == *plane;
        });
    });
}

} // namespace

std::optional<int> longest_path(const Scene& scene)
{
    if (!scene.camera || !has_emitter(scene)) return 0;
    const auto scatters = [&](const auto& surface) {
        return scatters_light(scene.materials[surface.material]);
    };
    if (std::ranges::any_of(scene.spheres, scatters)) return std::nullopt;
    if (std::ranges::none_of(scene.triangles, scatters)) return 1;
    for (int axis = 0; axis < 3; ++axis)
        if (lie_in_one_plane(scene, axis)) return 2;
    return std::nullopt;
}

} // namespace scenes
