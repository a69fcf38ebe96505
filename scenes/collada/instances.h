#pragma once

// Geometries, lights and cameras that nodes place in the scene, transformed from their local frame to
// the world.

#include "scenes/collada/document.h"
#include "scenes/collada/geometries.h"
#include "scenes/collada/materials.h"
#include "scenes/collada/transform.h"
#include "scenes/plain_material.h"
#include "scenes/read_scene.h"
#include "scenes/scene.h"

#include <cstddef>
#include <string>
#include <unordered_set>
#include <vector>

namespace scenes::collada {

/// Adds instances to a scene, each as its instance element says and with the transform of its node.
class Instances {
public:
    /// With Parts::geometry the scene gets one grey material, which all surfaces share.
    Instances(const Document& document, Scene& scene, Parts parts = Parts::all)
        : document_(&document), scene_(&scene), parts_(parts), materials_(document, scene),
          geometries_(document, scene.notices)
    {
        if (parts_ == Parts::geometry) add_plain_material(scene);
    }

    /// <instance_geometry>. A mirroring transform also reverses the winding of triangles, so that their
    /// normal stays on the same side: the front of a mirrored lamp is the mirror image of its front. The
    /// transform of a sphere must be a similarity: an ellipsoid is an error. A surface without a bound
    /// material gets the default one, with one notice for each part of a mesh and each sphere.
    void add_geometry(const Element& instance, const Matrix& to_world);
    /// <instance_light>. Area lights are added by finish().
    void add_light(const Element& instance, const Matrix& to_world);
    /// <instance_camera>. The first one is used; any other gives a notice and is not read.
    void add_camera(const Element& instance, const Matrix& to_world);
    /// To be called after the last instance. Turns area lights into pairs of triangles, unless some
    /// geometry emits: then they describe the same luminaires a second time. Adds a notice for a scene
    /// without any emitter.
    void finish();

private:
    struct AreaLightInstance {
        const Element* instance;
        const Element* light;
        Rgb radiance;
        Matrix to_world;
    };

    /// The same as add_camera, for a camera that must be readable.
    void place_camera(const Element& instance, const Matrix& to_world);
    void add_mesh(const Mesh& mesh, const Element& instance, const Matrix& to_world);
    void add_sphere(const LocalSphere& sphere, const Element& geometry, const Element& instance,
                    const Matrix& to_world);
    void add_triangles(const std::vector<Corners>& triangles, std::uint32_t material,
                       const Element& instance, const Matrix& to_world);
    /// The index of the material that `instance` gives the sphere of `geometry`.
    std::uint32_t sphere_material(const Element& geometry, const Element& instance);
    /// The index of the default material. Adds a notice that `surface` (an element of a geometry) gets
    /// it, and `why`: one notice for any number of instances.
    std::uint32_t default_material(const Element& surface, const std::string& why);
    /// Fails if `more` primitives on top of those in the scene are too many.
    void check_room(std::size_t more, const Element& instance) const;

    const Document* document_;
    Scene* scene_;
    Parts parts_;
    Materials materials_;
    Geometries geometries_;
    std::vector<AreaLightInstance> area_lights_;
    std::unordered_set<const Element*> noticed_without_material_;
    bool other_cameras_noticed_ = false;
};

} // namespace scenes::collada
