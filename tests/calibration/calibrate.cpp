// calibrate FILE: measures how often the comparison of pictures is wrong, and writes the tables into
// FILE, between the lines that mark their places. The seeds are fixed, so the same program always gives
// the same tables.

#include "cli/progress.h"
#include "golden/false_alarm.h"
#include "images/atomic_file.h"
#include "tests/calibration/experiments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <iostream>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace calibration;
using golden::Method;

constexpr int pictures_of_suite = 21;

struct Case {
    const char* name;
    Bias bias;
};
constexpr std::array cases = {Case{"none", {}}, Case{"-1% everywhere", {.everywhere = 0.99}},
                              Case{"-0.3% everywhere", {.everywhere = 0.997}},
                              Case{"-5% in the caustic", {.in_caustic = 0.95}},
                              Case{"-2% in the shadow", {.in_shadow = 0.98}}};

std::string number(const char* format, double value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

std::string percent(double fraction)
{
    return number("%.2f%%", 100.0 * fraction);
}

double rate(const Count& count)
{
    return static_cast<double>(count.hits) / static_cast<double>(count.trials);
}

std::string with_interval(const Count& count)
{
    const golden::Interval interval = rate_interval(count);
    return percent(rate(count)) + " (" + percent(interval.low) + " to " + percent(interval.high) + ")";
}

Plan make_plan(int size, int goldens, int trials)
{
    Plan plan;
    plan.size = size;
    plan.goldens = goldens;
    plan.trials = trials;
    plan.threads = std::max(1U, std::thread::hardware_concurrency());
    return plan;
}

double trials_of(const Plan& plan)
{
    return static_cast<double>(plan.goldens * plan.trials);
}

Plan false_alarm_plan()
{
    return make_plan(64, 20, 10);
}

Plan power_plan(Noise noise)
{
    return noise == Noise::lognormal ? make_plan(128, 2, 50) : make_plan(128, 1, 20);
}

Plan estimator_plan()
{
    return make_plan(128, 1, 20);
}

Plan criterion_plan()
{
    return make_plan(128, 1, 200);
}

void write_false_alarms(std::ostream& out, const Tick& tick)
{
    Plan plan = false_alarm_plan();
    plan.tick = tick;
    out << "Right pictures of " << plan.size << "x" << plan.size << " pixels, " << plan.goldens
        << " goldens with " << plan.trials << " candidates each:\n\n"
        << "| noise | suspected (95% interval; at most 20%) | FAIL | p < 1e-3 | p < 1e-5 | twice p < 1% "
           "| "
           "in theory |\n|---|---|---|---|---|---|---|\n";
    FalseAlarms all;
    for (const Noise noise : noises) {
        const FalseAlarms r = measure_false_alarms(noise, plan);
        out << "| " << name(noise) << " | " << with_interval(r.screened) << " | " << r.failed.hits
            << " of " << r.failed.trials << " | " << number("%.2e", rate(r.below_1e3)) << " | "
            << number("%.1e", rate(r.below_1e5)) << " | " << number("%.2e", rate(r.twice)) << " | "
            << number("%.2e", r.expected_twice) << " |\n";
        all.screened.hits += r.screened.hits;
        all.screened.trials += r.screened.trials;
        all.failed.hits += r.failed.hits;
        all.failed.trials += r.failed.trials;
    }
    out << "| all | " << with_interval(all.screened) << " | " << all.failed.hits << " of "
        << all.failed.trials << " | | | | |\n\n";
    // The functionals depend only on the size of the picture.
    golden::Pilot pilot{images::Image(128, 128), images::Image(128, 128), 512};
    const golden::Functionals functionals(pilot);
    const golden::CompareOptions options;
    const double bound =
        golden::false_alarm_bound(functionals, Method::ranks, 512, options.stages, options);
    out << "Bound of the chance that a right picture FAILs, all stages together: "
        << number("%.1e", bound) << "; that one of " << pictures_of_suite
        << " does: " << number("%.1e", bound * pictures_of_suite) << ".\n\n";
}

void write_power(std::ostream& out, const Tick& tick)
{
    out << "Share of FAILs (for a picture with no error: of PASSes) among candidates of 128x128 pixels, "
           "stages of 256 and 1024 samples per pixel; "
        << trials_of(power_plan(Noise::lognormal)) << " candidates for lognormal noise, "
        << trials_of(power_plan(Noise::gamma)) << " for the others:\n\n| noise |";
    for (const Case& c : cases) out << " " << c.name << " |";
    out << "\n|---|---|---|---|---|---|\n";
    for (const Noise noise : noises) {
        out << "| " << name(noise) << " |";
        for (const Case& c : cases) {
            Plan plan = power_plan(noise);
            plan.tick = tick;
            const Verdicts v = measure_verdicts(Method::ranks, noise, noise, c.bias, plan);
            const std::uint64_t hits = &c == cases.data() ? v.pass : v.fail;
            out << " " << number("%.2f", rate({hits, v.trials()}));
            if (noise == Noise::lognormal) {
                const golden::Interval i = rate_interval({hits, v.trials()});
                out << " (" << number("%.2f", i.low) << " to " << number("%.2f", i.high) << ")";
            }
            out << " |";
        }
        out << "\n";
    }
    out << "\n";
}

constexpr std::array hard_cases = {Case{"-5% in the caustic", {.in_caustic = 0.95}},
                                   Case{"-2% in the shadow", {.in_shadow = 0.98}}};

Plan fresh_plan()
{
    return make_plan(128, 1, 20);
}

void write_fresh_power(std::ostream& out, const Tick& tick)
{
    out << "Share of FAILs of " << trials_of(fresh_plan())
        << " candidates each, of pictures on which nothing was chosen:\n\n"
           "| caustic: share of pixels, brightness, samples with light | shadow: samples with light | "
           "noise | -5% in the caustic | -2% in the shadow |\n|---|---|---|---|---|\n";
    for (const Layout& layout : fresh_layouts)
        for (const Noise noise : noises) {
            out << "| " << percent(layout.caustic_share) << ", "
                << number("%.0f", layout.caustic_brightness) << " times, "
                << percent(layout.light_in_caustic) << " | " << percent(layout.light_in_shadow) << " | "
                << name(noise) << " |";
            for (const Case& c : hard_cases) {
                Plan plan = fresh_plan();
                plan.tick = tick;
                plan.layout = layout;
                const Verdicts v = measure_verdicts(Method::ranks, noise, noise, c.bias, plan);
                out << " " << number("%.2f", rate({v.fail, v.trials()})) << " |";
            }
            out << "\n";
        }
    out << "\n";
}

constexpr std::array caustic_noises = {Noise::lognormal, Noise::pareto_20, Noise::pareto_15};

Plan caustic_plan()
{
    Plan plan = make_plan(128, 5, 20);
    plan.seed = 2;
    plan.population = 1;
    return plan;
}

void write_caustic(std::ostream& out, const Tick& tick)
{
    Plan plan = caustic_plan();
    plan.tick = tick;
    out << "The caustic 5% too dark, " << plan.goldens << " goldens with " << plan.trials
        << " candidates each, of populations of samples on which nothing was chosen:\n\n"
           "| noise | FAIL (95% interval) | by the strongest suspicion alone | found only by another "
           "one "
           "| PASS | INCONCLUSIVE | smallest error in the least sensitive stratum that a PASS states |\n"
           "|---|---|---|---|---|---|---|\n";
    for (const Noise noise : caustic_noises) {
        const Verdicts v = measure_verdicts(Method::ranks, noise, noise, {.in_caustic = 0.95}, plan);
        out << "| " << name(noise) << " | " << with_interval({v.fail, v.trials()}) << " | "
            << v.by_strongest << " | " << v.fail - v.by_strongest << " | " << v.pass << " | "
            << v.inconclusive << " | "
            << (v.pass == 0                  ? "-"
                : std::isinf(v.least_stated) ? "none"
                                             : percent(v.least_stated))
            << " |\n";
    }
    out << "\n";
}

void write_other_estimators(std::ostream& out, const Tick& tick)
{
    Plan plan = estimator_plan();
    plan.tick = tick;
    out << "Candidates of another renderer, " << plan.trials
        << " each, against a golden with lognormal noise; PASS / FAIL / INCONCLUSIVE:\n\n"
        << "| candidate | noise | right | 1% too dark |\n|---|---|---|---|\n";
    for (const Method method : {Method::welch, Method::picture})
        for (const Noise noise : {Noise::lognormal, Noise::gamma, Noise::pareto_25}) {
            out << "| "
                << (method == Method::welch ? "64 pictures of 4 samples" : "one picture of 256 samples")
                << " | " << name(noise) << " |";
            for (const Bias& bias : {Bias{}, Bias{.everywhere = 0.99}}) {
                const Verdicts v = measure_verdicts(method, Noise::lognormal, noise, bias, plan);
                out << " " << v.pass << " / " << v.fail << " / " << v.inconclusive << " |";
            }
            out << "\n";
        }
    out << "\n";
}

constexpr std::array few_pictures = {2, 4, 8, 16, 32, 64};
constexpr std::array few_noises = {Noise::lognormal, Noise::gamma, Noise::pareto_25};
constexpr std::array few_wrong = {0.99, 0.97};

Plan few_right_plan()
{
    return make_plan(64, 5, 20);
}

Plan few_wrong_plan()
{
    return make_plan(64, 1, 20);
}

std::string triple(const Verdicts& v)
{
    return std::to_string(v.pass) + " / " + std::to_string(v.fail) + " / " +
           std::to_string(v.inconclusive);
}

void write_few_pictures(std::ostream& out, const Tick& tick)
{
    Plan right_plan = few_right_plan();
    right_plan.tick = tick;
    Plan wrong_plan = few_wrong_plan();
    wrong_plan.tick = tick;
    out << "Few pictures of another renderer, of 64x64 pixels and 64 samples each, against goldens with "
           "lognormal noise; PASS / FAIL / INCONCLUSIVE. "
        << trials_of(right_plan) << " right candidates each, and " << trials_of(wrong_plan)
        << " wrong ones:\n\n| pictures | noise | right | suspected (at most 5%) | detectable error | "
           "conclusive | p < 1e-3 | p < 1e-5 | 1% too dark | 3% too dark |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n";
    for (const int pictures : few_pictures)
        for (const Noise noise : few_noises) {
            const FewPictures r =
                measure_few_pictures(pictures, Noise::lognormal, noise, {}, right_plan);
            out << "| " << pictures << " | " << name(noise) << " | " << triple(r.verdicts) << " | "
                << percent(rate(r.suspected)) << " | "
                << (std::isinf(r.detectable) ? "none" : percent(r.detectable)) << " | "
                << percent(r.conclusive) << " | " << number("%.1e", rate(r.below_1e3)) << " | "
                << number("%.1e", rate(r.below_1e5)) << " |";
            for (const double factor : few_wrong)
                out << " "
                    << triple(measure_few_pictures(pictures, Noise::lognormal, noise,
                                                   {.everywhere = factor}, wrong_plan)
                                  .verdicts)
                    << " |";
            out << "\n";
        }
    out << "\n";
}

void write_other_criteria(std::ostream& out, const Tick& tick)
{
    Plan plan = criterion_plan();
    plan.tick = tick;
    out << "Share of wrong pictures (256 samples per pixel, lognormal noise) that a criterion finds if "
           "its "
           "threshold is set to reject one right picture in a hundred; "
        << plan.trials << " of each:\n\n| criterion |";
    for (std::size_t i = 1; i < cases.size(); ++i) out << " " << cases[i].name << " |";
    out << "\n|---|---|---|---|---|\n";
    std::vector<std::vector<Count>> found;
    for (std::size_t i = 1; i < cases.size(); ++i)
        found.push_back(measure_other_criteria(Noise::lognormal, cases[i].bias, plan));
    for (std::size_t k = 0; k < other_criteria().size(); ++k) {
        out << "| " << other_criteria()[k].name << " |";
        for (const std::vector<Count>& counts : found)
            out << " " << number("%.2f", rate(counts[k])) << " |";
        out << "\n";
    }
    out << "\n";
}

struct Table {
    const char* name;
    void (*write)(std::ostream& out, const Tick& tick);
    double trials; // number of ticks
};

std::vector<Table> tables()
{
    double power_trials = 0.0;
    for (const Noise noise : noises)
        power_trials += static_cast<double>(cases.size()) * trials_of(power_plan(noise));
    return {{"other-criteria", write_other_criteria,
             static_cast<double>(cases.size() - 1) * trials_of(criterion_plan())},
            {"false-alarms", write_false_alarms,
             static_cast<double>(noises.size()) * trials_of(false_alarm_plan())},
            {"power", write_power, power_trials},
            {"fresh-power", write_fresh_power,
             static_cast<double>(fresh_layouts.size() * noises.size() * hard_cases.size()) *
                 trials_of(fresh_plan())},
            {"caustic", write_caustic,
             static_cast<double>(caustic_noises.size()) * trials_of(caustic_plan())},
            {"few-pictures", write_few_pictures,
             static_cast<double>(few_pictures.size() * few_noises.size()) *
                 (trials_of(few_right_plan()) +
                  static_cast<double>(few_wrong.size()) * trials_of(few_wrong_plan()))},
            {"other-estimators", write_other_estimators, 2.0 * 3.0 * 2.0 * trials_of(estimator_plan())}};
}

/// `text` with the text between the marks of this table replaced.
std::string replace_table(const std::string& text, const std::string& name, const std::string& table)
{
    const std::string begin = "<!-- calibrate: begin " + name + " -->\n";
    const std::string end = "<!-- calibrate: end " + name + " -->\n";
    const std::size_t from = text.find(begin);
    const std::size_t to = text.find(end);
    if (from == std::string::npos || to == std::string::npos || to < from)
        throw std::runtime_error("there is no place for the table " + name + ": no line " + begin);
    return text.substr(0, from + begin.size()) + table + text.substr(to);
}

void calibrate(const std::string& file, const std::vector<std::string>& names)
{
    std::vector<Table> chosen;
    for (const Table& table : tables())
        if (names.empty() || std::find(names.begin(), names.end(), table.name) != names.end())
            chosen.push_back(table);
    if (chosen.size() < names.size()) throw std::runtime_error("there is no such table");
    for (const Table& table : chosen)
        replace_table(images::read_file(file), table.name, ""); // throws if it has no place
    for (const Table& table : chosen) {
        std::ostringstream out;
        {
            cli::Progress progress(table.name, 0.0, table.trials, false);
            std::mutex mutex;
            double done = 0.0;
            table.write(out, [&] {
                const std::lock_guard lock(mutex);
                progress.update(++done);
            });
        }
        std::cout << out.str() << std::flush;
        images::write_atomically(file, replace_table(images::read_file(file), table.name, out.str()));
    }
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        std::cerr << "Usage: calibrate docs/comparison.md [TABLE...]\n";
        return 2;
    }
    try {
        calibrate(argv[1], {argv + 2, argv + argc});
    } catch (const std::exception& error) {
        std::cerr << "calibrate: " << error.what() << "\n";
        return 2;
    }
    return 0;
}
