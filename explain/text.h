#pragma once

// A sample as tables for a terminal, at most 100 columns wide.

#include "explain/sample.h"

#include <string>

namespace explain {

/// The sample, as several paragraphs of lines.
std::string describe(const ref::World& world, const Sample& sample);

} // namespace explain
