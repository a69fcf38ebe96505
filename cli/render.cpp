// `plumbline render`: a scene file in, pictures out.

#include "cli/command.h"
#include "cli/fast_render.h"
#include "cli/idle_options.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_options.h"
#include "cli/render_report.h"
#include "cli/resources.h"
#include "cuda/transport/renderer.h"
#include "images/exr.h"
#include "images/file_ending.h"
#include "images/png.h"
#include "images/strategy_sheet.h"
#include "images/write_image.h"

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

/// What renders, the reference or the fast path, with its layers of strategies.
class Rendering {
public:
    Rendering(const RenderCommand& options, const scenes::Scene& scene) : options_(options)
    {
        const Size size = parse_size(options.size);
        if (options.device != "ref") {
            fast_ = fast_renderer(options, scene);
            return;
        }
        world_.emplace(scene, size.width, size.height, builder_of(options));
        if (wants_layers(options))
            layers_.emplace(size.width, size.height, options.max_edges, !options.unweighted);
    }

    /// Adds batches to `film` until it holds all, and returns whether it does: see ref::render.
    bool run(images::Film& film, const ref::Monitor& monitor)
    {
        return fast_ ? cli::render(*fast_, options_, film, monitor, fast_layers_)
                     : ref::render(*world_, integrator_of(options_), render_options(options_), film,
                                   monitor, layers_ ? &*layers_ : nullptr);
    }

    /// The layers as they stand; call it between batches.
    [[nodiscard]] images::Strategies strategies() const
    {
        return fast_ ? fast_layers_.means() : layers_->means();
    }

    /// The kernel of the fast path.
    [[nodiscard]] std::optional<gpu::Needs> kernel() const
    {
        return fast_ ? std::optional(fast_->needs()) : std::nullopt;
    }

private:
    const RenderCommand& options_;
    std::optional<ref::World> world_;
    std::optional<ref::StrategyLayers> layers_;
    std::unique_ptr<gpu::Renderer> fast_;
    LayerSums fast_layers_;
};

/// `metadata`, with what is known only of a film: how many samples it holds, and how many contributions
/// it lacks because they are not finite.
images::Metadata describe_film(const RenderCommand& options, const images::Film& film,
                               const images::Dropped& dropped, images::Metadata metadata)
{
    if (dropped.count > 0) metadata["dropped"] = std::to_string(dropped.count);
    const std::uint64_t held = film.batches() * options.batch_size;
    metadata["samples"] = std::to_string(held);
    if (held < options.samples)
        metadata["interrupted"] = "before " + std::to_string(options.samples) + " samples";
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

void write_strategies(const RenderCommand& options, const images::Strategies& pictures,
                      const images::Film& film, images::Metadata metadata)
{
    metadata["strategies"] = options.unweighted ? "unweighted" : "weighted";
    if (!options.strategies.empty()) {
        images::Layers named;
        for (const auto& [strategy, image] : pictures)
            named.emplace(ref::layer_name(strategy.first, strategy.second), image);
        images::write_exr(options.strategies, film, metadata, named, images::FilmState::omit);
    }
    if (!options.strategies_picture.empty())
        images::write_png(options.strategies_picture, images::strategy_sheet(pictures),
                          options.exposure);
}

/// In the order of batches, which is also that of names.
std::string batch_name(std::size_t number)
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
    Rendering rendering(options, scene);
    images::Layers batches; // those that are to be kept
    PictureMean mean;
    const auto write_all = [&](const images::Film& so_far) {
        const images::Metadata described = describe_film(options, so_far, dropped, metadata);
        write_pictures(options, so_far, described, batches);
        if (wants_layers(options)) write_strategies(options, rendering.strategies(), so_far, described);
    };

    catch_interrupts();
    const Clock::time_point start = Clock::now();
    const double cpu_start = cpu_seconds();
    Clock::time_point written = start;
    bool complete = false;
    {
        Progress progress(scene.name, static_cast<double>(batches_before),
                          static_cast<double>(render_options(options).batches), options.quiet);
        ref::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        monitor.batch = [&](const images::Image& batch) {
            mean.add_batch(batch);
            if (options.keep_batches) batches.emplace(batch_name(batches.size()), batch);
        };
        monitor.dropped = [&](const images::Dropped& of_batch) { dropped += of_batch; };
        if (options.watch > 0.0)
            monitor.kept = [&](const images::Film& so_far) {
                if (seconds_since(written) < options.watch) return;
                write_all(so_far);
                written = Clock::now();
            };
        complete = rendering.run(film, monitor);
    }
    const double seconds = seconds_since(start);
    const double cpu = cpu_seconds() - cpu_start;

    const bool anything = film.batches() > 0;
    if (anything) write_all(film);
    const auto samples = static_cast<double>((film.batches() - batches_before) * options.batch_size) *
                         size.width * size.height;
    const RenderRun run{scene, film, mean, dropped, rendering.kernel(), samples, seconds, cpu};
    for (const std::string& warning : warnings(run))
        std::cerr << "plumbline: warning: " << shown_name(options.scene) << ": " << warning << '\n';
    if (options.json) std::cout << render_json(options, run) << std::endl;
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
    command->callback([options, command, &work] {
        work = [options, command] {
            settle_batch_size(*options, command->count("--batch") > 0);
            expect_no_idle_options(*command, *options);
            return render(*options);
        };
    });
}

} // namespace cli
