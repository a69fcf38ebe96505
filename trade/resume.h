#pragma once

// To go on with a study: its raw measurements in the results, and how they are found there again.

#include "trade/results.h"

namespace trade {

constexpr const char* results_format = "plumbline trade 1";

/// All numbers of a measurement.
Json raw(const Round& round);

/// What must be equal for a study to go on with the measurements of another: scene, size, truth, and the
/// plan of the measurement.
Json identity(const Description& description, const StudyOptions& options, const Truth& truth);

/// The measurements in earlier results, for these configurations: by their names. Throws
/// std::invalid_argument, with the reason, if `json` is no such results or if scene, size, truth, seed,
/// seconds or rounds differ.
std::vector<Measurements> restored(const Json& json, const Description& description,
                                   const StudyOptions& options,
                                   const std::vector<Configuration>& configurations, const Truth& truth);

} // namespace trade
