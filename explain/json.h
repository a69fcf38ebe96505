#pragma once

// A sample as JSON: all numbers with all their digits.

#include "explain/sample.h"

#include <string>

namespace explain {

/// One JSON object; docs/explain.md describes its members.
std::string json(const ref::World& world, const Sample& sample);

} // namespace explain
