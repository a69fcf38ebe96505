#include "golden/compare.h"

#include "golden/false_alarm.h"
#include "golden/judge.h"
#include "golden/reason.h"
#include "golden/verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace golden {

namespace {

double largest_of(const std::array<double, channel_count>& errors)
{
    double largest = 0.0;
    for (const double error : errors) largest = std::fmax(largest, error); // ignores NaN
    return largest;
}

/// The factor by which the golden's batches must grow so that its variance is half of what is allowed
/// to the difference. By t tests; ranks need 3 / pi times as many batches for normal noise.
double golden_needed(const Golden& golden, const CompareOptions& options)
{
    double factor = 1.0;
    const Judge judge(golden, Method::welch, options);
    for (std::size_t c = 0; c < channel_count; ++c) {
        const Moments whole = moments(values_of(golden.reference, golden.functionals, 0, c));
        if (whole.count < 2.0 || !(whole.mean > 0.0)) continue;
        factor = std::max(factor, judge.compared(mean_estimate(whole), 0, c).reach.golden);
    }
    return factor;
}

/// Fills in golden_limit and shortfall for ranks, by search: there is no formula for the error that more
/// batches make detectable.
void reach_by_ranks(Comparison& comparison, const Golden& golden, const CompareOptions& options)
{
    constexpr std::uint64_t beyond_count = std::uint64_t{1} << 50;
    comparison.golden_limit = detectable_error(golden, beyond_count, options);
    if (!(largest_of(comparison.detectable) > options.specification)) return;
    Shortfall shortfall{std::numeric_limits<double>::infinity(),
                        static_cast<double>(golden.functionals.pilot().batches) +
                            golden_needed(golden, options) *
                                static_cast<double>(golden.reference.size())};
    if (largest_of(comparison.golden_limit) <= options.specification) {
        double batches = comparison.candidate_batches;
        const auto detectable = [&] {
            return largest_of(
                detectable_error(golden, static_cast<std::uint64_t>(std::ceil(batches)), options));
        };
        while (batches < static_cast<double>(beyond_count) && detectable() > options.specification)
            batches *= 1.1;
        shortfall.candidate = batches;
    }
    comparison.shortfall = shortfall;
}

Comparison first_stage(const Golden& golden, const Candidate& candidate, Method method,
                       const CompareOptions& options)
{
    if (method == Method::picture)
        throw std::invalid_argument("a single picture is compared by compare_picture");
    if (candidate.batches() < 1 || (method == Method::welch && candidate.batches() < 2))
        throw std::invalid_argument(
            method == Method::ranks ? "there is no picture to compare"
                                    : "comparing with another estimator needs two independent pictures "
                                      "at least, or one and its number of samples");
    if (method == Method::welch && golden.reference.size() < 2)
        throw std::invalid_argument("the golden has one batch after its pilot: too few");
    Comparison comparison;
    comparison.method = method;
    comparison.golden_batches = golden.reference.size();
    comparison.candidate_batches = static_cast<double>(candidate.batches());
    comparison.batch_size = batch_size_of(golden);
    const Judge judge(golden, method, options);
    for (std::size_t c = 0; c < channel_count; ++c)
        for (std::size_t f = 0; f < golden.functionals.size(); ++f)
            if (judge.can_test(f)) comparison.findings.push_back(judge.judge(candidate, f, c));
    summarise(comparison);
    if (method == Method::ranks)
        reach_by_ranks(comparison, golden, options);
    else
        summarise_reach(comparison, golden, options);
    // The samples of a picture of another estimator are not known, but each has at least one.
    const double batches = method == Method::ranks ? comparison.candidate_batches
                           : comparison.batch_size > 0.0
                               ? comparison.candidate_batches / comparison.batch_size
                               : 0.0;
    comparison.odd = odd_pixels(golden, candidate.mean(), batches, options.dark_level);
    comparison.stages.push_back({candidate.batches(), comparison.p, options.suspicion_level});
    comparison.false_alarm =
        options.certainty_level + options.dark_level; // unless further stages are planned
    return comparison;
}

/// The indices of the findings below this level, by ascending adjusted p. The first is the suspicion.
std::vector<std::size_t> suspected_findings(const Comparison& comparison, double level)
{
    std::vector<std::size_t> suspected;
    for (std::size_t i = 0; i < comparison.findings.size(); ++i)
        if (comparison.findings[i].conclusive && comparison.findings[i].adjusted_p < level &&
            i != *comparison.suspicion)
            suspected.push_back(i);
    std::stable_sort(suspected.begin(), suspected.end(), [&](std::size_t a, std::size_t b) {
        return comparison.findings[a].adjusted_p < comparison.findings[b].adjusted_p;
    });
    suspected.insert(suspected.begin(), *comparison.suspicion);
    return suspected;
}

} // namespace

