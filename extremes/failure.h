#pragma once

// The kinds of failure that a walk to the extremes counts.

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace extremes {

enum class Failure {
    not_finite,  // a result is NaN or infinite
    missed,      // a ray does not find the surface that it is aimed at
    self_hit,    // a ray finds the surface that it leaves
    leaked,      // a ray passes through a surface
    wrong_order, // a ray or a tree returns what is not the first
    biased,      // a mean differs from the truth by more than its standard error allows
    endless,     // the work exceeds its limit
    inaccurate,  // the relative error is more than largest_error
    refused,     // the program refuses the input with a message, before it computes anything
};

inline constexpr std::size_t failure_kinds = 9;

/// A result with a larger relative error than this is a failure.
inline constexpr double largest_error = 0.01;

inline constexpr std::array<std::string_view, failure_kinds> failure_names = {
    "not finite", "missed",  "self-hit",   "leaked", "wrong order",
    "biased",     "endless", "inaccurate", "refused"};

inline std::string_view name(Failure failure)
{
    return failure_names.at(static_cast<std::size_t>(failure));
}

/// The failure of this name; none if there is no such failure.
inline std::optional<Failure> failure_of(std::string_view text)
{
    for (std::size_t i = 0; i < failure_kinds; ++i)
        if (failure_names[i] == text) return static_cast<Failure>(i);
    return std::nullopt;
}

} // namespace extremes
