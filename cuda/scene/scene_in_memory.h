#pragma once

// A scene in the memory that kernels access.

#include "cuda/parallel/buffer.h"
#include "cuda/scene/scene_arrays.h"
#include "cuda/trees/surfaces.h"

namespace fast {

class SceneInMemory {
public:
    template <Executor E>
    SceneInMemory(Memory& memory, E& executor, const SceneArrays& arrays, const Camera& camera,
                  TreeBuilder tree = default_tree_builder)
        : geometry_(surface_tree(memory, executor, arrays.triangles, arrays.spheres, tree)),
          triangles_(memory, std::span(arrays.triangles)), spheres_(memory, std::span(arrays.spheres)),
          surfaces_(memory, std::span(arrays.surfaces)), materials_(memory, std::span(arrays.materials)),
          emitters_(memory, std::span(arrays.emitters)),
          cumulative_(memory, std::span(arrays.cumulative)), lights_(memory, std::span(arrays.lights)),
          surface_contacts_(memory, std::span(arrays.surface_contacts)),
          coincident_(memory, std::span(arrays.coincident)),
          contact_planes_(memory, std::span(arrays.contact_planes)),
          contact_triangles_(memory, std::span(arrays.contact_triangles)),
          eye_contacts_(arrays.eye_contacts), has_environment_(arrays.has_environment),
          radius_(arrays.radius), camera_(camera)
    {}

    /// The builder of its tree (surfaces.h).
    [[nodiscard]] TreeBuilder tree() const { return geometry_.builder(); }

    template <Needs needs>
    [[nodiscard]] SceneView<needs> view() const
    {
        return {geometry_.view<needs.spheres>(),
                triangles_.all(),
                spheres_.all(),
                surfaces_.all(),
                materials_.all(),
                emitters_.all(),
                cumulative_.all(),
                lights_.all(),
                surface_contacts_.all(),
                coincident_.all(),
                contact_planes_.all(),
                contact_triangles_.all(),
                eye_contacts_,
                has_environment_,
                radius_,
                camera_};
    }

private:
    SurfaceTree geometry_;
    Buffer<Triangle> triangles_;
    Buffer<Sphere> spheres_;
    Buffer<Surface> surfaces_;
    Buffer<Material> materials_;
    Buffer<Emitter> emitters_;
    Buffer<float> cumulative_;
    Buffer<Light> lights_;
    Buffer<SurfaceContacts> surface_contacts_;
    Buffer<Coincident> coincident_;
    Buffer<ContactPlane> contact_planes_;
    Buffer<std::uint32_t> contact_triangles_;
    EndContacts eye_contacts_;
    bool has_environment_;
    float radius_;
    Camera camera_;
};

} // namespace fast
