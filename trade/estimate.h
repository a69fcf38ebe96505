#pragma once

// A measured number with its interval.

#include <cmath>
#include <limits>
#include <string>

namespace trade {

/// A value and the ends of its confidence interval, 95% unless said otherwise. Not a number where it
/// cannot be stated: too few values, or a quotient by zero.
struct Estimate {
    double value = std::numeric_limits<double>::quiet_NaN();
    double low = std::numeric_limits<double>::quiet_NaN();
    double high = std::numeric_limits<double>::quiet_NaN();

    /// Whether all three numbers are finite.
    [[nodiscard]] bool stated() const
    {
        return std::isfinite(value) && std::isfinite(low) && std::isfinite(high);
    }
    [[nodiscard]] bool contains(double x) const { return low <= x && x <= high; }
    /// Whether the interval leaves out 1: only then one of the two sides of a ratio is larger.
    [[nodiscard]] bool decided() const { return low > 1.0 || high < 1.0; }
};

/// "1.73 (1.60 to 1.88)", three digits each; "unknown" if it is not stated.
std::string to_text(const Estimate& estimate);

/// A relative error in percent: "-63.2% (-63.4% to -63.0%)", the interval with two digits; "unknown" if
/// it is not stated.
std::string error_to_text(const Estimate& estimate);

/// "3.21%", three digits.
std::string percent_to_text(double relative);

} // namespace trade
