#pragma once

// The parts of the time of an LBVH build.

#include "ref/trees/aabb.h"

#include <functional>
#include <string>
#include <vector>

namespace bench {

/// A part of build_lbvh as a function to be timed; its input is prepared beforehand.
struct Step {
    std::string name;
    std::function<void()> run;
};

/// The steps over `boxes`, which must outlive them, with 10 bits per axis, in the order of build_lbvh.
/// Together they do the work of a build, except for the check of the input and some lists of indices.
/// The last step, "first touch", is a part of "refit" again: it fills memory for all boxes that is new
/// to the process.
std::vector<Step> lbvh_steps(const std::vector<ref::Aabb>& boxes);

} // namespace bench
