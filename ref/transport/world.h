#pragma once

// The input of an integrator (World, PathOptions) and its output (Contribution).

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

/// A scene prepared for rendering. Keeps a reference to the scene, which must outlive it and must have a
/// camera. Throws std::invalid_argument if the scene is so large or so small that products of three
/// lengths would leave the range of doubles; scenes::placed scales a scene into this range.
struct World {
    const scenes::Scene& scene;
    Geometry geometry;
    Emitters emitters;
    Camera camera;
    std::vector<std::uint32_t> eye_on; // surfaces that the eye lies on

    World(const scenes::Scene& source, int width, int height,
          const BuildOptions& tree = Builder::sah_leaf)
        : scene(source), geometry(source, tree, scenes::coincidences(source)), emitters(geometry),
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
    Ray ray = world.camera.ray({column + u[0], row + u[1]}); // map: film-position
    ray.on = world.eye_on;
    return ray;
}

using images::Heuristic;
using images::unlimited_edges;

/// The options of all integrators: the part of images::RenderOptions that concerns single paths.
struct PathOptions {
    std::uint64_t seed = 0;
    int max_edges = unlimited_edges; // of a path, the camera's included; at least 1
    bool roulette = true;            // unbiased either way; with none, max_edges must bound the paths
    int roulette_from = 5;           // the first bounce of a walk that roulette may end; at least 1
    Heuristic heuristic = Heuristic::balance; // of bidirectional path tracing
    images::Families families = {};           // those that contribute; they do not change the weights
};

inline PathOptions path_options(const images::RenderOptions& options)
{
    return {.seed = options.seed,
            .max_edges = options.max_edges,
            .roulette = options.roulette,
            .roulette_from = options.roulette_from,
            .heuristic = options.heuristic,
            .families = options.families};
}

/// The contribution of one path to one pixel. The path has s vertices from the light and t from the eye
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

/// An integrator appends to `out` the contributions of the sample `id`: one function call is one sample.
using Integrator = void (*)(const World& world, const PathOptions& options, const SampleId& id,
                            std::vector<Contribution>& out);

} // namespace ref
