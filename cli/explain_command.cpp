// `plumbline explain`: one sample of a picture, with everything that its value comes from.

#include "cli/explain_command.h"

#include "cli/idle_options.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "explain/json.h"
#include "explain/text.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>

namespace cli {

namespace {

ExitStatus explain_one(const ExplainCommand& options)
{
    const RenderCommand& render = options.render;
    const Size size = parse_size(render.size);
    check(render);
    const std::uint32_t pixel = pixel_of(options, size.width, size.height);
    const images::RenderOptions plan = render_options(render);
    images::check(plan);
    const scenes::Scene scene = load_scene(render.scene, render.frame, render.quiet);
    const ref::World world(scene, size.width, size.height, ref::Builder::sah_leaf,
                           epsilon_in(scene, render));
    const explain::Sample sample = explain::explain_sample(
        world, plan.integrator, ref::path_options(plan), {plan.seed, pixel, options.sample});
    std::cout << (options.json ? explain::json(world, sample) + "\n" : describe(world, sample))
              << std::flush;
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
            expect_no_idle_options(*command, options->render);
            return explain_one(*options);
        };
    });
}

} // namespace cli
