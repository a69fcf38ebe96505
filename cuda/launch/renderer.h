#pragma once

// The fast path behind the one door (images/renderer.h), for code that does not want to know on which
// device it runs.

#include "cuda/transport/needs.h"
#include "images/render_options.h"
#include "images/renderer.h"
#include "scenes/scene.h"

#include <memory>

namespace fast {

/// No path is longer, whatever is asked for.
constexpr int most_edges = 1 << 20;

/// A scene made ready in the memory of a device. A batch throws std::invalid_argument where a pixel
/// would get more than 2^32 samples. `progress` and `stop` of its monitor are called from the thread
/// that renders. Splats are sums of floats, which depend on the order of threads, unless
/// RenderOptions::deterministic.
class Renderer : public images::Renderer {
public:
    /// What the kernels that render can do: what the scene needs, and `at_least`.
    [[nodiscard]] virtual Needs needs() const = 0;
};

/// Renders on `threads` threads of the host. The scene must have a camera; it is copied. `at_least`:
/// kernels that can do this besides, to measure what it costs. Throws std::invalid_argument for
/// coordinates that are not finite as floats, for lights that floats cannot hold (scene_arrays.h), for a
/// picture of no pixels or of 2^32 and more, and for options that contradict each other; OutOfMemory.
std::unique_ptr<Renderer> host_renderer(const scenes::Scene& scene, int width, int height,
                                        const images::RenderOptions& options, unsigned threads,
                                        Needs at_least = {});

/// The same on the first GPU. Throws std::runtime_error where there is none or for errors of CUDA.
std::unique_ptr<Renderer> device_renderer(const scenes::Scene& scene, int width, int height,
                                          const images::RenderOptions& options, Needs at_least = {});

} // namespace fast
