#pragma once

// All strategies of bidirectional path tracing in one picture, as in [Veach 1997, ch. 10].

#include "images/strategies.h"

namespace images {

/// One row for each path length k = s + t - 1, its strategies from s = 0 on the left to t = 1 on the
/// right, each labelled; missing strategies are black. Longer paths carry less light: row k
/// is shown max(0, k - 2) stops brighter, which its label states. Throws std::invalid_argument if there
/// are no strategies or their sizes differ.
Image strategy_sheet(const Strategies& strategies);

} // namespace images
