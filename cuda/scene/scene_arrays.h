#pragma once

// A scene in single precision, as arrays on the host. Kernels see them by scene_view.h.

#include "cuda/transport/scene_view.h"
#include "cuda/trees/scene_geometry.h"
#include "scenes/requirements.h"
#include "scenes/scene.h"

#include <vector>

namespace fast {

/// Moves the centre of the scene to the origin, and scales by a power of two so that its diameter is
/// between 1 and 2. So no square of a length overflows or underflows as a float, and scaling a scene by
/// a power of two changes no bit. Radiance is the same at any scale.
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
    float largest_survival =
        0; // the largest of all materials of surfaces: it bounds the length of walks
};

/// `scene` as arrays. With no `roulette` every material lets every walk go on. All sums are formed in
/// double, and rounded once. Throws std::invalid_argument for a spot light that is narrower than floats
/// can hold, and where triangles that have no area as floats emit more than 2^-20 of the light.
SceneArrays scene_arrays(const scenes::Scene& scene, bool roulette);

/// The scene's camera for pictures of `width` x `height` pixels; the scene must have one.
Camera camera_of(const scenes::Scene& scene, const Placement& place, int width, int height);

/// The needs of a scene with these requirements, apart from coincident surfaces, of which they tell
/// nothing. Coarser than they are where a distinction costs a kernel more than it saves
/// (docs/results/cuda-bdpt.md has the measurements).
Needs needs_of(const scenes::Requirements& required);

/// The number of vertices of a light walk that memory is needed for. No walk is longer than `max_edges`
/// allows. Where roulette ends walks, longer walks than this have a probability below 2^-24, which is
/// the resolution of the uniform numbers.
int most_light_vertices(const SceneArrays& arrays, int max_edges);

} // namespace fast
