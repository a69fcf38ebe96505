#pragma once

// What happened to the random cases at one point of an axis: their errors and their failures.

#include "extremes/failure.h"

#include <array>
#include <cstdint>
#include <string>

namespace extremes {

/// Counts cases. Keeps the distribution of their errors in bins of a sixteenth of a decade, from 1e-40
/// to 1e10, so that any number of cases takes the same memory.
class Tally {
public:
    /// A case with this relative error, >= 0. An error that is not finite counts as
    /// Failure::not_finite, one above largest_error as Failure::inaccurate.
    void add(double error);
    /// A case without a result.
    void add(Failure failure);
    /// The program refuses this point, with this message: the case counts as Failure::refused.
    void refuse(const std::string& message);
    /// A notice that the program gives about this point before it computes; the first one is kept.
    void notice(const std::string& message);
    /// Nothing is computed at this point, for this reason: no case is added. The first reason is kept.
    void leave_out(const std::string& reason);
    Tally& operator+=(const Tally& other);

    [[nodiscard]] std::uint64_t cases() const { return cases_; }
    [[nodiscard]] std::uint64_t failures(Failure kind) const
    {
        return failures_.at(static_cast<std::size_t>(kind));
    }
    /// All failures together.
    [[nodiscard]] std::uint64_t failures() const;
    /// The number of cases that have an error, those that are inaccurate included.
    [[nodiscard]] std::uint64_t errors() const { return errors_; }
    /// The largest error; 0 if there is none.
    [[nodiscard]] double largest() const { return largest_; }
    /// The error that the share `q` of the errors does not exceed, up to the width of a bin; 0 if
    /// there are none. 0 <= q <= 1.
    [[nodiscard]] double quantile(double q) const;
    /// The first refusal, notice and reason to leave out; empty if there are none.
    [[nodiscard]] const std::string& refusal() const { return refusal_; }
    [[nodiscard]] const std::string& notice() const { return notice_; }
    [[nodiscard]] const std::string& left_out() const { return left_out_; }

private:
    static constexpr int bins_per_decade = 16;
    static constexpr int lowest_decade = -40;
    static constexpr int decades = 50;
    static constexpr int bins = bins_per_decade * decades;

    std::uint64_t cases_ = 0;
    std::uint64_t errors_ = 0;
    std::array<std::uint64_t, failure_kinds> failures_{};
    std::array<std::uint64_t, bins + 1> histogram_{}; // bin 0: errors below the first bin, and 0
    double largest_ = 0.0;
    std::string refusal_;
    std::string notice_;
    std::string left_out_;
};

} // namespace extremes
