// Defects that renderers really have are seen: where one of them takes the place of the right code, a
// limit no longer holds.

#include "extremes/axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace extremes {

struct Defect {
    const char* axis;
    const char* limit;  // of this method ...
    const char* method; // ... does not hold for this one
};

void PrintTo(const Defect& defect, std::ostream* out)
{
    *out << defect.method << " on " << defect.axis;
}

class Defects : public testing::TestWithParam<Defect> {
protected:
    static Axis axis(const std::string& name)
    {
        for (Axis& each : all_axes())
            if (each.name == name) return each;
        throw std::logic_error("no axis " + name);
    }
    /// Whether each of the methods has a failure or an error above the bound within `limit`, in 2,000
    /// cases: the same for all, one method after the other, so that exact answers are computed once.
    static std::vector<bool> broken(const Axis& axis, const Limit& limit,
                                    const std::vector<std::string>& methods)
    {
        std::vector<bool> result(methods.size(), false);
        Random random(1);
        const double last = std::isnan(limit.tested) ? limit.safe : limit.tested;
        for (int group = 0; group < 20; ++group) {
            const double parameter = random.log_between(axis.ordinary, last);
            const std::uint64_t seed = random.bits();
            for (std::size_t i = 0; i < methods.size(); ++i) {
                const auto found = std::ranges::find(axis.methods, methods[i], &Method::name);
                if (found == axis.methods.end()) throw std::logic_error("no method " + methods[i]);
                Random cases(seed);
                Tally tally;
                found->run(parameter, cases, std::min(100, axis.most_cases), tally);
                if (tally.failures() > 0 || !(tally.largest() <= limit.bound(parameter)))
                    result[i] = true;
            }
        }
        return result;
    }
};

TEST_P(Defects, MoveALimit)
{
    const auto& [name, limit_of, method] = GetParam();
    const Axis of = axis(name);
    int limits = 0;
    for (const Limit& limit : of.limits) {
        if (limit.method != limit_of) continue;
        ++limits;
        const std::vector<bool> of_both = broken(of, limit, {limit_of, method});
        EXPECT_FALSE(of_both[0]) << "the limit does not hold by itself";
        EXPECT_TRUE(of_both[1]) << "up to " << limit.safe;
    }
    EXPECT_GT(limits, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Usual, Defects,
    testing::Values(
        Defect{"scale", "ref", "double, fixed 1e-4"}, Defect{"scale", "host", "float, fixed 1e-4"},
        Defect{"distance", "host", "float, fixed 1e-4"}, Defect{"distance", "ref", "double, fixed 1e-4"},
        Defect{"gap", "ref", "double, fixed 1e-4"}, Defect{"gap", "host", "float, fixed 1e-4"},
        Defect{"grazing", "ref", "double, fixed 1e-4"}, Defect{"grazing", "host", "float, fixed 1e-4"},
        Defect{"sliver", "ref", "double, fixed 1e-6"},
        Defect{"scale", "ref", "double, determinant 1e-6"},
        Defect{"scale", "host", "float, determinant 1e-6"},
        Defect{"area", "ref", "double, determinant 1e-6"},
        Defect{"grazing-hit", "ref", "double, determinant 1e-6"},
        Defect{"sphere-ratio", "ref", "double, fixed 1e-4"},
        Defect{"sphere-ratio", "host", "float, relative 1e-3"},
        Defect{"near-surface", "ref", "double, fixed 1e-6"},
        Defect{"near-surface", "host", "float, fixed 1e-3"},
        Defect{"distance", "host", "float, exclude"}, // coordinates in float before the shift
        Defect{"samples", "ref", "float, sum"},       // the film in float
        Defect{"samples", "host", "float, sum"}, Defect{"samples", "host", "float, running mean"}),
    [](const auto& parameter) {
        std::string name = std::string(parameter.param.axis) + "_" + parameter.param.limit + "_" +
                           parameter.param.method;
        std::ranges::replace_if(
            name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
        return name;
    });

} // namespace extremes
