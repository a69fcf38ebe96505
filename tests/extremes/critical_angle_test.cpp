// Near the critical angle the errors of shares and directions have a bound at every angle, and so there
// is no failure to state as a limit.

#include "extremes/axis.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>

namespace extremes {

namespace {

const Axis& critical_angle()
{
    static const std::vector<Axis> axes = all_axes();
    const auto found = std::ranges::find(axes, "critical-angle", &Axis::name);
    if (found == axes.end()) throw std::logic_error("there is no such axis");
    return *found;
}

Tally tally_of(const std::string& name, double parameter, std::uint64_t seed)
{
    const Axis& axis = critical_angle();
    const auto method = std::ranges::find(axis.methods, name, &Method::name);
    if (method == axis.methods.end()) throw std::logic_error("there is no such method");
    Random random(seed);
    Tally tally;
    method->run(parameter, random, 1000, tally);
    return tally;
}

} // namespace

class CriticalAngle : public testing::TestWithParam<std::pair<std::string, double>> {};

TEST_P(CriticalAngle, ErrorsAreAtMostARootOfTheUnitRoundoff)
{
    const auto& [name, unit_roundoff] = GetParam();
    const std::uint64_t seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    double largest = 0;
    for (const double parameter : critical_angle().values) {
        const Tally tally = tally_of(name, parameter, seed);
        EXPECT_EQ(tally.failures(), 0u) << parameter;
        largest = std::max(largest, tally.largest());
    }
    const double bound = 33 * std::sqrt(unit_roundoff); // axes/critical_angle.cpp
    EXPECT_LT(largest, bound);
    EXPECT_GT(largest, bound / 4); // a root, and not in proportion to the unit roundoff
}

INSTANTIATE_TEST_SUITE_P(Formats, CriticalAngle,
                         testing::Values(std::pair("ref", 0x1p-53), std::pair("host", 0x1p-24)),
                         [](const auto& parameter) { return parameter.param.first; });

} // namespace extremes
