#pragma once

// A study as data: the JSON that `plumbline trade` writes, and from which its page is made.
// docs/trade.md describes the format.

#include "trade/estimate.h"
#include "trade/study.h"
#include "trade/truth.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace trade {

using Json = nlohmann::ordered_json;

/// Where and how a study was made.
struct Description {
    std::string program;   // version
    std::string command;   // command line
    std::string date;      // of its end, "2026-11-27"
    std::string processor; // name
    unsigned threads = 1;  // of the processor
    std::string scene;     // name
    std::string scene_hash;
    std::string truth;          // where it comes from, in words
    double truth_samples = 0.0; // per pixel
    /// The largest relative half width of a ratio of times, formed within rounds, that is precise
    /// enough.
    double precision = 0.1;
    bool complete = true; // not interrupted
};

/// {"value", "low", "high"}; null for what is not a finite number.
Json json_of(const Estimate& estimate);

/// All numbers, with intervals, and the raw measurements. Numbers that are not stated are null.
Json results(const Description& description, const StudyOptions& options,
             const std::vector<Configuration>& configurations, const std::vector<Knob>& knobs,
             const Truth& truth, const std::vector<Measurements>& measured);

/// The numbers as a table in plain text, and the sentence of each knob.
std::string table(const Json& results);

} // namespace trade
