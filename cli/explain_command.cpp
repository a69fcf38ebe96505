// `plumbline explain`: one sample of a picture, with everything that its value comes from.

#include "cli/explain_command.h"

#include "cli/idle_options.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "explain/drawing.h"
#include "explain/fast_text.h"
#include "explain/json.h"
#include "explain/page.h"
#include "explain/search.h"
#include "explain/text.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace cli {

namespace {

/// The picture of which a sample is explained.
struct Picture {
    const ref::World& world;
    images::RenderOptions plan;
    const explain::FastScene* fast; // null: the reference alone
};

std::string sample_text(const Picture& picture, const explain::Sample& sample, bool as_json)
{
    const ref::World& world = picture.world;
    if (picture.fast == nullptr)
        return as_json ? explain::json(world, sample) + "\n" : explain::describe(world, sample);
    const explain::FastSample fast = picture.fast->sample(sample.integrator, sample.options, sample.id);
    return as_json ? explain::json(world, sample, fast) + "\n" : explain::describe(world, sample, fast);
}

void print(const ExplainCommand& options, const Picture& picture, const ref::SampleId& id,
           const std::string& found)
{
    const explain::Sample sample = explain::explain_sample(picture.world, picture.plan.integrator,
                                                           ref::path_options(picture.plan), id);
    if (!options.picture.empty())
        images::write_atomically(options.picture, explain::drawing(picture.world, sample));
    if (!options.report.empty())
        images::write_atomically(options.report, explain::page(picture.world, sample));
    std::cout << (options.json ? "" : found) << sample_text(picture, sample, options.json) << std::flush;
}

ExitStatus explain_first(const ExplainCommand& options, const Picture& picture)
{
    const auto samples = static_cast<std::uint32_t>(options.render.samples);
    explain::Range range{samples};
    if (!options.pixel.empty())
        range.pixel = pixel_of(options, picture.world.camera.width(), picture.world.camera.height());
    bool stopped = false;
    std::optional<explain::Found> found;
    {
        catch_interrupts();
        Progress progress(picture.world.scene.name, 0.0, samples, options.render.quiet);
        const images::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        found = explain::find_first(picture.world, picture.plan, range,
                                    explain::Condition(options.where), monitor, stopped);
    }
    if (stopped) throw Interrupted();
    if (!found) {
        std::cerr << "plumbline: --where " << options.where << ": none of the " << samples
                  << (samples == 1 ? " sample" : " samples") << " per pixel has such a strategy\n";
        return check_failed;
    }
    print(options, picture, found->id, describe(*found, options.where) + "\n");
    return fine;
}

ExitStatus explain_largest(const ExplainCommand& options, const Picture& picture)
{
    const auto samples = static_cast<std::uint32_t>(options.render.samples);
    bool stopped = false;
    std::optional<explain::Firefly> firefly;
    {
        catch_interrupts();
        Progress progress(picture.world.scene.name, 0.0, samples, options.render.quiet);
        const images::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested,
                                      [](const images::Dropped&) {}};
        firefly = explain::find_firefly(picture.world, picture.plan, samples, options.render.threads,
                                        monitor, stopped);
    }
    if (stopped) throw Interrupted();
    if (!firefly) {
        std::cerr << "plumbline: --largest: the picture is black\n";
        return check_failed;
    }
    print(options, picture, firefly->cause.id, describe(*firefly, picture.world.camera.width()) + "\n");
    return fine;
}

ExitStatus explain_one(const ExplainCommand& options)
{
    const RenderCommand& render = options.render;
    const Size size = parse_size(render.size);
    const images::RenderOptions plan = render_options(render);
    images::check(plan);
    // Before the scene is read.
    if (!options.pixel.empty()) (void)pixel_of(options, size.width, size.height);
    if (!options.where.empty()) (void)explain::Condition(options.where);
    const scenes::Scene scene = load_scene(render.scene, render.frame, render.quiet);
    const ref::World world(scene, size.width, size.height, ref::Builder::sah_leaf);
    std::optional<explain::FastScene> fast;
    if (render.device == "host") fast.emplace(scene, size.width, size.height, plan.roulette);
    const Picture picture{world, plan, fast ? &*fast : nullptr};
    if (fast && !render.quiet && !(options.picture.empty() && options.report.empty()))
        std::cerr << "plumbline: --picture and --report show the sample of the reference\n";
    if (options.largest) return explain_largest(options, picture);
    if (!options.where.empty()) return explain_first(options, picture);
    const std::uint32_t pixel = pixel_of(options, size.width, size.height);
    print(options, picture, {plan.seed, pixel, options.sample}, "");
    return fine;
}

} // namespace

void add_explain_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<ExplainCommand>();
    CLI::App* command =
        program.add_subcommand("explain", "Explain one sample: vertices, strategies, weights");
    add_explain_options(*command, *options);
    command->footer("Example: plumbline explain scenes/cornell_glass.dae --pixel 120,80 --sample 3 "
                    "--integrator bdpt\nThe options of the picture are those of render; "
                    "docs/explain.md says what the numbers mean.");
    command->callback([options, command, &work] {
        work = [options, command] {
            settle_batch_size(options->render, false);
            check(options->render);
            check(*options, *command);
            expect_no_idle_options(*command, options->render);
            return explain_one(*options);
        };
    });
}

} // namespace cli
