// `plumbline compare`: compares a picture with a golden, and prints the result as text, as JSON, or as a
// page.

#include "cli/compare_command.h"

#include "cli/compare_candidate.h"
#include "cli/interrupt.h"
#include "cli/output_files.h"
#include "cli/scene_input.h"
#include "golden/golden.h"
#include "golden/reason.h"
#include "golden/report.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace cli {

namespace {

ExitStatus status_of(golden::Verdict verdict)
{
    switch (verdict) {
    case golden::Verdict::pass:
        return fine;
    case golden::Verdict::fail:
        return check_failed;
    case golden::Verdict::inconclusive:
        return inconclusive;
    }
    throw std::logic_error("no such verdict");
}

/// "9.87%", "none" for infinity (no error is detectable), "-" for NaN (the golden is black).
std::string percent_text(double share)
{
    if (std::isnan(share)) return "-";
    if (std::isinf(share)) return "none";
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.2f%%", 100.0 * share);
    return text.data();
}

/// "+2.31"; "none" where neither side has noise.
std::string z_text(double z)
{
    if (std::isinf(z)) return "none";
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%+.2f", z);
    return text.data();
}

/// A row of the table of the whole picture: ratio and interval, or "-" where the golden is black.
void print_whole(const golden::Finding& whole, const char* channel, double detectable)
{
    if (std::isfinite(whole.ratio) && std::isfinite(whole.interval.low) &&
        std::isfinite(whole.interval.high))
        std::printf("  %-12s %12.3f%%   %8.3f%% .. %8.3f%%   %12s\n", channel, 100.0 * whole.ratio,
                    100.0 * whole.interval.low, 100.0 * whole.interval.high,
                    percent_text(detectable).c_str());
    else
        std::printf("  %-12s %13s   %22s   %12s\n", channel, "-", "-", percent_text(detectable).c_str());
}

void print_screen(const golden::Comparison& comparison)
{
    std::printf("%s  %s\n\n", describe(comparison.verdict).c_str(), comparison.reason.c_str());
    std::printf("method      %s\n", describe(comparison.method).c_str());
    for (const golden::Stage& stage : comparison.stages)
        std::printf("stage       %llu batches: p = %.3g, suspicious below %.3g\n",
                    static_cast<unsigned long long>(stage.batches), stage.p, stage.level);
    std::printf("conclusive  %.1f%% of %zu tests\n", 100.0 * comparison.coverage,
                comparison.findings.size());
    if (comparison.noise_ratio) std::printf("noise       %s\n", say_noise(comparison).c_str());
    if (const std::string limit = say_golden_limit(comparison); !limit.empty())
        std::printf("golden      %s\n", limit.c_str());
    std::printf("\nwhole picture  candidate/golden     99%% interval           detectable\n");
    for (std::size_t c = 0; c < golden::channel_count; ++c)
        print_whole(whole_picture(comparison, c), golden::channel_names[c], comparison.detectable[c]);
    std::vector<const golden::Finding*> worst;
    for (const golden::Finding& finding : comparison.findings)
        if (finding.conclusive) worst.push_back(&finding);
    const auto shown = std::min<std::size_t>(5, worst.size());
    std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(shown), worst.end(),
                      [](const auto* a, const auto* b) { return a->test.p < b->test.p; });
    std::printf("\nmost significant\n");
    for (std::size_t i = 0; i < shown; ++i)
        std::printf("  z %6s  p %8.2g (adjusted %8.2g)  ratio %9s  %s\n",
                    z_text(worst[i]->test.z).c_str(), worst[i]->test.p, worst[i]->adjusted_p,
                    percent_text(worst[i]->ratio).c_str(), describe(*worst[i]).c_str());
    if (comparison.least_sensitive_stratum) {
        const golden::Finding& least_sensitive =
            comparison.findings[*comparison.least_sensitive_stratum];
        std::printf("\nleast sensitive stratum: %s\n", describe(least_sensitive).c_str());
        if (std::isfinite(least_sensitive.detectable))
            std::printf("  where an error of %.2f%% is detectable\n",
                        100.0 * least_sensitive.detectable);
        else
            std::printf("  where no error is detectable\n");
    }
}

ExitStatus compare_command(const CompareCommand& options)
{
    expect_ending(options.report, "--report", ".html");
    std::vector<NamedFile> compared;
    for (const std::string& file : options.pictures) compared.push_back({"the picture", file});
    expect_different_files({{"--report", options.report}}, compared);
    if (!options.report.empty()) images::check_place(options.report);
    const golden::Golden golden = golden::read_golden(options.pictures.back());
    catch_interrupts();
    const std::vector<std::string> files(options.pictures.begin(), options.pictures.end() - 1);
    const JudgedCandidate judged = judge(golden, files, options);
    const golden::Report report{std::filesystem::path(files.front()).filename().string() + " against " +
                                    std::filesystem::path(options.pictures.back()).filename().string(),
                                judged.comparison,
                                golden,
                                judged.mean,
                                judged.metadata,
                                judged.strategies};
    if (!options.report.empty()) golden::write_report(options.report, report);
    if (options.json) {
        std::cout << golden::report_json(report) << std::endl;
    } else {
        print_screen(judged.comparison);
        if (judged.comparison.verdict == golden::Verdict::fail && judged.comparison.diagnosis.empty() &&
            options.scene.empty() && judged.comparison.method != golden::Method::ranks)
            std::puts(
                "\n--scene FILE, the golden's scene, looks for mistakes of light transport as well");
        if (judged.comparison.verdict == golden::Verdict::fail)
            std::puts("\ndocs/bugs.md shows what usual mistakes look like");
    }
    return status_of(judged.comparison.verdict);
}

} // namespace

void add_compare_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<CompareCommand>();
    CLI::App* command = program.add_subcommand("compare", "Compare a picture with a golden");
    add_compare_options(*command, *options);
    command->footer("A candidate is an .exr, a .pfm, or a scene, .dae, that is rendered here.\n"
                    "Exit status: 0 PASS, 1 FAIL, 3 INCONCLUSIVE, 2 bad input.\n"
                    "Example: plumbline compare mine.exr golden/renders/cornell_glass.exr -s 1024");
    command->callback([options, &work] { work = [options] { return compare_command(*options); }; });
}

} // namespace cli
