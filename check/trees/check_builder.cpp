#include "check/trees/check_builder.h"

#include "check/trees/shrink_boxes.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>

namespace check {

namespace {

double seconds_now()
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Planned {
    InputKind kind;
    std::size_t n;
    std::uint64_t seed;
};

// Around the sizes of warps and blocks; 65537 exceeds 16 bits, 262145 is the first n beyond a grid of
// 256 x 1024 threads.
constexpr std::array<std::size_t, 17> small_sizes = {1,  2,  3,  4,   5,   6,   7,   8,   9,
                                                     31, 32, 33, 255, 256, 257, 300, 1025};
constexpr std::array<std::size_t, 4> large_sizes = {4097, 65537, 262145, 1 << 20};
constexpr std::array large_kinds = {InputKind::uniform, InputKind::coincident, InputKind::duplicated,
                                    InputKind::grid};

/// All inputs in the order in which they are tried: smaller ones first.
std::vector<Planned> plan(const BuilderOptions& options)
{
    std::vector<Planned> result;
    const auto add = [&](InputKind kind, std::size_t n) {
        const bool fits = n <= options.largest && (kind == InputKind::empty) == (n == 0);
        if (fits && std::ranges::find(options.kinds, kind) != options.kinds.end())
            result.push_back({kind, n, options.seed + result.size()});
    };
    add(InputKind::empty, 0);
    for (const std::size_t n : small_sizes)
        for (const InputKind kind : input_kinds) add(kind, n);
    std::mt19937_64 bits(options.seed);
    const std::size_t largest = std::clamp<std::size_t>(options.largest, 1, 2000);
    for (std::size_t i = 0; i < options.cases && !options.kinds.empty(); ++i) {
        const double logarithm =
            std::log(static_cast<double>(largest) + 1) * (static_cast<double>(bits() >> 11) * 0x1p-53);
        add(options.kinds[bits() % options.kinds.size()], static_cast<std::size_t>(std::exp(logarithm)));
    }
    for (const std::size_t n : large_sizes)
        for (const InputKind kind : large_kinds) add(kind, n);
    return result;
}

/// One check of a builder: the clock, the limits, and the report so far.
class Run {
public:
    Run(const BuildAttempts& attempts, const BuilderOptions& options)
        : attempts_(attempts), options_(options)
    {}

    void try_all(const std::vector<Planned>& inputs)
    {
        report_.planned = inputs.size();
        for (const InputKind kind : input_kinds)
            if (std::ranges::find(options_.kinds, kind) != options_.kinds.end())
                report_.kinds.push_back({kind, 0, 0, 0, {}});
        const double end = seconds_now() + options_.budget;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            if (stop()) return;
            if (seconds_now() > end) {
                report_.budget_spent = true;
                return;
            }
            try_one(inputs[i]);
            if (options_.progress) options_.progress(i + 1, inputs.size());
        }
    }

    /// Whether the builder fails on these boxes; the first failure is kept.
    Problem try_boxes(const std::vector<ref::Aabb>& boxes)
    {
        const BuildAttempt attempt = attempts_(boxes, options_.timeout);
        if (stop()) return {}; // the run may have been cut short
        Problem problem = problem_of(attempt, boxes, options_.checks);
        if (!problem.any())
            report_.slowest_seconds = std::max(report_.slowest_seconds, attempt.seconds);
        else if (!report_.first)
            report_.first = {boxes, problem};
        return problem;
    }

    /// Finds the smallest input that fails, if there is one.
    void shrink()
    {
        if (!report_.first) return;
        static_cast<Failure&>(report_.smallest.emplace()) = *report_.first;
        if (report_.stopped) return;
        // An endless loop costs its time-out at every step: a program that was fast on all inputs so far
        // need not be waited for as long. The result has the full time again.
        const double limit = report_.first->problem.name == "timeout"
                                 ? std::min(options_.timeout, 0.25 + 20 * report_.slowest_seconds)
                                 : options_.timeout;
        const double begin = seconds_now();
        const auto give_up = [&] {
            const double seconds = seconds_now() - begin;
            if (options_.shrinking) options_.shrinking(seconds);
            return stop() || seconds > options_.budget;
        };
        const auto fails = [&](const std::vector<ref::Aabb>& boxes) {
            const BuildAttempt attempt = attempts_(boxes, limit);
            return !stop() && problem_of(attempt, boxes, options_.checks).any();
        };
        const ShrunkBoxes shrunk = shrink_boxes(report_.first->boxes, fails, give_up);
        report_.smallest->tries = shrunk.tries;
        keep_smallest(shrunk.boxes);
    }

    BuilderReport take() { return std::move(report_); }

private:
    bool stop()
    {
        report_.stopped = report_.stopped || (options_.stop && options_.stop());
        return report_.stopped;
    }

    void try_one(const Planned& input)
    {
        BuilderReport::Kind& kind =
            *std::ranges::find(report_.kinds, input.kind, &BuilderReport::Kind::kind);
        if (kind.problem.any()) return;
        const Problem problem =
            try_boxes(input_boxes(input.kind, input.n, input.seed, options_.single_precision));
        if (report_.stopped) return;
        ++kind.tried;
        kind.largest = std::max(kind.largest, input.n);
        kind.problem = problem;
        if (problem.any()) kind.failing = input.n;
    }

    /// Runs the builder on the result again, and reports it if it fails. A race fails now and then only:
    /// the first failure stays then.
    void keep_smallest(const std::vector<ref::Aabb>& boxes)
    {
        SmallestFailure& smallest = *report_.smallest;
        Problem last;
        constexpr std::size_t runs = 5;
        for (std::size_t i = 0; i < runs && !stop(); ++i) {
            const Problem problem =
                problem_of(attempts_(boxes, options_.timeout), boxes, options_.checks);
            if (stop()) break;
            ++smallest.runs_again;
            smallest.failed_again += problem.any() ? 1 : 0;
            if (problem.any()) last = problem;
            if (problem.name == "timeout") break; // once is enough to wait for
        }
        if (last.any()) static_cast<Failure&>(smallest) = {boxes, last};
    }

    const BuildAttempts& attempts_;
    const BuilderOptions& options_;
    BuilderReport report_;
};

std::string seconds_text(double seconds)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g s", seconds);
    return text.data();
}

} // namespace

BuilderReport check_attempts(const BuildAttempts& attempts, const BuilderOptions& options)
{
    Run run(attempts, options);
    run.try_all(plan(options));
    run.shrink();
    return run.take();
}

BuilderReport check_on_input(const BuildAttempts& attempts, const std::vector<ref::Aabb>& boxes,
                             const BuilderOptions& options)
{
    Run run(attempts, options);
    run.try_boxes(boxes);
    run.shrink();
    BuilderReport report = run.take();
    report.planned = 1;
    return report;
}

BuilderReport check_builder(const BuilderFunction& build, const BuilderOptions& options)
{
    const BuildAttempts attempts = [&](std::span<const ref::Aabb> boxes, double limit_seconds) {
        const double begin = seconds_now();
        BuildAttempt attempt{BuildAttempt::End::built};
        try {
            attempt.tree = build(boxes);
        } catch (const std::exception& error) {
            attempt.end = BuildAttempt::End::rejected;
            attempt.text = error.what();
        }
        attempt.seconds = seconds_now() - begin;
        if (attempt.seconds > limit_seconds) {
            attempt.end = BuildAttempt::End::timed_out;
            attempt.text = "it took " + seconds_text(attempt.seconds);
        }
        return attempt;
    };
    return check_attempts(attempts, options);
}

} // namespace check
