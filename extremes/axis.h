#pragma once

// An axis: one parameter, from the ordinary to beyond the breaking point of every method.

#include "extremes/failure.h"
#include "extremes/random.h"
#include "extremes/tally.h"

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace extremes {

enum class Format { binary64, binary32 };

/// u: the largest relative error of one rounding to nearest.
constexpr double unit_roundoff(Format format)
{
    return format == Format::binary64 ? 0x1p-53 : 0x1p-24;
}

/// One way to compute what the axis is about: an algorithm in one number format, or a usual trick.
/// "ref" and "host" are the reference and the fast path as users run them; "cuda" is the fast path on a
/// GPU.
struct Method {
    std::string name;
    Format format;
    /// Computes `cases` random cases at `parameter` and adds each to `tally` once. Methods of one axis
    /// draw the same cases from the same `random`. Called from several threads at once.
    std::function<void(double parameter, Random& random, int cases, Tally& tally)> run;
};

/// Limit::beyond where no failure is found as far as one can go.
constexpr double no_failure = std::numeric_limits<double>::quiet_NaN();

/// How far a method is safe, and what fails first beyond. Tests hold both sides.
struct Limit {
    std::string method;
    double safe; // from Axis::ordinary to here there is no failure, and no error above bound(parameter)
    std::function<double(double parameter)> bound;
    double beyond;       // a parameter farther out, at which ...
    Failure failure;     // ... some of 10,000 cases fail in this way
    std::string because; // why this is the limit: one line

    // Where cases take so long that a test cannot go there, and only a walk does (contradiction(), in
    // point.h, holds both sides of the limit to it):
    double tested = std::numeric_limits<double>::quiet_NaN(); // tests go up to here; NaN: to `safe`
    bool beyond_takes_long = false;                           // no test goes to `beyond`
};

struct Axis {
    int number;        // of the list in docs/extremes.md
    std::string name;  // on the command line: "distance"
    std::string title; // "Distance from the origin"
    std::string
        parameter;     // what the parameter is, with its unit: "distance from the origin, in diameters"
    std::string about; // what a case is, what its error is, and where the truth comes from
    double ordinary;   // a value at which everything works
    bool logarithmic;  // how to draw it, and how to draw random values
    std::vector<double> values; // in increasing order; `ordinary` is one of them
    std::vector<Method> methods;
    std::vector<Limit> limits;   // of methods by their names, at most two of each: below and above
    int most_cases = 1'000'000;  // where a case is large: at each point no more than this
    bool shared_truth = false;   // methods that are visited together compute exact answers once
    std::string derivation = {}; // of the bounds: a paragraph for docs/results/extremes.md
};

/// 10^from, ..., 10^to in equal steps of the exponent; both ends are included.
std::vector<double> powers_of_ten(double from, double to, double step);

/// All axes, in the order of their numbers.
std::vector<Axis> all_axes();

} // namespace extremes
