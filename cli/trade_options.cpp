// The options of `plumbline trade`.

#include "cli/trade_command.h"

#include "cli/output_files.h"
#include "cli/scene_input.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>

#include <stdexcept>

namespace cli {

void add_trade_options(CLI::App& command, TradeCommand& options)
{
    command.add_option("scene", options.scene, "COLLADA file; none with --from");
    command.add_option("--size", options.size, "Width x height in pixels")->capture_default_str();
    command.add_flag("--frame", options.frame, "Move the camera back until the whole scene is visible");
    command.add_option("--seconds", options.seconds, "Time for all measurements together, about")
        ->check(CLI::Range(0.1, 1e7).description(""))
        ->capture_default_str();
    command.add_option("--rounds", options.rounds, "Rounds: in each, everything is measured once")
        ->check(CLI::Range(2, 1000).description(""))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Of the order of measurements and of the renders")
        ->check(CLI::Range(std::uint64_t{0}, (std::uint64_t{1} << 32) - 1).description(""))
        ->capture_default_str();
    command.add_option("--base", options.base,
                       "What is varied: OPTION=VALUE ... [path, device=host threads=1]");
    command.add_option("--knobs", options.knobs,
                       "What to vary: NAME or NAME=VALUE,VALUE ..., or all [those with *]");
    command.add_flag("--needs", options.needs,
                     "Vary what the scene does not require: what does leaving it out gain?");
    command.add_option("-o,--output", options.output, "Results: .json");
    command.add_option("--report", options.report, "Page for people, without other files: .html");
    command.add_flag("--resume", options.resume, "Go on with the measurements in the output");
    command.add_option("--from", options.from, "Measure nothing: show the results in this .json of -o");
    command.add_option("--truth", options.truth, "Golden to compare with [a render kept in --cache]");
    command
        .add_option("--truth-seconds", options.truth_seconds, "Time to render the truth, the first time")
        ->check(CLI::Range(0.1, 1e7).description(""))
        ->capture_default_str();
    command.add_option("--cache", options.cache, "Folder of truths [$XDG_CACHE_HOME/plumbline]");
    command.add_flag("--json", options.json, "Print the results as JSON and not as a table");
    command.add_flag("-q,--quiet", options.quiet, "No progress and no notices");
}

void check(const TradeCommand& options)
{
    if (options.scene.empty() && options.from.empty()) throw std::invalid_argument("scene is required");
    // Not by CLI11's excludes, which takes three lines of the help.
    if (!options.from.empty() && (!options.scene.empty() || options.resume || !options.output.empty()))
        throw std::invalid_argument("--from measures nothing: it takes no scene, -o or --resume");
    if (options.scene == "-")
        throw std::invalid_argument("trade -: expected the name of a scene file, because it is read "
                                    "again by every process that measures memory");
    parse_size(options.size);
    expect_ending(options.output, "-o", ".json");
    expect_ending(options.report, "--report", ".html");
    if (options.resume && options.output.empty())
        throw std::invalid_argument("--resume needs -o: it goes on with the results in that file");
    expect_different_files(
        {{"-o", options.output}, {"--report", options.report}},
        {{"the scene", options.scene}, {"--truth", options.truth}, {"--from", options.from}});
    for (const std::string& path : {options.output, options.report})
        if (!path.empty()) images::check_place(path);
}

} // namespace cli
