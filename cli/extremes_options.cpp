// The options of `plumbline extremes`.

#include "cli/extremes_command.h"

#include "cli/output_files.h"
#include "cli/scene_input.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>

#include <stdexcept>

namespace cli {

void add_extremes_options(CLI::App& command, ExtremesCommand& options)
{
    command.add_option("axes", options.axes, "Names or numbers of axes [all]");
    command.add_flag("--list", options.list, "List the axes and their methods, and do no more");
    command.add_option("--methods", options.methods, "Names of methods, as \"ref\" \"host\" [all]");
    command.add_option("--cases", options.cases, "Random cases at each point")
        ->check(CLI::Range(1, 1'000'000'000).description(""))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "Of the random cases")
        ->check(CLI::Range(std::uint64_t{0}, (std::uint64_t{1} << 32) - 1).description(""))
        ->capture_default_str();
    command.add_option("-t,--threads", options.threads, "Threads [as many as the processor has]")
        ->check(CLI::Range(1, 4096).description(""));
    command.add_option("-o,--output", options.output, "Results: .json");
    command.add_option("--report", options.report, "Page for people, without other files: .html");
    command.add_flag("--resume", options.resume, "Go on with the points in the output");
    command.add_option("--from", options.from, "Walk nothing: show the results in these .json of -o")
        ->excludes("--resume")
        ->excludes("--output")
        ->excludes("--cases")
        ->excludes("--seed");
    command.add_flag("--json", options.json, "Print the results as JSON and not as a table");
    command
        .add_flag("--markdown", options.markdown,
                  "Print the results as a part of docs/results/extremes.md")
        ->excludes("--json");
    command.add_flag("-q,--quiet", options.quiet, "No progress");
}

void check(const ExtremesCommand& options)
{
    expect_ending(options.output, "-o", ".json");
    expect_ending(options.report, "--report", ".html");
    if (options.resume && options.output.empty())
        throw std::invalid_argument("--resume needs -o: it goes on with the results in that file");
    for (const std::string& from : options.from)
        expect_different_files({{"-o", options.output}, {"--report", options.report}},
                               {{"--from", from}});
    expect_different_files({{"-o", options.output}, {"--report", options.report}});
    for (const std::string& path : {options.output, options.report})
        if (!path.empty()) images::check_place(path);
}

} // namespace cli
