#pragma once

// What renders for the options of `plumbline render` and its like, on whichever device.

#include "cli/render_command.h"
#include "cuda/transport/needs.h"
#include "images/renderer.h"
#include "scenes/scene.h"

#include <memory>
#include <optional>

namespace cli {

/// The renderer that the options ask for; the scene, which must have a camera, must outlive it. Says on
/// stderr what floats cannot hold, unless options.quiet. Throws std::runtime_error where there is no
/// such device, gpu::OutOfMemory, std::invalid_argument.
std::unique_ptr<images::Renderer> renderer_for(const RenderCommand& options, const scenes::Scene& scene);

/// What the kernels of the fast path can do; none for the reference.
std::optional<gpu::Needs> kernel_of(const images::Renderer& renderer);

} // namespace cli
