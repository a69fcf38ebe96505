#pragma once

// Rendering in single precision, for code that does not want to know on which device.

#include "cuda/transport/mis_weight.h"
#include "cuda/transport/needs.h"
#include "images/dropped.h"
#include "images/image.h"
#include "scenes/scene.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>

namespace gpu {

/// No path is longer, whatever is asked for.
constexpr int most_edges = 1 << 20;

/// Layers have s >= 0, t >= 1 and at most this many edges.
constexpr int most_edges_of_layers = 16;

enum class Layers { none, weighted, unweighted };

struct RenderOptions {
    Integrator integrator = Integrator::bdpt;
    Heuristic heuristic = Heuristic::balance;
    std::uint64_t seed = 0;
    int max_edges = most_edges; // of a path, the camera's included; at least 1
    bool roulette = true;
    std::uint32_t batch_size = 4; // samples per pixel of a batch
    bool deterministic = false;   // splats are summed exactly, so that no bit depends on threads
    Needs at_least = {};          // kernels that can do this besides: to measure what it costs
    Layers layers = Layers::none; // a picture per strategy: max_edges is at most most_edges_of_layers
};

/// How a caller watches a render and stops it; either may be empty. Called from the thread that renders.
struct Monitor {
    std::function<void(double done)> progress = {}; // the part of the batch that is done
    std::function<bool()> stop = {};                // asked between launches: true ends the batch
};

/// One batch: the mean per pixel, and by (s, t) the sums over its samples of what each strategy found,
/// if layers were asked for.
struct Batch {
    images::Image mean;
    std::map<std::pair<int, int>, images::Image> layers;
    images::Dropped dropped; // contributions that are not finite, which are in neither
};

/// A scene made ready in the memory of a device.
class Renderer {
public:
    Renderer() = default;
    virtual ~Renderer() = default;
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Renders the batch of that number, whatever was rendered before. None if `monitor` said stop.
    /// Throws std::invalid_argument where a pixel would get more than 2^32 samples.
    virtual std::optional<Batch> render_batch(std::uint64_t number, const Monitor& monitor) = 0;

    /// What the kernels that render can do: what the scene needs, and RenderOptions::at_least.
    [[nodiscard]] virtual Needs needs() const = 0;
};

/// Renders on `threads` threads of the host. The scene must have a camera; it is copied. Throws
/// std::invalid_argument for coordinates that are not finite as floats, for lights that floats cannot
/// hold (scene_arrays.h), for a picture of no pixels or of 2^32 and more, and for options that
/// contradict each other; OutOfMemory.
std::unique_ptr<Renderer> host_renderer(const scenes::Scene& scene, int width, int height,
                                        const RenderOptions& options, unsigned threads);

/// The same on the first GPU. Throws std::runtime_error where there is none or for errors of CUDA.
std::unique_ptr<Renderer> device_renderer(const scenes::Scene& scene, int width, int height,
                                          const RenderOptions& options);

} // namespace gpu
