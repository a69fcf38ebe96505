// Both sides of every stated limit: inside, every random case has an error within the bound and none
// fails; just outside, the stated failure occurs.

#include "extremes/axis.h"
#include "extremes/walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace extremes {

struct NamedLimit {
    Axis axis;
    Limit limit;
    std::string name; // for gtest: letters, digits and "_"

    [[nodiscard]] const Method& method() const
    {
        const auto found = std::ranges::find(axis.methods, limit.method, &Method::name);
        if (found == axis.methods.end())
            throw std::logic_error(name + " names a method that does not exist");
        return *found;
    }
};

void PrintTo(const NamedLimit& limit, std::ostream* out)
{
    *out << limit.name;
}

namespace {

/// All limits, or those beyond which a failure is stated.
std::vector<NamedLimit> all_limits(bool that_fail_beyond)
{
    std::vector<NamedLimit> result;
    for (const Axis& axis : all_axes())
        for (const Limit& limit : axis.limits) {
            if (that_fail_beyond && (std::isnan(limit.beyond) || limit.beyond_takes_long)) continue;
            std::string name =
                axis.name + "_" + limit.method + (limit.safe < axis.ordinary ? "_below" : "_above");
            std::ranges::replace_if(
                name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
            result.push_back({axis, limit, name});
        }
    return result;
}

/// The number of cases: 2,000, so that the test run stays short, of other random numbers in each run;
/// 10^5 with PLUMBLINE_LONG (./run extremes). With n cases a run finds an error that one case in m has
/// with probability 1 - (1 - 1/m)^n: that of one case in 668 with 95%, in ten runs that of one in 6,677.
int cases_inside()
{
    const char* text = std::getenv("PLUMBLINE_LONG");
    return text != nullptr && std::string(text) != "0" ? 100'000 : 2'000;
}

/// At the limit itself, where a defect appears first, there are as many as this.
constexpr int cases_at_the_limit = 100;

} // namespace

class InsideLimits : public testing::TestWithParam<NamedLimit> {};
class OutsideLimits : public testing::TestWithParam<NamedLimit> {};

TEST_P(InsideLimits, EveryCaseIsWithinTheBound)
{
    const auto& [axis, limit, name] = GetParam();
    const Method& method = GetParam().method();
    const std::uint64_t seed = std::random_device{}();
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const double last = std::isnan(limit.tested) ? limit.safe : limit.tested;
    // Groups of cases at random parameters; and the two ends of the range.
    const int groups = std::clamp(axis.most_cases, 12, 100);
    const int cases = std::min(cases_inside(), axis.most_cases);
    for (int group = 0; group < groups; ++group) {
        double parameter = axis.logarithmic ? random.log_between(axis.ordinary, last)
                                            : random.between(axis.ordinary, last);
        if (group == 0) parameter = axis.ordinary;
        if (group == 1) parameter = last;
        Tally tally;
        const int least = group == 1 ? std::min(cases_at_the_limit, axis.most_cases / groups) : 1;
        method.run(parameter, random, std::max({cases / groups, least, 1}), tally);
        ASSERT_GT(tally.errors(), 0u) << axis.parameter << ": " << parameter;
        for (std::size_t kind = 0; kind < failure_kinds; ++kind)
            EXPECT_EQ(tally.failures(static_cast<Failure>(kind)), 0u)
                << failure_names[kind] << " at " << axis.parameter << ": " << parameter << " "
                << tally.refusal();
        EXPECT_LE(tally.largest(), limit.bound(parameter)) << axis.parameter << ": " << parameter;
        if (HasFailure()) return;
    }
}

TEST_P(OutsideLimits, TheStatedFailureOccurs)
{
    const auto& [axis, limit, name] = GetParam();
    Random random(1);
    Tally tally;
    const int cases = std::min(10'000, axis.most_cases);
    for (int done = 0, next = 25; done < cases && tally.failures(limit.failure) == 0; next = done) {
        next = std::min(next, cases - done); // as many again, until one fails
        GetParam().method().run(limit.beyond, random, next, tally);
        done += next;
    }
    EXPECT_GT(tally.failures(limit.failure), 0u)
        << extremes::name(limit.failure) << " at " << axis.parameter << ": " << limit.beyond;
    EXPECT_TRUE(limit.safe < axis.ordinary ? limit.beyond < limit.safe : limit.beyond > limit.safe);
}

INSTANTIATE_TEST_SUITE_P(Axes, InsideLimits, testing::ValuesIn(all_limits(false)),
                         [](const auto& parameter) { return parameter.param.name; });
INSTANTIATE_TEST_SUITE_P(Axes, OutsideLimits, testing::ValuesIn(all_limits(true)),
                         [](const auto& parameter) { return parameter.param.name; });

} // namespace extremes
