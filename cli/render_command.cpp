// `plumbline render`: renders a scene file.

#include "cli/render_command.h"

#include "cli/idle_options.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_metadata.h"
#include "cli/render_report.h"
#include "cli/render_resume.h"
#include "cli/renderer_for.h"
#include "cli/resources.h"
#include "cli/scene_input.h"
#include "images/exr.h"
#include "images/file_ending.h"
#include "images/png.h"
#include "images/strategy_sheet.h"
#include "images/write_image.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>

namespace cli {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

/// `metadata` with the entries of a film: the number of its samples, and that of the contributions that
/// were left out because they are not finite.
images::Metadata describe_film(const RenderCommand& options, const images::Film& film,
                               const images::Dropped& dropped, images::Metadata metadata)
{
    if (dropped.count > 0) metadata["dropped"] = std::to_string(dropped.count);
    metadata["samples"] = std::to_string(film.batches() * options.batch_size);
    if (film.range().end < range_of(options).end)
        metadata["interrupted"] = options.batches.empty()
                                      ? "before " + std::to_string(options.samples) + " samples"
                                      : "before the end of batches " + options.batches;
    return metadata;
}

void write_pictures(const RenderCommand& options, const images::Film& film,
                    const images::Metadata& metadata, const images::Layers& batches)
{
    for (const std::string& path : options.outputs)
        if (!batches.empty() && images::has_ending(path, ".exr"))
            images::write_exr(path, film, metadata, batches);
        else
            images::write_image(path, film, metadata, options.exposure);
}

/// A part keeps its state, from which plumbline merge makes the pictures of the whole.
void write_strategies(const RenderCommand& options, const images::StrategySums& sums,
                      const images::Film& film, images::Metadata metadata)
{
    const images::Strategies pictures = sums.means(options.batch_size);
    metadata["strategies"] = options.unweighted ? "unweighted" : "weighted";
    if (!options.strategies.empty()) {
        if (options.batches.empty())
            images::write_exr(options.strategies, film, metadata, images::layers_of(pictures),
                              images::FilmState::omit);
        else
            images::write_exr(options.strategies, film, metadata, images::layers_of(pictures),
                              images::FilmState::keep, {}, sums);
    }
    if (!options.strategies_picture.empty())
        images::write_png(options.strategies_picture, images::strategy_sheet(pictures),
                          options.exposure);
}

/// Names in ascending order are the batches in theirs.
std::string batch_name(std::uint64_t number)
{
    const std::string digits = std::to_string(number);
    return "batch." + std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits;
}

ExitStatus render(const RenderCommand& options)
{
    const Size size = parse_size(options.size);
    check(options);
    const scenes::Scene scene = load_scene(options.scene, options.frame, options.quiet);
    const images::Metadata metadata = describe(options, scene);
    images::Dropped dropped;
    images::Film film = starting_film(options, metadata, dropped);
    const std::uint64_t batches_before = film.batches();
    const images::BatchRange range = range_of(options);
    const Clock::time_point build_start = Clock::now();
    const double build_cpu_start = cpu_seconds();
    const auto renderer = renderer_for(options, scene);
    const double build_seconds = seconds_since(build_start);
    const double build_cpu = cpu_seconds() - build_cpu_start;
    images::StrategySums strategies(range.first);
    images::Layers batches; // those that are to be kept
    PictureMean mean;
    const auto write_all = [&](const images::Film& so_far) {
        const images::Metadata described = describe_film(options, so_far, dropped, metadata);
        write_pictures(options, so_far, described, batches);
        if (wants_layers(options)) write_strategies(options, strategies, so_far, described);
    };

    catch_interrupts();
    const Clock::time_point start = Clock::now();
    const double cpu_start = cpu_seconds();
    Clock::time_point written = start;
    bool complete = false;
    {
        Progress progress(scene.name, static_cast<double>(batches_before),
                          static_cast<double>(range.size()), options.quiet);
        const auto show = [&](double done) { progress.update(done - static_cast<double>(range.first)); };
        const images::Monitor monitor{show, interrupt_requested,
                                      [&](const images::Dropped& of_batch) { dropped += of_batch; }};
        const auto added = [&](const images::Batch& batch) {
            mean.add_batch(batch.mean);
            strategies.add(batch.strategies);
            if (options.keep_batches) batches.emplace(batch_name(film.range().end - 1), batch.mean);
            if (options.watch > 0.0 && seconds_since(written) >= options.watch) {
                write_all(film);
                written = Clock::now();
            }
        };
        complete = images::fill(film, range.end, *renderer, monitor, added);
    }
    const double seconds = seconds_since(start);
    const double cpu = cpu_seconds() - cpu_start;

    const bool anything = film.batches() > 0;
    if (anything) write_all(film);
    const auto samples = static_cast<double>((film.batches() - batches_before) * options.batch_size) *
                         size.width * size.height;
    const RenderRun run{.scene = scene,
                        .film = film,
                        .mean = mean,
                        .dropped = dropped,
                        .kernel = kernel_of(*renderer),
                        .builder = builder_of(options, *renderer),
                        .samples = samples,
                        .seconds = seconds,
                        .cpu_seconds = cpu,
                        .build_seconds = build_seconds,
                        .build_cpu_seconds = build_cpu};
    for (const std::string& warning : warnings(run))
        std::cerr << "plumbline: warning: " << shown_name(options.scene) << ": " << warning << '\n';
    if (options.json) std::cout << render_json(options, run) << std::endl;
    if (complete) return fine;
    std::cerr << "plumbline: interrupted: "
              << (anything ? "kept " : "nothing written, no batch was finished: ")
              << film.batches() * options.batch_size << " of " << range.size() * options.batch_size
              << " samples per pixel\n";
    return interrupted;
}

} // namespace

void add_render_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<RenderCommand>();
    CLI::App* command = program.add_subcommand("render", "Render a scene file");
    add_render_options(*command, *options);
    command->footer(
        "Example: plumbline render scenes/cornell_glass.dae -o glass.exr -o glass.png -s 256");
    command->callback([options, command, &work] {
        work = [options, command] {
            if (command->count("--samples") > 0 && command->count("--batches") > 0)
                throw std::invalid_argument("--batches takes the place of --samples: name one of them");
            settle_batch_size(*options, command->count("--batch") > 0);
            expect_no_idle_options(*command, *options);
            return render(*options);
        };
    });
}

} // namespace cli
