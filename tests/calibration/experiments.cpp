#include "tests/calibration/experiments.h"

#include <boost/math/distributions/beta.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <mutex>
#include <thread>

namespace calibration {

namespace {

using golden::Candidate;
using golden::Golden;
using golden::Method;

/// Calls work(0), ..., work(count - 1), on several threads.
template <class Work>
void for_each_index(int count, unsigned threads, const Work& work)
{
    std::atomic<int> next = 0;
    const auto loop = [&] {
        for (int i = next++; i < count; i = next++) work(i);
    };
    std::vector<std::jthread> helpers;
    for (unsigned i = 1; i < threads; ++i) helpers.emplace_back(loop);
    loop();
}

Golden make_golden(const SimulatedRenderer& renderer, const Plan& plan, std::uint64_t seed)
{
    golden::GoldenMaker maker(plan.size, plan.size, plan.pilot);
    for (std::uint64_t batch = 0; batch < plan.pilot + plan.reference; ++batch)
        maker.add_batch(renderer.render(seed, batch));
    return maker.golden({{"batch_size", "4"}});
}

void add_batches(Candidate& candidate, const SimulatedRenderer& renderer, std::uint64_t seed,
                 std::uint64_t batches, const Bias& bias = {})
{
    for (std::uint64_t batch = 0; batch < batches; ++batch)
        candidate.add_batch(renderer.render(seed, batch, bias));
}

/// Calls trial(golden, seed) for each candidate; no two seeds are the same, and none is a golden's.
template <class Trial>
void for_each_trial(const SimulatedRenderer& renderer, const Plan& plan, const Trial& trial)
{
    for (int g = 0; g < plan.goldens; ++g) {
        const std::uint64_t seed = mix(plan.seed) + static_cast<std::uint64_t>(g) * 1'000'000;
        const Golden golden = make_golden(renderer, plan, seed);
        for_each_index(plan.trials, plan.threads, [&](int i) {
            trial(golden, seed + 10 * static_cast<std::uint64_t>(i + 1));
            if (plan.tick) plan.tick();
        });
    }
}

double trials_of(const Plan& plan)
{
    return static_cast<double>(plan.goldens) * static_cast<double>(plan.trials);
}

std::vector<double> sorted_values(const std::vector<golden::Row>& rows,
                                  const golden::Functionals& functionals, const golden::Finding& finding)
{
    std::vector<double> values =
        golden::values_of(rows, functionals, finding.functional, finding.channel);
    std::sort(values.begin(), values.end());
    return values;
}

constexpr double level_of_both = 0.01;
constexpr std::uint64_t first_stage = 64;
constexpr std::uint64_t second_stage = 256;

} // namespace

golden::Interval rate_interval(const Count& count)
{
    using boost::math::beta_distribution;
    const auto hits = static_cast<double>(count.hits);
    const auto misses = static_cast<double>(count.trials - count.hits);
    return {hits == 0.0 ? 0.0 : quantile(beta_distribution<double>(hits, misses + 1.0), 0.025),
            misses == 0.0 ? 1.0 : quantile(beta_distribution<double>(hits + 1.0, misses), 0.975)};
}

FalseAlarms measure_false_alarms(Noise noise, const Plan& plan)
{
    const SimulatedRenderer renderer(plan.size, noise);
    FalseAlarms result;
    std::mutex mutex;
    Plan own = plan; // its own seed: kinds of noise must not share the error of one golden
    own.seed = mix(plan.seed) + static_cast<std::uint64_t>(noise);
    for_each_trial(renderer, own, [&](const Golden& golden, std::uint64_t seed) {
        const golden::CompareOptions options;
        Candidate first(golden.functionals);
        add_batches(first, renderer, seed, first_stage);
        Candidate second(golden.functionals);
        add_batches(second, renderer, seed + 1, second_stage);
        const golden::RenderStage replay = [&](std::size_t stage, std::uint64_t, Candidate& candidate) {
            candidate = stage == 0 ? first : second;
        };
        const golden::Comparison comparison = compare(golden, replay, Method::ranks, options);
        FalseAlarms one;
        one.suspected = {comparison.p < options.suspicion_level, 1};
        one.screened = {comparison.p < options.screening_level, 1};
        one.failed = {comparison.verdict == golden::Verdict::fail, 1};
        for (const golden::Finding& finding : comparison.findings) {
            // For a black region no statement is possible: p is 1.
            if (finding.region.kind != golden::RegionKind::whole && finding.test.p == 1.0) continue;
            ++one.below_1e3.trials;
            one.below_1e3.hits += finding.test.p < 1e-3;
            one.below_1e5.hits += finding.test.p < 1e-5;
            ++one.twice.trials;
            if (finding.test.p >= level_of_both) continue;
            const golden::TestResult again =
                golden::mann_whitney(sorted_values(second.rows(), golden.functionals, finding),
                                     sorted_values(golden.reference, golden.functionals, finding));
            one.twice.hits += one_sided(again, finding.test.z) < level_of_both;
        }
        const std::lock_guard lock(mutex);
        const auto add = [](Count& to, const Count& from) {
            to.hits += from.hits;
            to.trials += from.trials;
        };
        add(result.suspected, one.suspected);
        add(result.screened, one.screened);
        add(result.failed, one.failed);
        add(result.below_1e3, one.below_1e3);
        add(result.below_1e5, {one.below_1e5.hits, one.below_1e3.trials});
        add(result.twice, one.twice);
    });
    constexpr std::array counts = {static_cast<double>(first_stage), static_cast<double>(second_stage)};
    constexpr std::array levels = {level_of_both / 2.0, level_of_both}; // any sign, then that sign
    result.expected_twice =
        2.0 * golden::all_exceed(counts, levels, static_cast<double>(plan.reference));
    return result;
}

Verdicts measure_verdicts(Method method, Noise golden_noise, Noise candidate_noise, const Bias& bias,
                          const Plan& plan)
{
    const SimulatedRenderer renderer(plan.size, golden_noise, plan.layout, plan.population);
    const SimulatedRenderer other(plan.size, candidate_noise, plan.layout, plan.population);
    Verdicts result;
    std::mutex mutex;
    for_each_trial(renderer, plan, [&](const Golden& golden, std::uint64_t seed) {
        const golden::RenderStage render = [&](std::size_t stage, std::uint64_t batches,
                                               Candidate& candidate) {
            add_batches(candidate, other, seed + stage, batches, bias);
        };
        const auto judge = [&] {
            if (method == Method::ranks) return compare(golden, render, method);
            Candidate candidate(golden.functionals);
            render(0, first_stage, candidate);
            return method == Method::welch ? compare(golden, candidate, method)
                                           : compare_picture(golden, candidate.mean(),
                                                             4.0 * static_cast<double>(first_stage));
        };
        const golden::Comparison comparison = judge();
        const golden::Verdict verdict = comparison.verdict;
        const std::lock_guard lock(mutex);
        if (verdict == golden::Verdict::pass && comparison.least_sensitive_stratum)
            result.least_stated =
                std::fmin(result.least_stated,
                          comparison.findings[*comparison.least_sensitive_stratum].detectable);
        result.pass += verdict == golden::Verdict::pass;
        result.fail += verdict == golden::Verdict::fail;
        result.inconclusive += verdict == golden::Verdict::inconclusive;
        result.by_strongest += verdict == golden::Verdict::fail &&
                               comparison.findings[*comparison.suspicion].adjusted_p == comparison.p;
    });
    return result;
}

FewPictures measure_few_pictures(int pictures, Noise golden_noise, Noise candidate_noise,
                                 const Bias& bias, const Plan& plan)
{
    constexpr std::uint64_t batches = 16; // of 4 samples, per picture
    const SimulatedRenderer renderer(plan.size, golden_noise);
    const SimulatedRenderer other(plan.size, candidate_noise);
    FewPictures result;
    std::vector<double> detectable;
    std::mutex mutex;
    for_each_trial(renderer, plan, [&](const Golden& golden, std::uint64_t seed) {
        std::vector<images::Image> given;
        for (int i = 0; i < pictures; ++i) {
            images::Film film(plan.size, plan.size);
            for (std::uint64_t batch = 0; batch < batches; ++batch)
                film.add_batch(
                    other.render(seed, static_cast<std::uint64_t>(i) * batches + batch, bias));
            given.push_back(film.mean());
        }
        golden::CompareOptions options;
        options.picture_samples = static_cast<double>(batches) * golden::batch_size_of(golden);
        const golden::Comparison comparison = compare_pictures(golden, given, options);
        const std::lock_guard lock(mutex);
        result.verdicts.pass += comparison.verdict == golden::Verdict::pass;
        result.verdicts.fail += comparison.verdict == golden::Verdict::fail;
        result.verdicts.inconclusive += comparison.verdict == golden::Verdict::inconclusive;
        result.suspected.hits += comparison.p < options.suspicion_level;
        ++result.suspected.trials;
        detectable.push_back(
            *std::max_element(comparison.detectable.begin(), comparison.detectable.end()));
        result.conclusive += comparison.coverage / trials_of(plan);
        for (const golden::Finding& finding : comparison.findings) {
            if (!finding.conclusive || finding.test.p == 1.0) continue;
            ++result.below_1e3.trials;
            ++result.below_1e5.trials;
            result.below_1e3.hits += finding.test.p < 1e-3;
            result.below_1e5.hits += finding.test.p < 1e-5;
        }
    });
    const auto middle = detectable.begin() + static_cast<std::ptrdiff_t>(detectable.size() / 2);
    std::nth_element(detectable.begin(), middle, detectable.end());
    result.detectable = *middle;
    return result;
}

std::vector<Count> measure_other_criteria(Noise noise, const Bias& bias, const Plan& plan)
{
    const SimulatedRenderer renderer(plan.size, noise);
    const auto film_of = [&](std::uint64_t seed, std::uint64_t batches, const Bias& wrong) {
        images::Film film(plan.size, plan.size);
        for (std::uint64_t batch = 0; batch < batches; ++batch)
            film.add_batch(renderer.render(seed, batch, wrong));
        return film;
    };
    const std::uint64_t golden_batches = plan.pilot + plan.reference;
    const images::Film reference = film_of(mix(plan.seed), golden_batches, {});
    // The noise is estimated from the golden: its standard error, scaled to the difference from 64
    // batches.
    images::Image error = reference.standard_error();
    const auto all = static_cast<double>(golden_batches);
    for (images::Rgb& pixel : error.pixels)
        pixel *= std::sqrt(1.0 + all / static_cast<double>(first_stage));

    const auto trials = static_cast<std::size_t>(plan.trials);
    const std::vector<Criterion>& criteria = other_criteria();
    std::vector<std::vector<double>> right(criteria.size(), std::vector<double>(trials));
    std::vector<std::vector<double>> wrong = right;
    for_each_index(plan.trials, plan.threads, [&](int i) {
        const std::uint64_t seed = mix(plan.seed) + 10 * static_cast<std::uint64_t>(i + 1);
        const images::Film right_film = film_of(seed, first_stage, {});
        const images::Film wrong_film = film_of(seed + 1, first_stage, bias);
        for (std::size_t k = 0; k < criteria.size(); ++k) {
            const auto at = static_cast<std::size_t>(i);
            right[k][at] = criteria[k].badness(right_film.mean(), reference.mean(), error);
            wrong[k][at] = criteria[k].badness(wrong_film.mean(), reference.mean(), error);
        }
        if (plan.tick) plan.tick();
    });
    std::vector<Count> found;
    for (std::size_t k = 0; k < criteria.size(); ++k) {
        std::sort(right[k].begin(), right[k].end());
        const double threshold = right[k][trials - 1 - trials / 100];
        const auto beyond = std::count_if(wrong[k].begin(), wrong[k].end(),
                                          [&](double badness) { return badness > threshold; });
        found.push_back({static_cast<std::uint64_t>(beyond), trials});
    }
    return found;
}

} // namespace calibration
