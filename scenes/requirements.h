#pragma once

// The requirements of a scene on a renderer. The fast path compiles its kernels for what a scene
// requires and leaves out the rest (cuda/transport/needs.h).

#include "scenes/kinds.h"
#include "scenes/scene.h"

#include <set>

namespace scenes {

/// The features that a scene uses. `strategies` are those that can carry light for some path in it, as
/// far as materials and emitters alone can tell (see requirements.cpp); visibility is not considered.
struct Requirements {
    std::set<Shape> shapes;
    std::set<Bsdf> bsdfs;
    std::set<EmitterKind> emitters;
    std::set<Strategy> strategies;
    std::set<FovAxis> fov_axes; // empty without a camera
};

/// The requirements of `scene`. Black lights and emitting triangles without area are no emitters.
Requirements requirements(const Scene& scene);

} // namespace scenes
