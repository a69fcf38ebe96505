#pragma once

// Runs a builder over inputs that builders are known to fail on, and shrinks the first failure.

#include "check/trees/build_attempt.h"
#include "check/trees/inputs.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace check {

struct BuilderOptions {
    std::uint64_t seed = 1;
    std::size_t cases = 100;                    // random inputs besides the planned ones
    std::size_t largest = std::size_t{1} << 20; // the most primitives of an input
    double timeout = 10.0;                      // seconds for one run of the builder
    double budget = 300.0;                      // seconds for all inputs, and as many for shrinking
    bool single_precision = true;               // all coordinates are floats
    std::vector<InputKind> kinds = {input_kinds.begin(), input_kinds.end()};
    TreeChecks checks;
    std::function<bool()> stop;                                        // asked between two runs
    std::function<void(std::size_t done, std::size_t total)> progress; // after each input
    std::function<void(double seconds)> shrinking; // since shrinking began, of budget
};

/// An input that fails.
struct Failure {
    std::vector<ref::Aabb> boxes;
    Problem problem;
};

/// The smallest input that was found to fail.
struct SmallestFailure : Failure {
    std::size_t tries = 0;        // runs of the builder that shrinking took
    std::size_t failed_again = 0; // of `runs_again` further runs on it
    std::size_t runs_again = 0;
};

struct BuilderReport {
    /// What became of one kind of input. After its first failure no more inputs of a kind are tried.
    struct Kind {
        InputKind kind;
        std::size_t tried = 0;
        std::size_t largest = 0; // primitives
        std::size_t failing = 0; // primitives of the input that failed
        Problem problem;         // and what was wrong
    };
    std::vector<Kind> kinds;
    std::size_t planned = 0;   // inputs
    bool budget_spent = false; // before all inputs were tried
    bool stopped = false;
    double slowest_seconds = 0.0;            // of an input that passed
    std::optional<Failure> first;            // the first input that failed
    std::optional<SmallestFailure> smallest; // the first one, shrunk

    [[nodiscard]] bool passes() const { return !first && !stopped; }
};

/// Tries all kinds of inputs, small ones first, then random ones. An exception of `attempts` itself ends
/// the check.
BuilderReport check_attempts(const BuildAttempts& attempts, const BuilderOptions& options);

/// The same on one given input.
BuilderReport check_on_input(const BuildAttempts& attempts, const std::vector<ref::Aabb>& boxes,
                             const BuilderOptions& options);

/// A builder in C++. It rejects its input by an exception of type std::exception.
using BuilderFunction = std::function<NeutralTree(std::span<const ref::Aabb>)>;

/// Checks a builder in this process: a crash or an endless loop cannot be caught here, and a run that
/// took longer than the time-out is a failure when it has ended.
BuilderReport check_builder(const BuilderFunction& build, const BuilderOptions& options = {});

} // namespace check
