// `plumbline golden`: reference pictures, batch by batch, with all that is needed to judge by them.

#include "cli/golden.h"
#include "cli/interrupt.h"
#include "cli/output_files.h"
#include "cli/progress.h"
#include "cli/renderer.h"
#include "images/exr.h"
#include "images/image_error.h"
#include "images/whole_number.h"

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

std::uint64_t number_in(const images::Metadata& metadata, const std::string& key)
{
    const std::string text = value_of(metadata, key);
    const auto value = images::whole_number(text);
    if (!value)
        throw std::invalid_argument("the golden's metadata has no number " + key + ", but '" + text +
                                    "'");
    return *value;
}

std::string command_of(const GoldenCommand& options, const std::string& scene)
{
    return "plumbline golden " + fs::path(scene).filename().string() + " --size " + options.size +
           " -s " + std::to_string(options.samples) + " --batch " + std::to_string(options.batch_size) +
           " --pilot " + std::to_string(options.pilot_batches) + " --max-edges " +
           std::to_string(options.max_edges);
}

void check(const GoldenCommand& options)
{
    expect_whole_batches(options.samples, options.batch_size);
    if (options.samples / options.batch_size <= options.pilot_batches)
        throw std::invalid_argument("-s " + std::to_string(options.samples) + ": the pilot takes " +
                                    std::to_string(options.pilot_batches * options.batch_size) +
                                    " samples and leaves nothing to compare with");
}

/// Whether it was finished.
bool make_golden(const GoldenCommand& options, const std::string& file)
{
    const Size size = parse_size(options.size);
    const RenderCommand command = render_of(options, file);
    const scenes::Scene scene = load_scene(file, false, options.quiet);
    images::Metadata metadata = describe(command, scene);
    const fs::path path = golden_file(options, file);
    const std::uint64_t batches = options.samples / options.batch_size;

    std::optional<golden::GoldenMaker> maker;
    if (fs::exists(path)) {
        const images::ExrPicture earlier = images::read_exr(path);
        expect_made_so(options, Ask::all_options, {path, earlier.mean, earlier.metadata, !earlier.film},
                       metadata);
        if (!earlier.film) { // finished
            std::cout << scene.name << ": is there\n";
            return true;
        }
        maker.emplace(golden::GoldenMaker::resume(path));
    } else {
        maker.emplace(size.width, size.height, options.pilot_batches);
    }
    metadata["command"] = command_of(options, file);

    const auto renderer = renderer_for(command, scene);
    const Clock::time_point start = Clock::now();
    Clock::time_point kept = start;
    const auto keep = [&](images::FilmState state) {
        metadata["samples"] = std::to_string(maker->film().batches() * options.batch_size);
        maker->write(path, metadata, state);
    };
    {
        Progress progress(scene.name, static_cast<double>(maker->film().batches()),
                          static_cast<double>(batches), options.quiet);
        const images::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        const auto add = [&](const images::Batch& batch) {
            maker->add_batch(batch.mean);
            if (std::chrono::duration<double>(Clock::now() - kept).count() < options.watch) return;
            keep(images::FilmState::keep);
            kept = Clock::now();
        };
        if (!render_batches(*renderer, maker->film().batches(), batches, monitor, add)) {
            if (maker->film().batches() > 0) keep(images::FilmState::keep);
            return false;
        }
    }
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

RenderCommand render_of(const GoldenCommand& options, const std::string& scene)
{
    RenderCommand command;
    command.scene = scene;
    command.size = options.size;
    command.samples = options.samples;
    command.batch_size = options.batch_size;
    command.threads = options.threads;
    command.integrator = "bdpt";
    command.max_edges = options.max_edges;
    command.seed = golden_seed;
    return command;
}

RenderCommand render_of(const golden::Golden& golden, const std::string& scene)
{
    const images::Metadata& metadata = golden.metadata;
    const auto text = [&](const std::string& key) {
        const auto found = metadata.find(key);
        if (found == metadata.end())
            throw std::invalid_argument("the golden's metadata does not say its " + key);
        return found->second;
    };
    RenderCommand command;
    command.scene = scene;
    command.size = std::to_string(golden.mean.width) + "x" + std::to_string(golden.mean.height);
    command.samples = number_in(metadata, "samples");
    command.batch_size = static_cast<std::uint32_t>(number_in(metadata, "batch_size"));
    command.integrator = text("integrator");
    command.heuristic = text("heuristic");
    command.max_edges = text("max_edges") == "unlimited"
                            ? images::unlimited_edges
                            : static_cast<int>(number_in(metadata, "max_edges"));
    command.no_roulette = text("roulette") == "off";
    command.frame = text("camera") == "framed";
    command.seed = number_in(metadata, "seed");
    return command;
}

fs::path golden_file(const GoldenCommand& options, const std::string& scene)
{
    return fs::path(options.folder) / fs::path(scene).stem().concat(".exr");
}

void add_golden_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<GoldenCommand>();
    CLI::App* command =
        program.add_subcommand("golden", "Make, check and list the pictures that others are judged by");
    command->add_option("scenes", options->scenes, "COLLADA files");
    CLI::Option* all =
        command->add_flag("--all", options->all, "All scenes, .dae, in the folder of scenes");
    command->add_option("--scene-folder", options->scene_folder, "Where the scenes of --all are")
        ->needs(all)
        ->capture_default_str();
    command->add_option("--folder", options->folder, "Where goldens are")->capture_default_str();
    command->add_option("--size", options->size, "Width x height in pixels")->capture_default_str();
    command->add_option("-s,--samples", options->samples, "Samples per pixel, the pilot's included")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31))
        ->capture_default_str();
    command->add_option("--batch", options->batch_size, "Samples per pixel in a batch")
        ->check(CLI::Range(1u, 1u << 20))
        ->capture_default_str();
    command
        ->add_option("--pilot", options->pilot_batches,
                     "Batches that choose weights and regions and are used for nothing else")
        ->check(CLI::Range(std::uint64_t{2}, std::uint64_t{1} << 20))
        ->capture_default_str();
    command->add_option("--max-edges", options->max_edges, "Longest path, the camera's edge counted")
        ->check(CLI::Range(1, 1 << 20))
        ->capture_default_str();
    command->add_option("-t,--threads", options->threads, "Threads; the picture does not depend on them")
        ->check(CLI::Range(1u, 1024u));
    CLI::Option* watch =
        command->add_option("--watch", options->watch, "Seconds between writes of what there is")
            ->check(CLI::Range(0.0, 1e9))
            ->capture_default_str();
    CLI::Option* list = command->add_flag("--list", options->list, "Say what is there, make nothing");
    list->excludes(watch);
    command
        ->add_option("--verify", options->verify,
                     "Render so many batches of each golden again: the same bits?")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 31))
        ->excludes(list, watch);
    command->add_flag("-q,--quiet", options->quiet, "No progress and no notices");
    command->footer("Interrupted, the same command goes on where it stopped.\n"
                    "Example: plumbline golden scenes/cornell_glass.dae -s 10240");
    command->callback([options, command, &work] {
        const auto given = [&](const char* name) { return command->count(name) > 0; };
        options->given = {given("--size"), given("--samples"), given("--batch"), given("--pilot"),
                          given("--max-edges")};
        work = [options] { return golden_command(*options); };
    });
}

} // namespace cli
