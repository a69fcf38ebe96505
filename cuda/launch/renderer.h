#pragma once

// The fast path as an images::Renderer (images/renderer.h), for code that does not depend on the
// device.

#include "cuda/launch/instruction_set.h"
#include "cuda/transport/needs.h"
#include "cuda/trees/tree_builder.h"
#include "images/render_options.h"
#include "images/renderer.h"
#include "scenes/scene.h"

#include <memory>

namespace fast {

/// Upper limit on the number of edges of a path; a larger max_edges is reduced to it.
constexpr int most_edges = 1 << 20;

/// A renderer with its scene in the memory of a device. A batch throws std::invalid_argument if a
/// pixel would get more than 2^32 samples. `progress` and `stop` of its monitor are called from the
/// thread that renders. Splats are summed as floats, and depend on the order of threads, unless
/// RenderOptions::deterministic is set.
class Renderer : public images::Renderer {
public:
    /// The abilities of the kernels that render: the smallest in compiled_needs that include the needs
    /// of the scene, and `at_least`.
    [[nodiscard]] virtual Needs needs() const = 0;
    /// The tree over the surfaces: RendererOptions::tree, unless that is too deep (TreeBuilder).
    [[nodiscard]] virtual TreeBuilder tree() const = 0;
};

/// How a GPU computes samples: by one kernel that computes whole samples, or by kernels for the stages
/// of many samples (docs/stages.md). Both give the same bits.
enum class DeviceKernels { samples, stages };

/// Choices that change speed and memory. The bits of a picture do not depend on them, except on
/// InstructionSet::fastmath, and except those of splats as floats.
struct RendererOptions {
    /// For host_renderer: one of instruction_sets(), or fastmath if has_fast_math().
    InstructionSet instructions = best_instruction_set();
    DeviceKernels kernels = DeviceKernels::samples; // for device_renderer
    Needs at_least = {}; // abilities of the kernels beyond those that the scene needs
    TreeBuilder tree = default_tree_builder;
};

/// Renders on `threads` threads of the host. The scene must have a camera; it is copied. Throws
/// std::invalid_argument for coordinates that are not finite as floats, for lights that floats cannot
/// represent (scene_arrays.h), for a picture of 0 pixels or of 2^32 or more, and for options that
/// contradict each other or that only the reference has; OutOfMemory.
std::unique_ptr<Renderer> host_renderer(const scenes::Scene& scene, int width, int height,
                                        const images::RenderOptions& options, unsigned threads,
                                        const RendererOptions& choices = {});

/// The same on the first GPU. Throws std::runtime_error if there is no GPU, and for errors of CUDA.
std::unique_ptr<Renderer> device_renderer(const scenes::Scene& scene, int width, int height,
                                          const images::RenderOptions& options,
                                          const RendererOptions& choices = {});

} // namespace fast
