#pragma once

// Small pictures by both wings, as a file holds them.

#include "extremes/axis.h"

#include "images/image.h"
#include "images/render_options.h"
#include "scenes/scene.h"

namespace extremes {

/// One batch of `options`, `size` x `size` pixels, rounded to the 32-bit floats of a picture file.
/// Throws std::invalid_argument for what the renderer refuses, and std::runtime_error if a contribution
/// is not finite.
images::Image small_render(Format wing, const scenes::Scene& scene, int size,
                           const images::RenderOptions& options);

} // namespace extremes
