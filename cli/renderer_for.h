#pragma once

// The renderer for the options of a command, on any device.

#include "cli/render_command.h"
#include "cuda/transport/needs.h"
#include "images/renderer.h"
#include "scenes/scene.h"

#include <memory>
#include <optional>
#include <string>

namespace cli {

/// The renderer for the options. The scene must have a camera and must outlive it. Prints notices of
/// values that floats cannot represent to stderr, unless options.quiet. Throws std::runtime_error where
/// there is no such device, fast::OutOfMemory, std::invalid_argument.
std::unique_ptr<images::Renderer> renderer_for(const RenderCommand& options, const scenes::Scene& scene);

/// The features of the kernels of the fast path; none for the reference.
std::optional<fast::Needs> kernel_of(const images::Renderer& renderer);

/// The name of the builder of the tree that `renderer`, which was made for the options, has.
std::string builder_of(const RenderCommand& options, const images::Renderer& renderer);

} // namespace cli
