#pragma once

// A walk as data: the JSON that `plumbline extremes` writes, and from which its page is made.
// docs/extremes.md describes the format.

#include "extremes/axis.h"
#include "extremes/point.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace extremes {

using Json = nlohmann::ordered_json;

constexpr const char* results_format = "plumbline extremes 1";

/// Where and how a walk was made.
struct Description {
    std::string program;   // version
    std::string command;   // command line
    std::string date;      // of its end, "2026-11-27"
    std::string processor; // name
    int cases = 0;         // per point
    std::uint64_t seed = 0;
    bool complete = true; // not interrupted
};

/// An axis and the points of those of its methods that were chosen, in increasing order of the
/// parameter. Points that are not yet visited are missing.
struct WalkedAxis {
    struct Of {
        Method method;
        std::vector<Point> points;
    };
    Axis axis;
    std::vector<Of> methods;
};

/// All numbers.
Json results(const Description& description, const std::vector<WalkedAxis>& walked);

/// The limits that points contradict, one line each: "distance, host: ...".
std::vector<std::string> contradictions(const std::vector<WalkedAxis>& walked);

/// Where and how the walk of earlier results was made. Throws std::invalid_argument, with the reason, if
/// `json` is no such results.
Description description_of(const Json& json);

/// Fills in the points of earlier results. Throws std::invalid_argument, with the reason, if `json` is
/// no such results, or if version, cases or seed differ. Axes, methods and parameters that `walked` does
/// not have are left out, and so are points that were not walked, unless they are to be shown: they may
/// be possible now.
void restore(const Json& json, const Description& description, std::vector<WalkedAxis>& walked,
             bool with_unwalked = false);

/// Errors, first failures and limits as a table in plain text.
std::string table(const Json& results);

/// The limits as a table in Markdown: a row for each limit of each axis. It does not depend on the
/// points.
std::string limits_in_markdown(const Json& results);

/// The part of docs/results/extremes.md that the program writes: the table of limits, and a section for
/// each axis with its picture (../images/extremes_NAME.png), its limits, their derivation, and the first
/// failures of all methods.
std::string markdown(const Json& results);

} // namespace extremes
