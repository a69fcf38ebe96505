// `plumbline golden`: makes reference pictures, batch by batch, with the data that comparisons need.

#include "cli/golden_command.h"

#include "cli/golden_check.h"
#include "cli/golden_mismatch.h"
#include "cli/golden_part.h"
#include "cli/golden_render.h"
#include "cli/interrupt.h"
#include "cli/output_files.h"
#include "cli/render_metadata.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "images/exr.h"
#include "images/image_error.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

namespace cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

/// Makes or continues one golden. False if it was interrupted.
bool make_golden(const GoldenCommand& options, const std::string& file)
{
    const Size size = parse_size(options.size);
    const RenderCommand command = render_of(options, file);
    const scenes::Scene scene = load_scene(file, false, options.quiet);
    images::Metadata metadata = describe(command, scene);
    const fs::path path = golden_file(options, file);

    std::optional<golden::GoldenMaker> maker;
    if (fs::exists(path)) {
        const images::ExrPicture earlier = images::read_exr(path);
        images::expect_sound_state(path, earlier);
        const bool finished = !earlier.has_state;
        expect_made_so(options, Ask::all_options, {path, earlier.mean, earlier.metadata, finished},
                       metadata);
        if (finished) {
            std::cout << scene.name << ": is there\n";
            return true;
        }
        maker.emplace(golden::GoldenMaker::resume(path));
        if (maker->film().range().first > 0)
            throw images::ImageError(path, "a part of a golden: plumbline merge joins parts");
    } else {
        maker.emplace(size.width, size.height, options.pilot_batches);
    }
    metadata["command"] = golden_command_of(options, file);

    const auto renderer = renderer_for(command, scene);
    const Clock::time_point start = Clock::now();
    const auto keep = [&](images::FilmState state) {
        metadata["samples"] = std::to_string(maker->film().batches() * options.batch_size);
        maker->write(path, metadata, state);
    };
    if (!fill_golden(*maker, options.samples / options.batch_size, *renderer,
                     {scene.name, options.quiet, [&] { keep(images::FilmState::keep); }, options.watch}))
        return false;
    keep(images::FilmState::omit);
    std::printf("%s: %llu samples per pixel, %.0f s, %.2f MiB\n", scene.name.c_str(),
                static_cast<unsigned long long>(options.samples),
                std::chrono::duration<double>(Clock::now() - start).count(),
                static_cast<double>(fs::file_size(path)) / (1 << 20));
    std::fflush(stdout);
    return true;
}

std::vector<std::string> scenes_in(const std::string& folder)
{
    const std::string where = "--all: " + fs::absolute(folder).lexically_normal().string();
    const std::string otherwise = ": name the folder of the scenes by --scene-folder";
    if (!fs::is_directory(folder)) throw std::invalid_argument(where + " is no folder" + otherwise);
    std::vector<std::string> scenes;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".dae") scenes.push_back(entry.path().string());
    if (scenes.empty()) throw std::invalid_argument(where + " holds no .dae" + otherwise);
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

ExitStatus golden_command(GoldenCommand options)
{
    if (options.all == !options.scenes.empty())
        throw std::invalid_argument("name scenes, or say --all for those in --scene-folder");
    if (options.all) options.scenes = scenes_in(options.scene_folder);
    catch_interrupts();
    if (options.list) return list_goldens(options);
    if (options.verify > 0) return verify_goldens(options);
    check(options);
    if (!options.batches.empty()) return make_golden_part(options);
    std::vector<NamedFile> goldens;
    for (const std::string& scene : options.scenes)
        goldens.push_back({"the golden of " + scene + ",", golden_file(options, scene)});
    expect_different_files(goldens);
    fs::create_directories(options.folder);
    for (const std::string& scene : options.scenes)
        if (!make_golden(options, scene)) {
            std::cerr << "plumbline: interrupted: the same command goes on from here\n";
            return interrupted;
        }
    return fine;
}

} // namespace

void add_golden_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<GoldenCommand>();
    CLI::App* command = program.add_subcommand(
        "golden", "Make, check and list goldens, the reference pictures of compare");
    add_golden_options(*command, *options);
    command->footer("After an interruption, the same command continues where it stopped.\n"
                    "Example: plumbline golden scenes/cornell_glass.dae -s 10240");
    command->callback([options, command, &work] {
        const auto given = [&](const char* name) { return command->count(name) > 0; };
        options->given = {given("--size"), given("--samples"), given("--batch"), given("--pilot"),
                          given("--max-edges")};
        work = [options] { return golden_command(*options); };
    });
}

} // namespace cli
