#pragma once

// What the stages of a build on the fast path cost, on the host or on a GPU.

#include "scenes/scene.h"

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace cli {

/// Builds trees over 30 and 63 bits `repeats` times on `device`, "host" (with `threads` threads) or
/// "cuda". For each stage: the median time in ms that passed, the bytes that it must move
/// (cuda/trees/bytes_moved.h), and what share of the memory's bandwidth that is. "plausible" is false if
/// a stage claims to have moved more than the memory can, while its data were too large for the caches:
/// then some figure is wrong.
/// On the host also the SAH cost of the tree and of the one clustered from it (cuda/trees/hploc.h).
///
/// Throws std::runtime_error if there is no GPU, and std::invalid_argument for a primitive that is none.
nlohmann::json measure_stages(const scenes::Scene& scene, const std::string& device, unsigned threads,
                              int repeats);

/// The same as a table for people, to standard output.
void print_stages(const nlohmann::json& report);

} // namespace cli
