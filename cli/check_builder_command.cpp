// `plumbline check-builder`: runs another program's builder over inputs that builders fail on.

#include "cli/check_builder_command.h"

#include "check/shell_line.h"
#include "check/trees/check_builder.h"
#include "check/trees/command_builder.h"
#include "check/trees/report.h"
#include "check/trees/tree_files.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/words_after_dashes.h"
#include "images/atomic_file.h"
#include "images/temporary_folder.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace cli {

namespace {

/// The kinds of input that the options ask for. Throws std::invalid_argument for an unknown name, and if
/// none is left.
std::vector<check::InputKind> chosen_kinds(const CheckBuilderCommand& options)
{
    for (const auto& names : {options.kinds, options.skipped})
        for (const std::string& name : names)
            if (std::ranges::none_of(check::input_kinds,
                                     [&](check::InputKind kind) { return check::name(kind) == name; })) {
                std::string known;
                for (const check::InputKind kind : check::input_kinds) known += " " + check::name(kind);
                throw std::invalid_argument(name + ": no such kind of input (those there are:" + known +
                                            ")");
            }
    const auto is_in = [](const std::vector<std::string>& names, check::InputKind kind) {
        return std::ranges::find(names, check::name(kind)) != names.end();
    };
    std::vector<check::InputKind> kinds;
    for (const check::InputKind kind : check::input_kinds)
        if ((options.kinds.empty() || is_in(options.kinds, kind)) && !is_in(options.skipped, kind))
            kinds.push_back(kind);
    if (kinds.empty()) throw std::invalid_argument("no kind of input is left to try");
    return kinds;
}

std::string command_to_repeat(const CheckBuilderCommand& options)
{
    std::string text = "plumbline check-builder --input " + check::shell_word(options.keep);
    if (options.loose) text += " --loose";
    if (options.max_depth) text += " --max-depth " + std::to_string(*options.max_depth);
    return text + " -- " + check::shell_line(options.command);
}

check::BuilderReport tried(const CheckBuilderCommand& options, check::BuilderOptions limits,
                           check::PrimitiveFormat& format)
{
    const images::TemporaryFolder folder;
    check::Primitives input;
    if (!options.input.empty()) {
        input = check::read_primitives(options.input);
        format = input.format;
    }
    const check::BuildAttempts attempts =
        check::command_builder(options.command, format, folder.path(), interrupt_requested);
    std::optional<Progress> progress;
    std::optional<Progress> shrinking;
    limits.progress = [&](std::size_t done, std::size_t total) {
        if (!progress) progress.emplace("inputs", 0.0, static_cast<double>(total), options.quiet);
        progress->update(static_cast<double>(done));
    };
    limits.shrinking = [&](double seconds) {
        progress.reset();
        if (!shrinking) shrinking.emplace("shrinking, at most", 0.0, limits.budget, options.quiet);
        shrinking->update(seconds);
    };
    if (!options.input.empty()) return check_on_input(attempts, input.boxes, limits);
    return check_attempts(attempts, limits);
}

void print(const check::BuilderReport& report, const CheckBuilderCommand& options)
{
    if (options.json) {
        std::cout << json(report) << std::endl;
        return;
    }
    std::cout << describe(report);
    if (report.smallest)
        std::cout << "It is in " << options.keep << ". To run it again:\n  "
                  << command_to_repeat(options) << "\n";
    else if (report.passes())
        std::cout << "No input fails.\n";
    std::cout << std::flush;
}

ExitStatus check_builder(const CheckBuilderCommand& options)
{
    check::BuilderOptions limits;
    limits.kinds = chosen_kinds(options);
    limits.seed = options.seed;
    limits.cases = options.cases;
    limits.largest = options.largest;
    limits.timeout = options.timeout;
    limits.budget = options.budget;
    limits.single_precision = !options.double_precision;
    limits.checks.tight = !options.loose;
    limits.checks.max_depth = options.max_depth;
    limits.stop = interrupt_requested;
    if (options.command.empty())
        throw std::invalid_argument(
            "no builder is given: its command follows --, as in plumbline check-builder -- ./mine "
            "{primitives} {tree} (plumbline check-builder --help)");
    images::check_place(options.keep);
    catch_interrupts();

    check::PrimitiveFormat format{options.triangles, limits.single_precision};
    const check::BuilderReport report = tried(options, limits, format);
    if (report.smallest)
        images::write_atomically(options.keep, check::primitives_bytes(report.smallest->boxes, format));
    if (report.stopped && !report.smallest) throw Interrupted{};
    print(report, options);
    return report.stopped ? interrupted : report.passes() ? fine : check_failed;
}

void add_check_builder_options(CLI::App& command, CheckBuilderCommand& options)
{
    command.add_option("--input", options.input, "Try the primitives in this file only: .npy, .json");
    command.add_option("--keep", options.keep, "File for the smallest input that fails: .npy")
        ->capture_default_str();
    command.add_flag("--triangles", options.triangles, "Give it triangles, not boxes");
    command.add_flag("--float64", options.double_precision, "Give it doubles, not floats");
    command.add_flag("--loose", options.loose, "Boxes may be larger than necessary");
    command.add_option("--max-depth", options.max_depth,
                       "Most edges from the root to a leaf [no limit]");
    command.add_option("--only", options.kinds, "Kinds of input, as grid,flat [all]")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--skip", options.skipped, "Kinds of input to leave out")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_option("--cases", options.cases, "Random inputs besides the planned ones")
        ->check(CLI::Range(0, 1'000'000'000).description(""))
        ->capture_default_str();
    command.add_option("--largest", options.largest, "Most primitives of an input")
        ->check(CLI::Range(0, 1 << 24).description(""))
        ->capture_default_str();
    command.add_option("--timeout", options.timeout, "Seconds for one run")
        ->check(CLI::Range(0.01, 1e6).description(""))
        ->capture_default_str();
    command
        .add_option("--budget", options.budget, "Seconds for all runs, and as many to shrink a failure")
        ->check(CLI::Range(0.01, 1e9).description(""))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Of the inputs")
        ->check(CLI::Range(std::uint64_t{0}, (std::uint64_t{1} << 32) - 1).description(""))
        ->capture_default_str();
    command.add_flag("--json", options.json, "Print one JSON object");
    command.add_flag("-q,--quiet", options.quiet, "No progress");
}

} // namespace

void add_check_builder_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<CheckBuilderCommand>();
    CLI::App* command = program.add_subcommand(
        "check-builder", "Run another program's tree builder over inputs that builders fail on");
    add_check_builder_options(*command, *options);
    command->footer(
        "Example: plumbline check-builder -- ./my_builder {primitives} {tree}\n"
        "Exit status 1: an input fails. docs/own-code.md has the formats and the kinds of input.");
    command->callback([options, &work] {
        options->command = words_after_dashes();
        work = [options] { return check_builder(*options); };
    });
}

} // namespace cli
