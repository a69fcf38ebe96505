#pragma once

// A sample of the fast path as tables for a terminal, beside the same sample by the reference.

#include "explain/fast_sample.h"

#include <string>

namespace explain {

/// The numbers of the fast path, each with its difference from the reference: relative, and of
/// positions and directions a length. A walk that met other primitives than that of the reference has no
/// differences from there on. At most 100 columns wide, except where a name is long.
std::string describe(const ref::World& world, const Sample& sample, const FastSample& fast);

} // namespace explain
