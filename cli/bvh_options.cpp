// The options of `plumbline bvh`.

#include "cli/bvh_command.h"

#include "cli/builders.h"

#include <CLI/CLI.hpp>

namespace cli {

void add_bvh_options(CLI::App& command, BvhCommand& options)
{
    command
        .add_option("scene", options.scene,
                    "COLLADA, OBJ, PLY, STL or glTF file; -: COLLADA from standard input")
        ->required();
    command.add_option("--builder", options.builder, "morton30, morton63, sah or sah-leaf [all]")
        ->check(CLI::IsMember(builder_names()));
    command.add_option("--picture", options.picture, "Write the picture of --show: .png");
    command
        .add_option("--show", options.show,
                    "boxes; order of the leaves, in 16 colours; visits: boxes entered")
        ->check(CLI::IsMember({"boxes", "order", "visits"}))
        ->capture_default_str();
    command.add_option("--level", options.level, "Depth of the boxes in the picture; 0 is the root")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command.add_option("--tree", options.figure,
                       "Write a figure of the radix tree, for few primitives: .svg");
    command
        .add_option("--size", options.size,
                    "Width x height of the picture and of the grid of camera rays")
        ->capture_default_str();
    command.add_option("--repeats", options.repeats, "Number of builds; the median time is printed")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("--device", options.device,
                    "Time the stages of a build on the fast path: host, cuda")
        ->check(CLI::IsMember({"host", "cuda"}));
    command.add_option("-t,--threads", options.threads, "For --device host")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command.add_flag("--frame", options.frame, "Move the camera back until the whole scene is visible");
    command.add_flag("--json", options.json, "Print one JSON object");
    command.add_flag("-q,--quiet", options.quiet, "No notices");
}

bool measures_builders(const BvhCommand& options)
{
    const bool draws = !options.figure.empty() || !options.picture.empty();
    return options.device.empty() && (!draws || options.json);
}

} // namespace cli
