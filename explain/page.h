#pragma once

// A sample as an HTML page: it needs no network, and shows a strategy when it is chosen.

#include "explain/sample.h"

#include <string>

namespace explain {

/// The page. For each formula it names the file and the line of the source that computes it.
std::string page(const ref::World& world, const Sample& sample);

} // namespace explain
