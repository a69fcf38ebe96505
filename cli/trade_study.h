#pragma once

// What `plumbline trade` studies: everything that is known before the first measurement.

#include "cli/trade_command.h"
#include "cli/trade_knobs.h"
#include "cli/trade_truth.h"
#include "cuda/transport/needs.h"
#include "scenes/scene.h"
#include "trade/study.h"

#include <vector>

namespace cli {

struct TradeStudy {
    scenes::Scene scene;
    TradeView view;
    TradePlan plan;
    NamedTruth named;
    fast::Needs kernels; // the abilities of the fast path's kernels for the scene
};

/// Reads the scene, finds the errors of names and values before anything takes long, then finds or
/// renders the truth. Throws scenes::SceneError, std::invalid_argument, images::ImageError, Interrupted.
TradeStudy study_of(TradeCommand options);

/// The configurations of a study, which must outlive them.
std::vector<trade::Configuration> configurations_of(const TradeStudy& study);

} // namespace cli
