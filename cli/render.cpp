// `plumbline render`: a scene file in, pictures out.

#include "cli/command.h"
#include "cli/fast_render.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/resources.h"
#include "cuda/transport/renderer.h"
#include "golden/exr.h"
#include "golden/png.h"
#include "golden/strategy_sheet.h"
#include "golden/write_image.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
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

void write_outputs(const RenderCommand& options, const golden::Film& film, golden::Metadata metadata,
                   const golden::Layers& batches)
{
    const std::uint64_t held = film.batches() * options.batch_size;
    metadata["samples"] = std::to_string(held);
    if (held < options.samples)
        metadata["interrupted"] = "before " + std::to_string(options.samples) + " samples";
    for (const std::string& path : options.outputs)
        if (!batches.empty() && std::filesystem::path(path).extension() == ".exr")
            golden::write_exr(path, film, metadata, batches);
        else
            golden::write_image(path, film, metadata, options.exposure);
}

/// In the order of batches, which is also that of names.
std::string batch_name(std::size_t number)
{
    const std::string digits = std::to_string(number);
    return "batch." + std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits;
}

void write_strategies(const RenderCommand& options, const golden::Strategies& pictures,
                      const golden::Film& film, golden::Metadata metadata)
{
    metadata["samples"] = std::to_string(film.batches() * options.batch_size);
    metadata["strategies"] = options.unweighted ? "unweighted" : "weighted";
    if (!options.strategies.empty()) {
        golden::Layers named;
        for (const auto& [strategy, image] : pictures)
            named.emplace(ref::layer_name(strategy.first, strategy.second), image);
        golden::write_exr(options.strategies, film, metadata, named, golden::FilmState::omit);
    }
    if (!options.strategies_picture.empty())
        golden::write_png(options.strategies_picture, golden::strategy_sheet(pictures),
                          options.exposure);
}

void report(const RenderCommand& options, const scenes::Scene& scene, const golden::Film& film,
            double samples, double seconds, double cpu)
{
    glm::dvec3 mean(0.0);
    for (const auto& pixel : film.mean().pixels) mean += pixel;
    mean /= static_cast<double>(film.mean().pixels.size());
    const nlohmann::ordered_json json = {
        {"scene", scene.name},
        {"device", options.device},
        {"integrator", options.integrator},
        {"width", film.mean().width},
        {"height", film.mean().height},
        {"samples_per_pixel", film.batches() * options.batch_size},
        {"complete", film.batches() * options.batch_size == options.samples},
        {"samples", samples}, // of all pixels together, in this run
        {"seconds", seconds},
        {"cpu_seconds", cpu},
        {"samples_per_second", seconds > 0.0 ? samples / seconds : 0.0},
        {"samples_per_cpu_second", cpu > 0.0 ? samples / cpu : 0.0},
        {"threads", options.threads},
        {"peak_rss_bytes", peak_rss_bytes()},
        {"mean_rgb", {mean.x, mean.y, mean.z}},
        {"outputs", options.outputs}};
    std::cout << json.dump() << std::endl;
}

ExitStatus render(const RenderCommand& options)
{
    const Size size = parse_size(options.size);
    check(options);
    const scenes::Scene scene = load_scene(options.scene, options.frame, options.quiet);
    const golden::Metadata metadata = describe(options, scene);
    golden::Film film = starting_film(options, metadata);
    const std::uint64_t batches_before = film.batches();
    const ref::RenderOptions plan = render_options(options);
    const bool want_layers = !options.strategies.empty() || !options.strategies_picture.empty();
    std::optional<ref::World> world;
    std::optional<ref::StrategyLayers> layers;
    std::unique_ptr<gpu::Renderer> fast;
    LayerSums fast_layers;
    if (options.device == "ref") {
        world.emplace(scene, size.width, size.height, builder_of(options));
        if (want_layers) layers.emplace(size.width, size.height, options.max_edges, !options.unweighted);
    } else {
        fast = fast_renderer(options, scene);
    }

    golden::Layers batches;

    catch_interrupts();
    const Clock::time_point start = Clock::now();
    const double cpu_start = cpu_seconds();
    Clock::time_point written = start;
    bool complete = false;
    {
        Progress progress(scene.name, static_cast<double>(batches_before),
                          static_cast<double>(plan.batches), options.quiet);
        ref::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        if (options.keep_batches)
            monitor.batch = [&](const golden::Image& batch) {
                batches.emplace(batch_name(batches.size()), batch);
            };
        if (options.watch > 0.0)
            monitor.kept = [&](const golden::Film& so_far) {
                if (seconds_since(written) < options.watch) return;
                write_outputs(options, so_far, metadata, batches);
                written = Clock::now();
            };
        complete = fast ? cli::render(*fast, options, film, monitor, fast_layers)
                        : ref::render(*world, integrator_of(options), plan, film, monitor,
                                      layers ? &*layers : nullptr);
    }
    const double seconds = seconds_since(start);
    const double cpu = cpu_seconds() - cpu_start;

    const bool anything = film.batches() > 0;
    if (anything) write_outputs(options, film, metadata, batches);
    if (anything && want_layers)
        write_strategies(options, fast ? fast_layers.means() : layers->means(), film, metadata);
    if (options.json)
        report(options, scene, film,
               static_cast<double>((film.batches() - batches_before) * options.batch_size) * size.width *
                   size.height,
               seconds, cpu);
    if (complete) return fine;
    std::cerr << "plumbline: interrupted: "
              << (anything ? "kept " : "nothing written, no batch was finished: ")
              << film.batches() * options.batch_size << " of " << options.samples
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
    command->callback([options, &work] { work = [options] { return render(*options); }; });
}

} // namespace cli
