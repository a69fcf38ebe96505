#pragma once

// A scene in single precision, as arrays on the host. Kernels see them by scene_view.h.

#include "cuda/transport/scene_view.h"
#include "cuda/trees/scene_geometry.h"
#include "scenes/requirements.h"
#include "scenes/scene.h"

#include <vector>

namespace fast {

/// Brings the centre of the scene to the origin, and its diameter to a number from 1 to 2, by a power of
/// two: lengths that could be too large or too small for floats to square are not, and scaling a scene
/// by a power of two changes no bit. Radiance is the same at any scale.
Placement placement_of(const scenes::Scene& scene);

struct SceneArrays {
    Placement place; // placement_of the scene
    Needs needs = {};
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

/// `scene` as arrays. With no `roulette` every material lets every walk go on. All sums are formed in
/// double, and rounded once. Throws std::invalid_argument for a spot light that is narrower than floats
/// can hold, and where triangles that have no area as floats emit more than 2^-20 of the light.
SceneArrays scene_arrays(const scenes::Scene& scene, bool roulette);

/// The scene's camera for pictures of `width` x `height` pixels; the scene must have one.
Camera camera_of(const scenes::Scene& scene, const Placement& place, int width, int height);

/// The needs of a scene with these requirements. Coarser than they are where a distinction costs a
/// kernel more than it saves (docs/cuda-bdpt.md has the measurements).
Needs needs_of(const scenes::Requirements& required);

/// How many vertices of a light walk need room. No walk is longer than `max_edges` allows; and where
/// roulette ends walks, longer ones than this are rarer than 2^-24, which is the resolution of the
/// uniform numbers that decide about them.
int most_light_vertices(const SceneArrays& arrays, int max_edges);

} // namespace fast
