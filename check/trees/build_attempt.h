#pragma once

// One run of a builder, and what is wrong with its result.

#include "check/trees/check_tree.h"

#include <functional>
#include <span>
#include <string>

namespace check {

/// How a builder ended, whether it is a function or a program.
struct BuildAttempt {
    enum class End {
        built,     // it returned a tree, which need not be valid
        rejected,  // it refused the input: an exception, or an exit status other than 0
        crashed,   // a signal ended it
        timed_out, // it took longer than its limit
        no_tree,   // it reported success without a tree that can be read
    } end;
    NeutralTree tree = {}; // if built
    std::string text = {}; // what happened, in words, otherwise
    double seconds = 0.0;
};

/// Runs a builder on these boxes, for at most so many seconds.
using BuildAttempts =
    std::function<BuildAttempt(std::span<const ref::Aabb> boxes, double limit_seconds)>;

/// What is wrong with an attempt: a name ("crash", "timeout", "rejected", "accepted-nan", "no-tree", or
/// that of a property), and a sentence. No name: nothing is wrong.
struct Problem {
    std::string name = {};
    std::string text = {};
    [[nodiscard]] bool any() const { return !name.empty(); }
};

/// What is wrong with this attempt on these boxes. NaN, and boxes whose lower end is above the upper
/// one, must be rejected; infinite coordinates and an empty set may be; everything else must give a
/// valid tree.
Problem problem_of(const BuildAttempt& attempt, std::span<const ref::Aabb> boxes,
                   const TreeChecks& checks);

} // namespace check
