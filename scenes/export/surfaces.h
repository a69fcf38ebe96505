#pragma once

// What the writers have in common: the triangles of a scene as meshes, names of materials, and the
// frames of lights.

#include "scenes/scene.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scenes::exports {

/// All triangles of one material, with the winding of the scene.
struct Mesh {
    std::uint32_t material;
    std::vector<Vec3> points; // no two are equal
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The triangles of `scene`, a mesh for each material that has any, in the order of the materials.
/// Triangles without area stop no ray and are left out.
std::vector<Mesh> meshes_of(const Scene& scene);

/// Whether `material` emits light. A black emission does not.
bool emits(const Material& material);

/// A name for the material with the index `material` that is unique in the scene and consists of
/// letters, digits and underscores.
std::string unique_name(const Scene& scene, std::uint32_t material);

/// The same colour in all channels.
inline bool is_grey(const Rgb& colour)
{
    return colour.x == colour.y && colour.y == colour.z;
}

/// Three axes, perpendicular and of unit length, x cross y = z, for a unit vector z.
std::array<Vec3, 3> frame_of(const Vec3& z);

/// The distance from the camera's eye beyond which nothing is, with a margin: at least twice the
/// distance of the farthest corner of the scene's bounding box. The scene must have a camera.
double reach_of(const Scene& scene);

/// `file_name` without its ending.
std::string stem_of(std::string_view file_name);

/// Throws the SceneError "SCENE: THING: FORMAT WHY".
[[noreturn]] void refuse(const Scene& scene, const std::string& thing, const std::string& why);

/// Refuses a spot light whose intensity is not the same in all of its cone. `format` has no such light.
void expect_constant(const Scene& scene, const SpotLight& light, std::size_t index,
                     const std::string& format);

/// The name of a material for messages.
std::string material_name(const Scene& scene, std::uint32_t material);

} // namespace scenes::exports
