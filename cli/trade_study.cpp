#include "cli/trade_study.h"

#include "cli/renderer_for.h"
#include "cli/run_self.h"
#include "cli/scene_input.h"
#include "cli/trade_needs.h"
#include "cuda/scene/scene_arrays.h"
#include "images/temporary_folder.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <utility>

namespace cli {

namespace {

/// The peak memory of a process that renders one sample per pixel.
std::optional<double> peak_bytes(const Settings& settings, const TradeView& view)
{
    const images::TemporaryFolder folder;
    const std::string picture = (folder.path() / "picture.pfm").string();
    std::vector<std::string> arguments = arguments_of(settings, view);
    for (const std::string& more : {std::string("-o"), picture, std::string("-s"), std::string("1"),
                                    std::string("-q"), std::string("--json")})
        arguments.push_back(more);
    const auto output = output_of_self(arguments);
    if (!output) return std::nullopt;
    const auto json = nlohmann::json::parse(*output, nullptr, false);
    return json.is_object() && json.contains("peak_rss_bytes")
               ? std::optional<double>(json["peak_rss_bytes"].get<double>())
               : std::nullopt;
}

} // namespace

TradeStudy study_of(TradeCommand options)
{
    scenes::Scene scene = load_scene(options.scene, options.frame, options.quiet);
    Settings base = base_of(options.base);
    if (options.needs)
        for (const std::string& knob : needs_knobs(scene)) options.knobs.push_back(knob);
    TradeView view{options.scene, options.size, options.frame};
    int max_edges = render_of(base, view).max_edges;
    std::optional<NamedTruth> named;
    if (!options.truth.empty()) {
        named = named_truth(options, scene);
        view.size =
            std::to_string(named->golden.mean.width) + "x" + std::to_string(named->golden.mean.height);
        if (named->max_edges < max_edges) base["max-edges"] = std::to_string(named->max_edges);
        max_edges = named->max_edges;
    }
    TradePlan plan = plan_of(base, options.knobs, max_edges);
    for (const Settings& settings : plan.settings) render_of(settings, view);
    if (!named) named = cached_truth(options, scene, max_edges);
    const fast::Needs kernels = fast::compiled_for(fast::scene_arrays(scene, true).needs);
    return {std::move(scene), std::move(view), std::move(plan), std::move(*named), kernels};
}

std::vector<trade::Configuration> configurations_of(const TradeStudy& study)
{
    const auto& [scene, view, plan, named, kernels] = study;
    std::vector<trade::Configuration> configurations;
    for (std::size_t i = 0; i < plan.settings.size(); ++i) {
        RenderCommand render = render_of(plan.settings[i], view);
        render.quiet = true; // notices were printed once, for the scene
        const Settings& settings = plan.settings[i];
        configurations.push_back(
            {plan.names[i], command_line(settings, view),
             [render, &scene = study.scene](std::uint32_t batch_size, std::uint64_t seed) {
                 RenderCommand command = render;
                 command.batch_size = batch_size;
                 command.seed = seed;
                 return renderer_for(command, scene);
             },
             [settings, view = study.view] { return peak_bytes(settings, view); }});
    }
    return configurations;
}

} // namespace cli
