// Defects that renderers really have are seen: where one of them takes the place of the right code, a
// limit no longer holds.

#include "extremes/axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <stdexcept>
#include <string>

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
    /// Whether `method` has a failure or an error above the bound within `limit`, in 2,000 cases.
    static bool breaks(const Axis& axis, const Limit& limit, const std::string& method)
    {
        const auto found = std::ranges::find(axis.methods, method, &Method::name);
        if (found == axis.methods.end()) throw std::logic_error("no method " + method);
        Random random(1);
        for (int group = 0; group < 20; ++group) {
            const double parameter = random.log_between(axis.ordinary, limit.safe);
            Tally tally;
            found->run(parameter, random, std::min(100, axis.most_cases), tally);
            if (tally.failures() > 0 || !(tally.largest() <= limit.bound(parameter))) return true;
        }
        return false;
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
        EXPECT_FALSE(breaks(of, limit, limit_of)) << "the limit does not hold by itself";
        EXPECT_TRUE(breaks(of, limit, method)) << "up to " << limit.safe;
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
