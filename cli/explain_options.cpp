// The options of `plumbline explain`. Those that choose the picture are those of `render`.

#include "cli/explain_command.h"
#include "cli/one_of.h"
#include "cli/output_files.h"
#include "cli/reference_options.h"
#include "cli/scene_input.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <stdexcept>

namespace cli {

void add_explain_options(CLI::App& command, ExplainCommand& options)
{
    command.add_option("scene", options.render.scene, "COLLADA file; -: standard input")->required();
    command.add_option("--pixel", options.pixel,
                       "X,Y: column from the left and row from the top, from 0");
    command.add_option("--sample", options.sample, "Number of the pixel's sample, from 0")
        ->check(CLI::Range(0u, (1u << 31) - 1).description(""))
        ->capture_default_str();
    command.add_option("--where", options.where,
                       "First sample with such a strategy: s=2,t=2,weight>0.5");
    command.add_flag("--largest", options.largest,
                     "The sample that raises the mean of its pixel most: a firefly");
    command
        .add_option("-s,--samples", options.render.samples,
                    "Samples per pixel that --where and --largest search")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31).description(""))
        ->capture_default_str();
    command.add_option("-t,--threads", options.render.threads, "Threads of --largest")
        ->check(CLI::Range(1u, 1024u).description(""))
        ->capture_default_str();
    command.add_option("--size", options.render.size, "Width x height of the picture in pixels")
        ->capture_default_str();
    command
        .add_option("--device", options.render.device,
                    "ref; or host: the sample of the fast path in floats, beside it")
        ->check(one_of({"ref", "host"}))
        ->capture_default_str();
    add_estimator_options(command, options.render);
    add_experiment_options(command, options.render);
    command.add_flag("--frame", options.render.frame,
                     "Move the camera back until the whole scene is visible");
    command.add_option("--picture", options.picture, "Draw the paths in the scene, to this .svg");
    command.add_option("--report", options.report, "Interactive page of the sample, to this .html");
    command.add_flag("--json", options.json, "Print one JSON object, with all digits");
    command.add_flag("-q,--quiet", options.render.quiet, "No progress and no notices");
}

void check(const ExplainCommand& options, const CLI::App& command)
{
    const auto exclude = [&](const char* option, bool excluded, const char* why) {
        if (excluded && command.get_option(option)->count() > 0)
            throw std::invalid_argument(std::string(option) + " has no effect " + why);
    };
    const bool where = command.get_option("--where")->count() > 0;
    const bool searches = options.largest || where;
    if (options.largest && where)
        throw std::invalid_argument("--where and --largest exclude each other");
    if (!searches && options.pixel.empty())
        throw std::invalid_argument("explain needs --pixel X,Y, or --where or --largest to find one");
    exclude("--pixel", options.largest, "with --largest, which searches the whole picture");
    exclude("--sample", searches, "with --where or --largest, which find one");
    exclude("--samples", !searches, "without --where or --largest: --sample names the sample");
    expect_ending(options.picture, "--picture", ".svg");
    expect_ending(options.report, "--report", ".html");
    expect_different_files({{"--picture", options.picture}, {"--report", options.report}},
                           {{"the scene", options.render.scene}});
    for (const std::string& file : {options.picture, options.report})
        if (!file.empty()) images::check_place(file);
    exclude("--threads", !options.largest, "without --largest");
}

std::uint32_t pixel_of(const ExplainCommand& options, int width, int height)
{
    const std::string& text = options.pixel;
    const char* const end = text.data() + text.size();
    int x = -1;
    int y = -1;
    const auto [comma, x_error] = std::from_chars(text.data(), end, x);
    const bool first = x_error == std::errc() && comma != end && *comma == ',';
    const auto [rest, y_error] = std::from_chars(first ? comma + 1 : end, end, y);
    if (!first || y_error != std::errc() || rest != end)
        throw std::invalid_argument("--pixel " + text + ": expected X,Y, such as 120,80");
    if (x < 0 || x >= width || y < 0 || y >= height)
        throw std::invalid_argument("--pixel " + text + ": the picture has columns 0 to " +
                                    std::to_string(width - 1) + " and rows 0 to " +
                                    std::to_string(height - 1) + " (--size)");
    return static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width) +
           static_cast<std::uint32_t>(x);
}

} // namespace cli
