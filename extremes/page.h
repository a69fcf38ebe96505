#pragma once

// A walk as a page for people.

#include <nlohmann/json.hpp>

#include <string>

namespace extremes {

/// A self-contained HTML page of `results`, an object in the format "plumbline extremes 1": the table of
/// limits, and for each axis a plot of errors and failures against the parameter. It loads no other
/// files and needs no network. Fields that are missing or null are left out of the page; bytes that are
/// not UTF-8 are replaced.
std::string page(const nlohmann::ordered_json& results);

} // namespace extremes
