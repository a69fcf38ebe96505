// `plumbline check-tree`: checks a tree that another program has built.

#include "cli/check_tree_command.h"

#include "check/trees/report.h"
#include "check/trees/tree_files.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace cli {

namespace {

ExitStatus check_tree(const CheckTreeCommand& options)
{
    const check::Primitives primitives = check::read_primitives(options.primitives);
    expect_legal(primitives, options.primitives);
    check::NeutralTree tree = check::read_tree(options.tree);
    if (options.root) tree.root = options.root;
    const check::TreeChecks checks{!options.loose, options.max_depth, options.morton, !options.no_costs};
    const check::TreeReport report = check::check_tree(tree, primitives.boxes, checks);
    std::cout << (options.json ? json(report) + "\n" : describe(report)) << std::flush;
    return report.passes() ? fine : check_failed;
}

} // namespace

void add_check_tree_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<CheckTreeCommand>();
    CLI::App* command =
        program.add_subcommand("check-tree", "Check a tree that another program has built");
    command->add_option("primitives", options->primitives, "Boxes or triangles: .npy, .json")
        ->required();
    command
        ->add_option("tree", options->tree,
                     "Folder with nodes.npy, boxes.npy and primitives.npy; or .json")
        ->required();
    command->add_flag("--loose", options->loose, "Boxes may be larger than necessary");
    command->add_option("--root", options->root, "Number of the root [the node that is nobody's child]");
    command->add_option("--max-depth", options->max_depth,
                        "Most edges from the root to a leaf [no limit]");
    command
        ->add_option("--morton", options->morton,
                     "The leaves must be in the order of these codes: 30, 63 bits")
        ->check(CLI::IsMember({30, 63}).description(""));
    command->add_flag("--no-costs", options->no_costs,
                      "Build no trees of our own to compare SAH costs with");
    command->add_flag("--json", options->json, "Print one JSON object");
    command->footer("Example: plumbline check-tree boxes.npy my_tree/\n"
                    "Exit status 1: a property fails. docs/own-code.md has the formats of the files.");
    command->callback([options, &work] { work = [options] { return check_tree(*options); }; });
}

} // namespace cli
