#pragma once

// A study of a scene: configurations of renderers, measured in rounds, and what was measured so far.

#include "images/image.h"
#include "trade/round.h"
#include "trade/truth.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace trade {

/// One way to render the scene.
struct Configuration {
    std::string name;    // unique: "device=host threads=2"
    std::string command; // a command line that renders so
    MakeRenderer make;
    /// The most memory that a process of its own needs for it, in bytes; none if that failed. May be
    /// empty.
    std::function<std::optional<double>()> peak_bytes = {};
};

/// An option and the configurations that differ in its value alone.
struct Knob {
    struct Value {
        std::string text;
        std::size_t configuration; // index
    };
    std::string name;
    std::string what;      // one line
    std::size_t reference; // the configuration that the others are compared with
    std::vector<Value> values;
};

/// The measurements of one configuration.
struct Measurements {
    std::optional<Plan> plan;
    std::vector<Round> rounds; // round r is with the seed of round r, and so are those of the others
    std::vector<double> peak_bytes; // of the first rounds
    std::string picture;            // of the first round, a PNG file's bytes
    std::string problem;            // why there are none; empty if there is no problem
};

struct StudyOptions {
    double seconds = 60.0; // about, for all rounds together
    std::size_t rounds = 8;
    std::uint64_t seed = 1; // below 2^32; of the order in each round and of the renders
    double exposure = 0.0;  // of pictures, in stops
};

struct StudyMonitor {
    std::function<void(double done)> progress = {}; // the part that is done, 0 to 1
    std::function<bool()> stop = {};                // true ends the study soon
    std::function<void()> keep = {};                // called after each round
};

/// Rounds in which the memory of each configuration is measured, in a process of its own.
constexpr std::size_t rounds_with_memory = 2;

/// Adds rounds to `measured`, one element for each configuration, until each has options.rounds. In a
/// round each configuration is measured once, in an order drawn anew from the seed, with the same seed
/// for all. Goes on from what is there. An error of a renderer is kept as the problem of its
/// configuration, and the study goes on without it. Returns false if monitor.stop returned true: whole
/// measurements are kept, the one that was stopped is lost.
bool study(const std::vector<Configuration>& configurations, const StudyOptions& options,
           const Truth& truth, const Clock& clock, const StudyMonitor& monitor,
           std::vector<Measurements>& measured);

} // namespace trade
