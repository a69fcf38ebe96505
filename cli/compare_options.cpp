// The options of `plumbline compare`.

#include "cli/compare_command.h"

namespace cli {

void add_compare_options(CLI::App& command, CompareCommand& options)
{
    command
        .add_option("pictures", options.pictures,
                    "The candidate, or several independent ones, and the golden")
        ->required()
        ->expected(2, 1 << 16);
    command
        .add_option("-s,--samples", options.samples,
                    "Samples per pixel: of one picture that does not say so, or to render")
        ->check(CLI::Range(1.0, 1e12));
    command.add_option("--layer", options.layer,
                       "Of .exr files: the picture to compare, by name [their R, G and B]");
    command
        .add_option("--integrator", options.integrator,
                    "Of a scene that is rendered here: path, bdpt or light [the golden's]")
        ->check(CLI::IsMember({"path", "bdpt", "light"}));
    command
        .add_option("--device", options.device,
                    "That renders a scene here: ref, or the fast path on host or cuda")
        ->check(CLI::IsMember({"ref", "host", "cuda"}).description(""))
        ->capture_default_str();
    command.add_option("--seed", options.seed,
                       "Of a scene that is rendered here [another one every time]");
    command.add_option("-t,--threads", options.threads, "Threads")->check(CLI::Range(1u, 1024u));
    command.add_option("--report", options.report, "Write a page with pictures: .html");
    command.add_flag("--json", options.json, "Print one JSON object");
    command.add_flag("-q,--quiet", options.quiet, "No progress");
}

} // namespace cli
