// `plumbline export`: writes a scene for another renderer.

#include "cli/export_command.h"

#include "cli/output_files.h"
#include "cli/scene_input.h"
#include "images/atomic_file.h"
#include "images/file_ending.h"
#include "scenes/contacts.h"
#include "scenes/export/gltf.h"
#include "scenes/export/mitsuba.h"
#include "scenes/export/pbrt.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace cli {

namespace {

namespace fs = std::filesystem;

using Writer = scenes::exports::Exported (*)(const scenes::Scene&, const scenes::exports::Options&,
                                             const std::string&);

struct Format {
    const char* ending;
    Writer write;
    bool has_integrator;
};

constexpr std::array<Format, 4> formats = {{{".xml", scenes::exports::to_mitsuba, true},
                                            {".pbrt", scenes::exports::to_pbrt, true},
                                            {".gltf", scenes::exports::to_gltf, false},
                                            {".glb", scenes::exports::to_gltf, false}}};

/// The format that the ending of `path` names. Throws std::invalid_argument.
const Format& format_of(const std::string& path)
{
    for (const Format& format : formats)
        if (images::has_ending(path, format.ending)) return format;
    throw std::invalid_argument(
        "-o " + path +
        ": its name must end in .xml (Mitsuba 3), .pbrt (pbrt-v4), .gltf or .glb (glTF 2.0)");
}

void add_export_options(CLI::App& command, ExportCommand& options)
{
    command.add_option("scene", options.scene, "COLLADA file; -: standard input")->required();
    command
        .add_option("-o,--output", options.outputs,
                    "Mitsuba 3: .xml; pbrt-v4: .pbrt; glTF 2.0: .gltf, .glb; may be repeated")
        ->required()
        ->option_text("TEXT REQUIRED");
    command.add_option("--size", options.size, "Width x height in pixels")->capture_default_str();
    command.add_option("-s,--samples", options.samples, "Samples per pixel, for Mitsuba and pbrt")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31).description(""))
        ->capture_default_str();
    command
        .add_option("--max-edges", options.max_edges,
                    "Longest path, the camera's edge counted, for Mitsuba and pbrt [no limit]")
        ->check(CLI::Range(1, 1 << 20).description(""));
    command.add_flag("--frame", options.frame, "Move the camera back until the whole scene is visible");
    command.add_flag("--json", options.json, "Print one JSON object: the files and what is in them");
    command.add_flag("-q,--quiet", options.quiet, "No notices");
}

/// Throws std::invalid_argument for an option that only concerns an integrator, if no output has one.
void expect_integrator(const CLI::App& command, const ExportCommand& options)
{
    if (std::ranges::any_of(options.outputs,
                            [](const std::string& path) { return format_of(path).has_integrator; }))
        return;
    for (const char* option : {"--samples", "--max-edges"})
        if (command.count(option) > 0)
            throw std::invalid_argument(
                std::string(option) + " has no effect without an .xml or .pbrt: glTF has no integrator");
}

struct OutputFile {
    fs::path path;
    std::string bytes;
};

/// Writes all files, in their order. After an error, those that were not there before are gone again.
void write_files(const std::vector<OutputFile>& files)
{
    std::vector<fs::path> added;
    try {
        for (const OutputFile& file : files) {
            const bool there = fs::exists(file.path);
            images::write_atomically(file.path, file.bytes);
            if (!there) added.push_back(file.path);
        }
    } catch (...) {
        std::error_code ignored;
        for (const fs::path& path : added) fs::remove(path, ignored);
        throw;
    }
}

void print_json(const scenes::Scene& scene, const std::vector<OutputFile>& files,
                const std::vector<std::string>& notices)
{
    nlohmann::ordered_json json = {{"scene", scene.name},
                                   {"hash", scene.hash},
                                   {"triangles", scene.triangles.size()},
                                   {"spheres", scene.spheres.size()},
                                   {"files", nlohmann::json::array()},
                                   {"notices", notices}};
    for (const OutputFile& file : files) json["files"].push_back(file.path.string());
    std::cout << json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
}

ExitStatus export_scene(const ExportCommand& options)
{
    const Size size = parse_size(options.size);
    for (const std::string& path : options.outputs) images::check_place(path);
    const scenes::Scene scene = load_scene_as_written(options.scene, options.frame, options.quiet);
    scenes::exports::Options plan{size.width, size.height, {}, options.samples};
    if (options.max_edges > 0) plan.max_edges = options.max_edges;

    std::vector<OutputFile> files;
    std::vector<NamedFile> names;
    std::vector<std::string> notices;
    if (!scenes::contact_notices(scene).empty())
        notices.push_back(shown_name(options.scene) +
                          ": other renderers decide by rounding what touches: their pictures differ");
    for (const std::string& path : options.outputs) {
        const fs::path folder = fs::path(path).parent_path();
        scenes::exports::Exported exported =
            format_of(path).write(scene, plan, fs::path(path).filename().string());
        for (scenes::exports::File& file : exported.files) {
            files.push_back({folder / file.name, std::move(file.bytes)});
            names.push_back({"-o " + path, files.back().path});
        }
        for (const std::string& notice : exported.notices) notices.push_back(path + ": " + notice);
    }
    expect_different_files(names, {{"the scene", options.scene}});
    write_files(files);
    if (!options.quiet)
        for (const std::string& notice : notices) std::cerr << notice << '\n';
    if (options.json) print_json(scene, files, notices);
    return fine;
}

} // namespace

void add_export_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<ExportCommand>();
    CLI::App* command =
        program.add_subcommand("export", "Write a scene file for Mitsuba 3, pbrt-v4 or as glTF");
    add_export_options(*command, *options);
    command->footer("What a format cannot say is an error that names it: docs/export.md.\n"
                    "Example: plumbline export scenes/cornell_glass.dae -o glass.xml --max-edges 6");
    command->callback([options, command, &work] {
        work = [options, command] {
            expect_integrator(*command, *options);
            return export_scene(*options);
        };
    });
}

} // namespace cli
