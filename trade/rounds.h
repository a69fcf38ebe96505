#pragma once

// Measurements on a machine with other load. Every quantity is measured once in every round, in an order
// that is drawn anew, so that changes of the load affect all of them equally. The scatter of the rounds
// gives the error.

#include "trade/estimate.h"

#include <cstddef>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace trade {

/// A mean with the half width of its interval.
struct Measured {
    double mean;
    double half_width;
};

/// The two-sided quantile of Student's distribution: how many standard errors the half width of an
/// interval of this confidence has. `degrees` of freedom may be infinite.
double student_quantile(double degrees, double confidence);

/// The mean of one value per round, with Student's interval: the rounds are taken to be independent and
/// roughly normally distributed. Throws std::invalid_argument for fewer than two rounds.
Measured mean_of_rounds(const std::vector<double>& rounds, double confidence = 0.95);

/// The geometric mean of a[i] / b[i] over the rounds i, and Student's interval of its logarithm: a
/// factor that is common to a round cancels. Throws std::invalid_argument for fewer than two rounds,
/// for values that are not positive, and for `a` and `b` of different lengths.
Estimate ratio_of_rounds(const std::vector<double>& a, const std::vector<double>& b,
                         double confidence = 0.95);

/// The geometric mean of one positive value per round, and Student's interval of its logarithm: for
/// times, whose scatter is relative. Throws as ratio_of_rounds.
Estimate geometric_mean_of_rounds(const std::vector<double>& rounds);

/// Does the work of one round, of the given number, and returns the measured value.
using Measurement = std::function<double(std::size_t round)>;

/// Makes every measurement once in every round, in an order drawn anew from `random`. The values by
/// measurement, then by round.
std::vector<std::vector<double>> measure_in_rounds(std::size_t rounds, std::mt19937_64& random,
                                                   const std::vector<Measurement>& measurements);

/// "0.0263 +- 0.0005": the interval with two digits, the mean as exactly.
std::string to_text(const Measured& measured);

} // namespace trade
