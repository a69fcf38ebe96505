// The options of `plumbline bvh`.

#include "cli/bvh_command.h"

#include "cli/builders.h"

namespace cli {

void add_bvh_options(CLI::App& command, BvhCommand& options)
{
    command
        .add_option("scene", options.scene,
                    "COLLADA, OBJ, PLY, STL or glTF file; -: COLLADA from standard input")
        ->required();
    command.add_option("--builder", options.builder, "morton30, morton63, sah or sah-leaf [all]")
        ->check(CLI::IsMember(builder_names()));
    command.add_option("--picture", options.picture, "Draw what --show says: .png");
    command
        .add_option("--show", options.show,
                    "boxes; order (of leaves, in 16 pieces); visits (boxes entered)")
        ->check(CLI::IsMember({"boxes", "order", "visits"}))
        ->capture_default_str();
    command.add_option("--level", options.level, "Which boxes: those at this depth, root 0")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command.add_option("--tree", options.figure, "Draw keys, ranges and splits of few primitives: .svg");
    command.add_option("--size", options.size, "Of the picture, and of the grid of camera rays")
        ->capture_default_str();
    command.add_option("--repeats", options.repeats, "Builds, of which the median time counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command
        .add_option("--device", options.device, "Time the stages of the fast path instead: host, cuda")
        ->check(CLI::IsMember({"host", "cuda"}));
    command.add_option("-t,--threads", options.threads, "For --device host")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command.add_flag("--frame", options.frame, "Move the camera back to where it sees the whole scene");
    command.add_flag("--json", options.json, "Print one JSON object");
    command.add_flag("-q,--quiet", options.quiet, "No notices");
}

bool measures_builders(const BvhCommand& options)
{
    const bool draws = !options.figure.empty() || !options.picture.empty();
    return options.device.empty() && (!draws || options.json);
}

} // namespace cli
