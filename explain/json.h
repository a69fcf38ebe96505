#pragma once

// A sample as JSON: all numbers with all their digits.

#include "explain/fast_sample.h"

#include <string>

namespace explain {

/// One JSON object; docs/explain.md describes its members.
std::string json(const ref::World& world, const Sample& sample);

/// The same with a further member `host`, the sample as the fast path computes it.
std::string json(const ref::World& world, const Sample& sample, const FastSample& fast);

} // namespace explain
