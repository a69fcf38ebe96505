#pragma once

// Speed against accuracy as a page for people.

#include <nlohmann/json.hpp>

#include <string>

namespace trade {

/// A self-contained HTML page of `results`, an object in the format "plumbline trade 1": time against
/// error of all configurations with the Pareto front, each knob by itself, pictures at equal time, and a
/// table of all numbers. It loads no other files and needs no network. Fields that are missing or null
/// are left out of the page; bytes that are not UTF-8 are replaced.
std::string page(const nlohmann::ordered_json& results);

} // namespace trade
