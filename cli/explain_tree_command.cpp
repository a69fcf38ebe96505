// `plumbline explain-tree`: one primitive in the radix tree of a scene, step by step.

#include "cli/explain_tree_command.h"

#include "cli/one_of.h"
#include "cli/scene_input.h"
#include "explain/tree_text.h"
#include "ref/trees/bvh.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <limits>
#include <memory>

namespace cli {

namespace {

ExitStatus explain_primitive(const ExplainTreeCommand& options)
{
    const scenes::Scene scene = load_triangles(options.scene, false, options.quiet);
    const auto boxes = ref::primitive_bounds(scene);
    const explain::TreeExplanation told =
        explain::explain_tree(boxes, options.builder == "morton30" ? 10 : 21, options.primitive);
    std::cout << (options.json ? explain::json(told, scene.name) + "\n" : describe(told, scene.name))
              << std::flush;
    return fine;
}

} // namespace

void add_explain_tree_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<ExplainTreeCommand>();
    CLI::App* command = program.add_subcommand(
        "explain-tree", "Explain one primitive in a radix tree: code, searches, way to the root");
    command->add_option("scene", options->scene, "Scene or mesh, as for bvh; -: COLLADA on stdin")
        ->required();
    command
        ->add_option("--primitive", options->primitive,
                     "Number of the primitive, from 0: triangles, then spheres")
        ->check(CLI::Range(0u, std::numeric_limits<std::uint32_t>::max()).description(""))
        ->required();
    command
        ->add_option("--builder", options->builder,
                     "morton30 or morton63: codes of 10 or of 21 bits per axis")
        ->check(one_of({"morton30", "morton63"}))
        ->capture_default_str();
    command->add_flag("--json", options->json, "Print one JSON object");
    command->add_flag("-q,--quiet", options->quiet, "No notices");
    command->footer("Example: plumbline explain-tree docs/scenes/karras_keys.dae --primitive 3");
    command->callback([options, &work] { work = [options] { return explain_primitive(*options); }; });
}

} // namespace cli
