// `plumbline merge`: joins the parts of a render or of a golden.

#include "cli/merge_command.h"

#include "cli/merge_parts.h"
#include "cli/output_files.h"
#include "images/image_error.h"
#include "images/parts.h"
#include "images/write_image.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <stdexcept>

namespace cli {

namespace {

/// Prints what each file holds. A damaged one is a failed check.
ExitStatus check_parts(const MergeCommand& options)
{
    bool sound = true;
    for (const std::string& file : options.parts) try {
            const std::string holds = describe(images::read_part(file).range);
            std::cout << file << ": batches " << holds << '\n';
        } catch (const images::ImageError& error) {
            std::cout << error.what() << '\n';
            sound = false;
        }
    return sound ? fine : check_failed;
}

void check(const MergeCommand& options)
{
    if (options.outputs.empty()) throw std::invalid_argument("merge: -o names the file to write");
    std::vector<NamedFile> outputs;
    std::vector<NamedFile> parts;
    for (const std::string& path : options.outputs) outputs.push_back({"-o", path});
    for (const std::string& path : options.parts) parts.push_back({"a part", path});
    expect_different_files(outputs, parts);
    for (const std::string& path : options.outputs) images::check_writable(path);
}

ExitStatus merge(const MergeCommand& options)
{
    if (options.check) return check_parts(options);
    check(options);
    return merge_parts(options);
}

} // namespace

void add_merge_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<MergeCommand>();
    CLI::App* command =
        program.add_subcommand("merge", "Join parts of a render or a golden, made by --batches");
    command->add_option("parts", options->parts, "Parts, .exr, in any order")->required();
    command->add_option("-o,--output", options->outputs,
                        "The whole: .exr, .pfm or .png; may be repeated");
    command
        ->add_option("-s,--samples", options->samples,
                     "Samples per pixel that the whole must have [those of the parts]")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31).description(""));
    command->add_flag("--finish", options->finish,
                      "Write no state: a finished golden, or layers as of render --strategies");
    command->add_flag("--check", options->check, "Print which batches each part holds, write nothing")
        ->excludes(command->get_option("--output"), command->get_option("--samples"),
                   command->get_option("--finish"));
    command
        ->add_option("--exposure", options->exposure,
                     "For .png: brighten the picture, in stops, -64 to 64")
        ->check(CLI::Range(-64.0, 64.0).description(""))
        ->capture_default_str();
    command->add_flag("-q,--quiet", options->quiet, "No progress");
    command->footer("The result has the bits of a render by one machine. docs/farm.md tells more.\n"
                    "Example: plumbline merge part1.exr part2.exr -o whole.exr -s 1024\n"
                    "Exit status 1: --check found a damaged part.");
    command->callback([options, &work] { work = [options] { return merge(*options); }; });
}

} // namespace cli
