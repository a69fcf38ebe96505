#pragma once

// A scene's data in single precision, on the host: what scene_view.h shows to kernels.

#include "cuda/transport/scene_view.h"
#include "cuda/trees/scene_geometry.h"
#include "scenes/scene.h"

#include <vector>

namespace fast {

/// Brings the centre of the scene to the origin, and its diameter to a number from 1 to 2, by a power of
/// two: lengths that could be too large or too small for floats to square are not, and scaling a scene
/// by a power of two changes no bit. Radiance is the same at any scale.
Placement placement_of(const scenes::Scene& scene);

struct SceneArrays {
    Placement place; // placement_of the scene
    std::vector<Triangle> triangles;
    std::vector<Sphere> spheres;
    std::vector<Surface> surfaces; // by primitive, numbered as by scenes::primitive_count
    std::vector<Material> materials;
    std::vector<Emitter> emitters;
    std::vector<float> cumulative; // none if no emitter has power (emitter_choice.h)
    std::vector<Light> lights;     // by emitter
    std::vector<SurfaceContacts> surface_contacts = {{}};
    std::vector<Coincident> coincident;
    std::vector<ContactPlane> contact_planes;
    std::vector<std::uint32_t> contact_triangles;
    EndContacts eye_contacts = {};
    bool has_environment = false;
    float radius = 0;
    float diagonal = 0;
    float largest_survival = 0; // of all materials of surfaces: what a walk's length is bounded by
};

/// What floats can hold of a spot light.
///
/// Directions as floats lie on a grid of about u = 2^-24. So the axis may be tilted by 1.5 u, by which
/// the light moves; and near the edge of a cone of half angle a some grid points are on the wrong side.
/// The power changes little by it: relatively by (u/a)^(4/3), which is the error of an area that is
/// measured by counting the points of a grid, and by (8 u / a)^2, as the lengths of unit vectors are
/// rounded, too (versine in emitter.h). For the narrowest cone u/a is 2^-8: less than 1e-3 each.
/// The lobe of an exponent n is about 1/sqrt(n) wide, and that of the largest one 2^-16.
///
/// The versine 1 - c itself is computed from the cosine c of the scene, a double: its rounding, 2^-54,
/// is less than 1e-6 of the versine of the narrowest cone.
constexpr double least_half_angle = 0x1p-16; // 0.00175 degrees for the whole cone
constexpr double most_exponent = 0x1p32;

/// `scene` as arrays. With no `roulette` every material lets every walk go on. All sums are formed in
/// double, and rounded once. Throws std::invalid_argument for a spot light that is narrower than floats
/// can hold, and where triangles that have no area as floats emit more than 2^-20 of the light.
SceneArrays scene_arrays(const scenes::Scene& scene, bool roulette);

/// The scene's camera for pictures of `width` x `height` pixels; the scene must have one.
Camera camera_of(const scenes::Scene& scene, const Placement& place, int width, int height);

/// What kernels for the scene must be able to do. Finer than scenes::requirements says where a
/// distinction costs a kernel more than it saves (docs/cuda-bdpt.md has the measurements).
Needs needs_of(const SceneArrays& arrays);

/// How many vertices of a light walk need room. No walk is longer than `max_edges` allows; and where
/// roulette ends walks, longer ones than this are rarer than 2^-24, which is the resolution of the
/// uniform numbers that decide about them.
int most_light_vertices(const SceneArrays& arrays, int max_edges);

} // namespace fast
