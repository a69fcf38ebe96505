#pragma once

// A walk with every kind of content, for tests of results and pages.

#include "extremes/results.h"
#include "extremes/walk.h"

namespace extremes_test {

/// Two axes: "size" with three methods, of which "host" leaks from 100 on and is refused below 0.01, and
/// "share", with a linear parameter from 0 to 1 and nothing wrong.
inline std::vector<extremes::WalkedAxis> sample_walk()
{
    using namespace extremes;
    const auto small_errors = [](double, Random& random, int cases, Tally& tally) {
        for (int i = 0; i < cases; ++i) tally.add(1e-15 * random.uniform());
    };
    const auto host = [](double parameter, Random& random, int cases, Tally& tally) {
        for (int i = 0; i < cases; ++i)
            if (parameter < 0.01)
                tally.refuse("size.dae: too small");
            else if (parameter > 99 && random.uniform() < 0.5)
                tally.add(Failure::leaked);
            else
                tally.add(1e-7 * random.uniform());
        tally.notice("a notice");
    };
    Axis size{1,
              "size",
              "Size of a scene",
              "size, in metres",
              "A case is a scene.",
              1.0,
              true,
              powers_of_ten(-3, 3, 1),
              {},
              {}};
    size.methods = {{"ref", Format::binary64, small_errors},
                    {"host", Format::binary32, host},
                    {"float, fixed 1e-3", Format::binary32, host}};
    size.limits = {{"ref", 1000.0, [](double) { return 1e-15; }, 1e4, Failure::missed, "u is small"},
                   {"host", 10.0, [](double) { return 1e-7; }, 100.0, Failure::leaked, "a reason"}};
    Axis share{2,
               "share",
               "Share of something",
               "share",
               "",
               0.0,
               false,
               {0.0, 0.5, 1.0},
               {{"ref", Format::binary64, small_errors}},
               {}};
    std::vector<WalkedAxis> walked;
    WalkOptions options;
    options.cases = 100;
    for (const Axis& axis : {size, share}) {
        walked.push_back({axis, {}});
        for (const Method& method : axis.methods) {
            walked.back().methods.push_back({method, {}});
            for (const double parameter : axis.values)
                walked.back().methods.back().points.push_back(
                    point_of(parameter, *visit(axis, method, parameter, options)));
        }
    }
    return walked;
}

inline extremes::Description sample_description()
{
    return {"1.2.3", "plumbline extremes size share", "2026-11-27", "a processor", 100, 1, true};
}

inline extremes::Json sample_results()
{
    return extremes::results(sample_description(), sample_walk());
}

} // namespace extremes_test
