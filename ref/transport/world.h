#pragma once

// What an integrator needs to know, and what it has to say.

#include "images/render_options.h"
#include "ref/transport/camera.h"
#include "ref/transport/emitter.h"
#include "ref/transport/random.h"
#include "ref/trees/geometry.h"
#include "scenes/scene.h"

#include <cstdint>
#include <stdexcept>
#include <vector>

namespace ref {

/// A scene made ready for rendering. Keeps a reference to the scene, which must outlive it and must
/// have a camera. Throws std::invalid_argument where the scene is so large or small that products of
/// three lengths would leave the range of doubles: scenes::placed brings it there.
struct World {
    const scenes::Scene& scene;
    Geometry geometry;
    Emitters emitters;
    Camera camera;
    std::vector<std::uint32_t> eye_on; // surfaces that the eye lies on

    World(const scenes::Scene& source, int width, int height, Builder builder = Builder::sah_leaf)
        : scene(source), geometry(source, builder, scenes::coincidences(source)), emitters(geometry),
          camera(source.camera.value(), width, height),
          eye_on(scenes::surfaces_at(source, source.camera->eye))
    {
        const double size = geometry.diagonal();
        if (size != 0.0 && !(size > 1e-100 && size < 1e100))
            throw std::invalid_argument(source.name + ": a scene of this size is out of range: its "
                                                      "diagonal is not between 1e-100 and 1e100");
    }
    World(const World&) = delete; // its parts refer to each other
    World& operator=(const World&) = delete;
};

/// The eye walk's first ray: through a uniform point of the sample's pixel.
inline Ray camera_ray(const World& world, const SampleId& id)
{
    const auto width = static_cast<std::uint32_t>(world.camera.width());
    const std::uint32_t column = id.pixel % width;
    const std::uint32_t row = id.pixel / width;
    const Uniforms u = uniforms(id, Event::camera);
    Ray ray = world.camera.ray({column + u[0], row + u[1]});
    ray.on = world.eye_on;
    return ray;
}

using images::Heuristic;
using images::unlimited_edges;

/// How paths are made, the same for every integrator: the part of images::RenderOptions that it is for.
struct PathOptions {
    std::uint64_t seed = 0;
    int max_edges = unlimited_edges; // of a path, the camera's included; at least 1
    bool roulette = true;            // unbiased either way; with none, max_edges must bound the paths
    Heuristic heuristic = Heuristic::balance; // of bidirectional path tracing
};

/// What one path adds to one pixel. The path has s vertices from the light and t from the eye
/// [Veach 1997, sec. 10.2], hence s + t - 1 edges.
struct Contribution {
    std::uint32_t pixel; // the sample's own, unless t = 1: the light image falls anywhere
    int s, t;
    Rgb value;     // radiance (W m^-2 sr^-1), unweighted: as if its strategy were the only one
    double weight; // share that this strategy has in the path
};

inline int edges(const Contribution& contribution)
{
    return contribution.s + contribution.t - 1;
}

/// An integrator appends to `out` what the sample `id` contributes: one function call is one sample.
using Integrator = void (*)(const World& world, const PathOptions& options, const SampleId& id,
                            std::vector<Contribution>& out);

} // namespace ref
