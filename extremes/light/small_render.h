#pragma once

// Small pictures by each wing, as a file holds them.

#include "extremes/refusal.h"
#include "extremes/wing.h"

#include "images/image.h"
#include "images/render_options.h"
#include "scenes/scene.h"

#include <stdexcept>

namespace extremes {

/// One batch of `options`, `size` x `size` pixels, rounded to the 32-bit floats of a picture file.
/// Throws std::invalid_argument for what the renderer refuses, and std::runtime_error if a contribution
/// is not finite, or the GPU fails.
images::Image small_render(Wing wing, const scenes::Scene& scene, int size,
                           const images::RenderOptions& options);

/// Calls judge(), which makes small renders and adds one case to `tally`. Adds the case itself where the
/// program refuses the scene, and where a contribution is not finite.
template <class Judge>
void judge_small_render(Tally& tally, const Judge& judge)
{
    try {
        unless_refused(tally, 1, judge);
    } catch (const std::runtime_error&) {
        tally.add(Failure::not_finite);
    }
}

} // namespace extremes
