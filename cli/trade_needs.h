#pragma once

// What a scene requires of a renderer, what is left out therefore, by which proof, and what leaving it
// out gains.

#include "cli/trade_knobs.h"
#include "cuda/transport/needs.h"
#include "scenes/scene.h"
#include "trade/results.h"

#include <string>
#include <vector>

namespace cli {

/// The knobs that measure what is left out for this scene: kernels that could do more, families of
/// strategies that can carry nothing, longer paths than there are.
std::vector<std::string> needs_knobs(const scenes::Scene& scene);

/// The requirements as rows of the results: "what" (shapes, kernel ...), "has", "left_out" with the
/// proof, "gain" (a factor with its interval, or null) and "sentence". Gains are measured where the
/// plan has the configurations for them. `kernels`: the abilities of the kernels for the scene.
trade::Json needs_rows(const scenes::Scene& scene, const fast::Needs& kernels, const TradePlan& plan,
                       const std::vector<trade::Measurements>& measured);

} // namespace cli
