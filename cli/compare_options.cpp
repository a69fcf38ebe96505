// The options of `plumbline compare`.

#include "cli/compare_command.h"

#include <CLI/CLI.hpp>

namespace cli {

void add_compare_options(CLI::App& command, CompareCommand& options)
{
    command
        .add_option("pictures", options.pictures,
                    "One candidate, or several independent ones, then the golden")
        ->required()
        ->expected(2, 1 << 16);
    command
        .add_option("-s,--samples", options.samples,
                    "Samples per pixel of each picture without metadata, or of a scene")
        ->check(CLI::Range(1.0, 1e12));
    command.add_option("--layer", options.layer, "Layer of the .exr files to compare [R, G and B]");
    command.add_option("--scene", options.scene,
                       "The golden's scene, .dae: find mistakes of light transport too");
    command
        .add_option("--integrator", options.integrator,
                    "For a scene: path, bdpt or light [the golden's]")
        ->check(CLI::IsMember({"path", "bdpt", "light"}));
    command.add_option("--device", options.device, "For a scene: ref, or the fast path on host or cuda")
        ->check(CLI::IsMember({"ref", "host", "cuda"}).description(""))
        ->capture_default_str();
    command.add_option("--seed", options.seed, "For a scene [a new one every time]");
    command.add_option("-t,--threads", options.threads, "Threads")->check(CLI::Range(1u, 1024u));
    command.add_option("--report", options.report, "Write a page with pictures: .html");
    command.add_flag("--json", options.json, "Print one JSON object");
    command.add_flag("-q,--quiet", options.quiet, "No progress");
}

} // namespace cli
