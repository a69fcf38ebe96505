#pragma once

// A scene as plain data, in world space: what a file says, with nothing derived from it. Both wings
// start from here. Lengths are those of the file; colours are linear RGB with Rec.709 primaries.

#include <glm/vec3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace scenes {

using Vec3 = glm::dvec3;
using Rgb = glm::dvec3;

/// Reflects `albedo` / pi in every direction, on both sides of the surface. 0 <= albedo <= 1.
struct Lambertian {
    Rgb albedo;
};

/// A perfect mirror on both sides. 0 <= reflectance <= 1.
struct Mirror {
    Rgb reflectance;
};

/// A smooth dielectric boundary: index of refraction `ior` > 0 on the side that the geometric normal
/// points away from, 1 on the other. The colours scale what Fresnel's equations reflect and transmit.
struct Glass {
    Rgb reflectance;
    Rgb transmittance;
    double ior;
};

/// Emits `radiance` (W m^-2 sr^-1) diffusely on the side of the geometric normal; reflects nothing.
struct Emission {
    Rgb radiance;
};

using Material = std::variant<Lambertian, Mirror, Glass, Emission>;

/// The geometric normal is (v1 - v0) x (v2 - v0): counter-clockwise seen from the front.
struct Triangle {
    std::array<Vec3, 3> vertices;
    std::uint32_t material; // index into Scene::materials
};

/// The geometric normal points away from the centre. radius > 0.
struct Sphere {
    Vec3 center;
    double radius;
    std::uint32_t material;
};

/// `intensity` in W sr^-1; irradiance falls with the inverse square of the distance.
struct PointLight {
    Vec3 position;
    Rgb intensity;
};

/// `irradiance` in W m^-2 on a surface facing the light, which travels along the unit `direction`.
struct DirectionalLight {
    Vec3 direction;
    Rgb irradiance;
};

/// A point light of intensity I(theta) = `intensity` * cos(theta)^exponent for cos(theta) > cos_cutoff
/// and 0 elsewhere, theta measured from the unit `direction`. -1 <= cos_cutoff < 1, exponent >= 0;
/// where cos(theta) <= 0 and exponent > 0 the intensity is 0.
struct SpotLight {
    Vec3 position;
    Vec3 direction;
    Rgb intensity;
    double cos_cutoff;
    double exponent;
};

enum class FovAxis { horizontal, vertical };

/// A pinhole: looks along -`backward`. The axes are orthonormal. `fov` is the full angle (radians,
/// 0 < fov < pi) that the whole picture spans along `fov_axis`; pixels are square.
struct Camera {
    Vec3 eye;
    Vec3 right;
    Vec3 up;
    Vec3 backward;
    FovAxis fov_axis;
    double fov;
};

struct Scene {
    std::string name; // file name without folder and ending
    std::string hash; // of the file's bytes, hexadecimal

    std::vector<Material> materials;
    std::vector<std::string> material_names; // one per material, for messages
    std::vector<Triangle> triangles;
    std::vector<Sphere> spheres;

    std::vector<PointLight> point_lights;
    std::vector<DirectionalLight> directional_lights;
    std::vector<SpotLight> spot_lights;
    std::optional<Rgb> environment; // constant radiance (W m^-2 sr^-1) from every direction

    std::optional<Camera> camera;

    /// The length here of one unit of length of the file: a power of two (placed.h).
    double unit = 1.0;

    /// Notices for the user about the interpretation of the file; one line each.
    std::vector<std::string> notices;
};

/// Primitives are numbered through: first the triangles, then the spheres.
inline std::uint32_t primitive_count(const Scene& scene)
{
    return static_cast<std::uint32_t>(scene.triangles.size() + scene.spheres.size());
}

/// The material index of primitive `primitive` (see primitive_count for the numbering).
inline std::uint32_t material_of(const Scene& scene, std::uint32_t primitive)
{
    const auto triangles = static_cast<std::uint32_t>(scene.triangles.size());
    return primitive < triangles ? scene.triangles[primitive].material
                                 : scene.spheres[primitive - triangles].material;
}

} // namespace scenes
