#include "trade/estimates.h"

#include "golden/rare_events.h"
#include "trade/rounds.h"

#include <boost/math/distributions/chi_squared.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trade {

namespace {

/// By which factor a standard deviation may exceed its estimate, with a chance of 5%.
double largest_deviation(double degrees)
{
    if (std::isinf(degrees)) return 1.0;
    return std::sqrt(degrees / boost::math::quantile(boost::math::chi_squared(degrees), 0.05));
}

template <class Value>
std::vector<double> by_round(const std::vector<Round>& rounds, const Value& value)
{
    std::vector<double> values;
    values.reserve(rounds.size());
    for (const Round& round : rounds) values.push_back(value(round));
    return values;
}

/// A clock may show no time at all for a trivial build.
double seconds_of(double duration)
{
    return std::max(duration, 1e-9);
}

template <class Part>
Times times(const std::vector<Round>& rounds, const Part& part)
{
    return {geometric_mean_of_rounds(by_round(rounds, [&](const Round& r) { return part(r).wall; })),
            geometric_mean_of_rounds(by_round(rounds, [&](const Round& r) { return part(r).cpu; }))};
}

Seconds build_of(const Round& round)
{
    return {seconds_of(round.build.wall), seconds_of(round.build.cpu)};
}

Seconds render_of(const Round& round)
{
    return {seconds_of(round.render.wall) / round.samples(),
            seconds_of(round.render.cpu) / round.samples()};
}

bool is_skewed(const golden::Moments& moments, const Levels& levels)
{
    return std::abs(moments.skewness) / std::sqrt(moments.count) > levels.skewness;
}

/// The noise by all batches. A variance is positive, so the interval is that of its logarithm.
Estimate noise_interval(const golden::Moments& noise, double confidence)
{
    if (noise.count < 2.0 || !(noise.mean > 0.0)) return {};
    const double relative = std::sqrt(noise.variance / noise.count) / noise.mean;
    const double factor = std::exp(student_quantile(noise.count - 1.0, confidence) * relative);
    return {noise.mean, noise.mean / factor, noise.mean * factor};
}

/// Noise times seconds. The relative errors of both are independent; their degrees of freedom are
/// combined as by Welch and Satterthwaite.
Estimate product(const golden::Moments& noise, const std::vector<double>& seconds, double confidence)
{
    if (noise.count < 2.0 || !(noise.mean > 0.0)) return {};
    std::vector<double> logarithms;
    for (const double s : seconds) logarithms.push_back(std::log(s));
    const golden::Moments time = golden::moments(logarithms);
    const double noise_square = noise.variance / noise.count / (noise.mean * noise.mean);
    const double time_square = time.variance / time.count;
    const double sum = noise_square + time_square;
    const double degrees = sum > 0.0 ? sum * sum /
                                           (noise_square * noise_square / (noise.count - 1.0) +
                                            time_square * time_square / (time.count - 1.0))
                                     : time.count - 1.0;
    const double value = noise.mean * std::exp(time.mean);
    const double factor = std::exp(student_quantile(degrees, confidence) * std::sqrt(sum));
    return {value, value / factor, value * factor};
}

/// The test of one region.
struct RegionTest {
    bool conclusive;
    golden::TestResult test;
    golden::MeanEstimate found, expected;
    double event; // golden::largest_unseen_event
};

RegionTest test_region(const golden::Moments& found, const Region& region, const Levels& levels)
{
    RegionTest result{};
    result.found = golden::mean_estimate(found);
    result.expected = golden::mean_estimate(region.truth);
    result.test = golden::welch(result.found, result.expected, levels.rounding * region.truth.mean);
    result.event = golden::largest_unseen_event(found, region.truth, region.largest);
    result.test.p =
        std::max(result.test.p,
                 golden::least_p_of_darkness(result.event, found.count, result.found, result.expected,
                                             levels.rounding * region.truth.mean));
    result.conclusive = !is_skewed(found, levels) && !is_skewed(region.truth, levels);
    return result;
}

Estimate relative_error(const RegionTest& region, double confidence)
{
    const golden::Interval ratio = golden::ratio_interval(region.found, region.expected, confidence);
    return {region.found.mean / region.expected.mean - 1.0, ratio.low - 1.0, ratio.high - 1.0};
}

Bias bias_of(const std::vector<Round>& rounds, const Truth& truth, const Levels& levels)
{
    const std::vector<Region>& regions = truth.regions();
    // Bonferroni: over the regions, and over the configurations.
    const double comparisons = static_cast<double>(regions.size()) *
                               static_cast<double>(std::max<std::size_t>(1, levels.configurations));
    const double level = levels.false_mark / comparisons;
    std::vector<RegionTest> tests;
    for (std::size_t r = 0; r < regions.size(); ++r) {
        std::vector<golden::Moments> each;
        for (const Round& round : rounds) each.push_back(round.brightness[r]);
        tests.push_back(test_region(golden::pooled(each), regions[r], levels));
    }
    // The stratum with the strongest evidence, conclusive ones first.
    std::size_t worst = 0;
    for (std::size_t r = 1; r < tests.size(); ++r)
        if (worst == 0 || std::pair(tests[r].conclusive, -tests[r].test.p) >
                              std::pair(tests[worst].conclusive, -tests[worst].test.p))
            worst = r;

    Bias bias;
    bias.whole = relative_error(tests[0], levels.confidence);
    if (worst > 0) {
        bias.worst_region = regions[worst].name;
        bias.worst = relative_error(tests[worst], 1.0 - (1.0 - levels.confidence) /
                                                            static_cast<double>(tests.size() - 1));
    }
    const double degrees = golden::welch_degrees(tests[0].found, tests[0].expected);
    const double error = std::sqrt(tests[0].found.variance + tests[0].expected.variance);
    const double by_noise =
        golden::detectable_difference(error * largest_deviation(degrees), degrees, level, levels.power);
    const double hidden =
        golden::hidden_light(tests[0].event, tests[0].found.degrees + 1.0, level / 2.0);
    bias.detectable = (by_noise + hidden) / tests[0].expected.mean;

    std::size_t strongest = tests.size();
    for (std::size_t r = 0; r < tests.size(); ++r)
        if (tests[r].conclusive &&
            (strongest == tests.size() || tests[r].test.p < tests[strongest].test.p))
            strongest = r;
    if (strongest < tests.size()) bias.p = golden::bonferroni(tests[strongest].test.p, comparisons);
    if (bias.p < levels.false_mark) {
        bias.verdict = BiasVerdict::biased;
        bias.reason =
            regions[strongest].name + " has an error of " +
            percent_to_text(tests[strongest].found.mean / tests[strongest].expected.mean - 1.0);
    } else if (!tests[0].conclusive) {
        bias.reason = "the noise of the whole picture is too skewed for a test";
    } else {
        bias.verdict = BiasVerdict::none_found;
        bias.reason =
            "an error of " + percent_to_text(bias.detectable) + " of the whole would have been found";
    }
    return bias;
}

/// The rounds that both have, from the first on.
std::size_t common(const std::vector<Round>& a, const std::vector<Round>& b)
{
    return std::min(a.size(), b.size());
}

Estimate ratio_of(std::vector<double> a, std::vector<double> b, std::size_t rounds, double confidence)
{
    a.resize(rounds);
    b.resize(rounds);
    const auto positive = [](double x) { return x > 0.0; };
    if (rounds < 2 || !std::ranges::all_of(a, positive) || !std::ranges::all_of(b, positive)) return {};
    return ratio_of_rounds(a, b, confidence);
}

} // namespace

