#pragma once

// The factors of a contribution: the formula of its family with numbers.

#include "explain/sample.h"

#include <string>
#include <vector>

namespace explain {

/// One factor; `divides` if the formula divides by it.
struct Factor {
    std::string name; // "alpha of z_2"
    Rgb value;        // three equal numbers for a scalar
    bool is_scalar = false;
    bool divides = false;
};

/// The factors whose product is strategy.made->value, in the order of the formula in
/// ref/transport/connect.cpp; empty for a strategy that contributes nothing.
std::vector<Factor> factors(const ref::World& world, const Sample& sample, const Strategy& strategy);

} // namespace explain
