// The options of `plumbline check-renderer`.

#include "cli/check_renderer_command.h"

#include "cli/one_of.h"
#include "cli/scene_input.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <stdexcept>

namespace cli {

void add_check_renderer_options(CLI::App& command, CheckRendererCommand& options)
{
    command.add_option("--scenes", options.scenes, "Names of goldens, as a,b [all]")
        ->delimiter(',')
        ->allow_extra_args(false);
    command
        .add_option("--without", options.without,
                    "Features that the renderer does not have, or scenes to leave out")
        ->delimiter(',')
        ->allow_extra_args(false);
    command.add_flag("--list", options.list, "List the scenes and their features, and do no more");
    command.add_option("--suite", options.suite,
                       "Folder with scenes/ and golden/renders/ [this one, or the program's]");
    command.add_option("-s,--samples", options.samples, "{samples}: per pixel, of each picture")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31).description(""))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Each value gives another series of {seed}")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{1'000'000'000}).description(""))
        ->capture_default_str();
    command.add_option("--format", options.format, "Of {out}: exr or pfm")
        ->check(one_of({"exr", "pfm"}))
        ->capture_default_str();
    command.add_option("--pictures", options.pictures, "Pictures of a scene in the first round")
        ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1024}).description(""))
        ->capture_default_str();
    command
        .add_option("--most-pictures", options.most_pictures,
                    "Pictures of a scene, at most; doubled until there is a verdict")
        ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1024}).description(""))
        ->capture_default_str();
    command
        .add_option("--error", options.error,
                    "PASS takes that this error of the whole picture is visible, in percent")
        ->check(CLI::Range(0.01, 50.0).description(""))
        ->capture_default_str();
    command.add_option("--budget", options.budget, "Seconds for all scenes together")
        ->check(CLI::Range(0.0, 1e9).description(""))
        ->capture_default_str();
    command.add_option("--timeout", options.timeout, "Seconds for one picture")
        ->check(CLI::Range(0.01, 1e9).description(""))
        ->capture_default_str();
    command.add_flag("--no-mistakes", options.no_mistakes,
                     "If scenes FAIL, do not look for mistakes of light transport");
    command.add_option("--keep", options.keep,
                       "Keep the pictures in this folder, and take those that are there");
    command.add_option("--report", options.report, "Page with verdicts and pictures: .html");
    command.add_flag("--json", options.json, "Print one JSON object");
    command.add_flag("-q,--quiet", options.quiet, "No progress");
}

void check(const CheckRendererCommand& options)
{
    expect_ending(options.report, "--report", ".html");
    if (options.list) return;
    if (options.command.empty())
        throw std::invalid_argument(
            "no renderer is given: its command follows --, with {scene} and {out}, as in plumbline "
            "check-renderer -- ./mine {scene} {out} (plumbline check-renderer --help)");
    for (const char* needed : {"{scene}", "{out}"})
        if (std::ranges::none_of(options.command, [&](const std::string& word) {
                return word.find(needed) != std::string::npos;
            }))
            throw std::invalid_argument(std::string("the renderer's command does not contain ") +
                                        needed);
    if (options.budget != options.budget || options.timeout != options.timeout ||
        options.error != options.error)
        throw std::invalid_argument("--budget, --timeout and --error expect numbers, and got a NaN");
    if (!options.report.empty()) images::check_place(options.report);
}

} // namespace cli