std::string describe(BiasVerdict verdict)
{
    switch (verdict) {
    case BiasVerdict::none_found:
        return "none found";
    case BiasVerdict::biased:
        return "biased";
    case BiasVerdict::undecided:
        break;
    }
    return "undecided";
}

Estimates estimate(const std::vector<Round>& rounds, const Truth& truth, const Levels& levels)
{
    if (rounds.size() < 2) throw std::invalid_argument("an interval needs at least two rounds");
    Estimates result;
    result.build = times(rounds, build_of);
    result.render = times(rounds, render_of);
    result.bias = bias_of(rounds, truth, levels);

    std::vector<golden::Moments> each;
    for (const Round& round : rounds) each.push_back(round.noise);
    const golden::Moments noise = golden::pooled(each);
    result.skewed = is_skewed(noise, levels);
    result.noise = noise_interval(noise, levels.confidence);
    const Measured squared = mean_of_rounds(
        by_round(rounds, [](const Round& r) { return r.bias_squared; }), levels.confidence);
    result.bias_squared = {squared.mean, squared.mean - squared.half_width,
                           squared.mean + squared.half_width};
    result.relmse_1s = product(noise, by_round(rounds, [](const Round& r) { return render_of(r).wall; }),
                               levels.confidence);
    if (result.relmse_1s.stated())
        result.efficiency = {1.0 / result.relmse_1s.value, 1.0 / result.relmse_1s.high,
                             1.0 / result.relmse_1s.low};
    if (result.bias.verdict == BiasVerdict::biased)
        result.floor = std::max(0.0, result.bias_squared.value);
    return result;
}

std::vector<double> costs(const std::vector<Round>& rounds)
{
    return by_round(rounds, [](const Round& r) { return r.noise.mean * render_of(r).wall; });
}

Estimate time_to_equal_noise(const std::vector<Round>& a, const std::vector<Round>& b, double confidence)
{
    return ratio_of(costs(a), costs(b), common(a, b), confidence);
}

Estimate speed(const std::vector<Round>& a, const std::vector<Round>& b)
{
    const auto per_sample = [](const Round& r) { return render_of(r).wall; };
    return ratio_of(by_round(b, per_sample), by_round(a, per_sample), common(a, b), 0.95);
}

Estimate samples_from_which_it_pays(const std::vector<Round>& a, const std::vector<Round>& b)
{
    std::vector<double> longer;  // to build
    std::vector<double> shorter; // per sample per pixel
    for (std::size_t r = 0; r < common(a, b); ++r) {
        longer.push_back(a[r].build.wall - b[r].build.wall);
        shorter.push_back(render_of(b[r]).wall - render_of(a[r]).wall);
    }
    if (longer.size() < 2) return {};
    const Measured build = mean_of_rounds(longer);
    const Measured sample = mean_of_rounds(shorter);
    if (build.mean - build.half_width <= 0.0 || sample.mean - sample.half_width <= 0.0) return {};
    const golden::Interval interval =
        golden::ratio_interval(golden::mean_estimate(golden::moments(longer)),
                               golden::mean_estimate(golden::moments(shorter)), 0.95);
    return {build.mean / sample.mean, std::max(0.0, interval.low), interval.high};
}

} // namespace trade
