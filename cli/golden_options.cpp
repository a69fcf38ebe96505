// The options of `plumbline golden`.

#include "cli/golden_command.h"
#include "cli/render_command.h"

#include <CLI/CLI.hpp>

#include <stdexcept>

namespace cli {

void add_golden_options(CLI::App& command, GoldenCommand& options)
{
    command.add_option("scenes", options.scenes, "COLLADA files");
    CLI::Option* all = command.add_flag("--all", options.all, "All .dae files in the scene folder");
    command.add_option("--scene-folder", options.scene_folder, "Folder of the scenes of --all")
        ->needs(all)
        ->capture_default_str();
    command.add_option("--folder", options.folder, "Folder of the goldens")->capture_default_str();
    command.add_option("--size", options.size, "Width x height in pixels")->capture_default_str();
    command.add_option("-s,--samples", options.samples, "Samples per pixel, the pilot's included")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31))
        ->capture_default_str();
    command.add_option("--batch", options.batch_size, "Samples per pixel in a batch")
        ->check(CLI::Range(1u, 1u << 20))
        ->capture_default_str();
    command
        .add_option("--pilot", options.pilot_batches,
                    "Batches from which weights and regions are computed, not compared")
        ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1} << 20))
        ->capture_default_str();
    command.add_option("--max-edges", options.max_edges, "Longest path, the camera's edge counted")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command.add_option("-t,--threads", options.threads, "Threads; the picture does not depend on them")
        ->check(CLI::Range(1u, 1024u));
    CLI::Option* watch =
        command.add_option("--watch", options.watch, "Seconds between writes of an unfinished golden")
            ->check(CLI::Range(0.0, 1e9))
            ->capture_default_str();
    CLI::Option* batches =
        command
            .add_option("--batches", options.batches,
                        "Make a part: batches A to B - 1, as A..B; see plumbline merge")
            ->check(expect_batches);
    CLI::Option* output =
        command.add_option("-o,--output", options.output, "The part, .exr")->needs(batches);
    batches->needs(output)->excludes(all);
    command
        .add_option("--pilot-file", options.pilot_file,
                    "For batches after the pilot: the merged parts of the pilot, .exr")
        ->needs(batches);
    CLI::Option* list = command.add_flag("--list", options.list, "List the goldens, make none");
    list->excludes(watch, batches);
    command
        .add_option("--verify", options.verify,
                    "Render this many batches of each golden again and compare the bits")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31))
        ->excludes(list, watch, batches);
    command.add_flag("-q,--quiet", options.quiet, "No progress and no notices");
}

void check(const GoldenCommand& options)
{
    for (const std::string& scene : options.scenes)
        if (scene == "-")
            throw std::invalid_argument(
                "golden -: expected the name of a scene file, because the golden is "
                "named after it and made again from it");
    expect_whole_batches(options.samples, options.batch_size);
    if (options.samples / options.batch_size <= options.pilot_batches)
        throw std::invalid_argument("-s " + std::to_string(options.samples) + ": the pilot takes " +
                                    std::to_string(options.pilot_batches * options.batch_size) +
                                    " samples and leaves nothing to compare with");
}

} // namespace cli