void check_comparable(const Golden& golden, const images::Metadata& candidate, Method method)
{
    const auto both_say = [&](const std::string& key) {
        return golden.metadata.contains(key) && candidate.contains(key);
    };
    const auto demand_equal = [&](const std::string& key, const std::string& name) {
        if (both_say(key) && golden.metadata.at(key) != candidate.at(key))
            throw std::invalid_argument("its " + name + " is " + candidate.at(key) +
                                        ", the golden's is " + golden.metadata.at(key));
    };
    demand_equal("scene_hash", "scene's hash");
    demand_equal("camera", "camera");
    demand_equal("max_edges", "greatest path length");
    // Integrators that draw from one seed share random numbers: the camera's at least.
    if (both_say("seed") && golden.metadata.at("seed") == candidate.at("seed"))
        throw std::invalid_argument("has the golden's own seed, " + candidate.at("seed") +
                                    ": the two are not independent");
    if (method != Method::ranks) return;
    for (const char* key : {"batch_size", "integrator", "heuristic", "roulette"}) demand_equal(key, key);
}

Comparison compare(const Golden& golden, const Candidate& candidate, Method method,
                   const CompareOptions& options)
{
    Comparison comparison = first_stage(golden, candidate, method, options);
    if (decide_at_once(comparison, options)) return comparison;
    comparison.verdict = Verdict::inconclusive;
    give_reason(comparison, "Suspicious: " + say_suspicion(comparison) + ". One right picture in " +
                                say(1.0 / options.suspicion_level, 3) +
                                " looks so: a fresh render must confirm or clear it.");
    return comparison;
}

std::array<double, 3> detectable_error(const Golden& golden, std::uint64_t batches,
                                       const CompareOptions& options)
{
    const Judge judge(golden, Method::ranks, options);
    std::array<double, 3> detectable{};
    detectable.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t channel = 0; channel < channel_count; ++channel)
        for (std::size_t f = 0; f < weights.size(); ++f) // of region 0, the whole picture
            detectable[channel] = std::fmin(detectable[channel],
                                            judge.detectable(f, channel, static_cast<double>(batches)));
    return detectable;
}

Comparison compare(const Golden& golden, const RenderStage& render, Method method,
                   const CompareOptions& options)
{
    if (options.stages.empty()) throw std::invalid_argument("there is no stage to render");
    CompareOptions staged = options;
    if (options.stages.size() > 1) staged.suspicion_level = options.screening_level;
    Candidate first(golden.functionals);
    render(0, staged.stages[0], first);
    Comparison comparison = first_stage(golden, first, method, staged);
    comparison.false_alarm =
        staged.dark_level +
        false_alarm_bound(golden.functionals, method, golden.reference.size(), staged.stages, staged);
    if (decide_at_once(comparison, staged, staged.stages.size() > 1)) return comparison;

    const Judge judge(golden, method, staged);
    std::vector<std::size_t> suspected = suspected_findings(comparison, staged.suspicion_level);
    for (std::size_t stage = 1; stage < staged.stages.size(); ++stage) {
        Candidate fresh(golden.functionals);
        render(stage, staged.stages[stage], fresh);
        double least = 1.0; // p
        std::size_t strongest = suspected.front();
        std::erase_if(suspected, [&](std::size_t i) {
            const Finding& finding = comparison.findings[i];
            const Finding again = judge.judge(fresh, finding.functional, finding.channel);
            const double p = again.conclusive ? one_sided(again.test, finding.test.z) : 1.0;
            if (p < least) {
                least = p;
                strongest = i;
            }
            return p >= staged.confirmation_level;
        });
        comparison.stages.push_back({fresh.batches(), least, staged.confirmation_level});
        if (!suspected.empty()) comparison.suspicion = strongest; // the one whose p is stated
        if (suspected.empty()) {
            pass_or_inconclusive(comparison, staged,
                                 " (" + say_suspicion(comparison) +
                                     "; a fresh render confirmed no difference, p = " + say(least, 2) +
                                     ".)");
            return comparison;
        }
    }
    if (comparison.stages.size() == 1)
        give_reason(comparison,
                    "Suspicious: " + say_suspicion(comparison) + ", and no stage to confirm it.");
    else
        fail(comparison, "; confirmed on a fresh render, p = " + say(comparison.stages.back().p, 2));
    return comparison;
}

} // namespace golden
