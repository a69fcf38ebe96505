#pragma once

// The truth of `plumbline trade`: a golden that is named, or a long render of the reference, made on
// first use and kept in a cache.

#include "cli/trade_command.h"
#include "golden/golden.h"
#include "scenes/scene.h"

#include <string>

namespace cli {

/// A golden and its origin in words.
struct NamedTruth {
    golden::Golden golden;
    std::string source;
    double samples; // per pixel
    int max_edges;  // of its paths
};

/// The golden options.truth. Throws std::invalid_argument if it is of another scene or camera, or if a
/// size was given and is another one.
NamedTruth named_truth(const TradeCommand& options, const scenes::Scene& scene);

/// The cached truth of paths of at most `max_edges` edges, or a new one: bidirectional path tracing by
/// the reference, for about options.truth_seconds. Throws Interrupted: then the unfinished truth is
/// kept, and the next call goes on with it.
NamedTruth cached_truth(const TradeCommand& options, const scenes::Scene& scene, int max_edges);

/// The folder of cached truths: options.cache, or the user's folder for caches [XDG Base Directory
/// Specification]. Throws std::invalid_argument if there is none.
std::string cache_folder(const TradeCommand& options);

} // namespace cli
