// `plumbline trade`: speed against accuracy on a scene.

#include "cli/trade_command.h"

#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/renderer_for.h"
#include "cli/run_self.h"
#include "cli/scene_input.h"
#include "cli/trade_knobs.h"
#include "cli/trade_needs.h"
#include "cli/trade_truth.h"
#include "images/atomic_file.h"
#include "images/exposure.h"
#include "trade/page.h"
#include "trade/results.h"
#include "trade/resume.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <unistd.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <thread>

namespace cli {

namespace {

namespace fs = std::filesystem;

/// "2026-11-27", in local time.
std::string today()
{
    const std::time_t now = std::time(nullptr);
    std::tm broken_down{};
    localtime_r(&now, &broken_down);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%d", &broken_down);
    return text.data();
}

/// As Linux names it: proc(5), cpuinfo.
std::string processor_name()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
    return "unknown processor";
}

/// The peak memory of a process that renders one sample per pixel.
std::optional<double> peak_bytes(const Settings& settings, const TradeView& view)
{
    const fs::path picture =
        fs::temp_directory_path() / ("plumbline-trade-" + std::to_string(getpid()) + ".pfm");
    std::vector<std::string> arguments = arguments_of(settings, view);
    for (const std::string& more : {std::string("-o"), picture.string(), std::string("-s"),
                                    std::string("1"), std::string("-q"), std::string("--json")})
        arguments.push_back(more);
    const auto output = output_of_self(arguments);
    std::error_code ignored;
    fs::remove(picture, ignored);
    if (!output) return std::nullopt;
    const auto json = nlohmann::json::parse(*output, nullptr, false);
    return json.is_object() && json.contains("peak_rss_bytes")
               ? std::optional<double>(json["peak_rss_bytes"].get<double>())
               : std::nullopt;
}

std::vector<trade::Configuration> configurations_of(const TradePlan& plan, const TradeView& view,
                                                    const scenes::Scene& scene)
{
    std::vector<trade::Configuration> configurations;
    for (std::size_t i = 0; i < plan.settings.size(); ++i) {
        RenderCommand render = render_of(plan.settings[i], view);
        render.quiet = true; // notices were printed once, for the scene
        const Settings& settings = plan.settings[i];
        configurations.push_back({plan.names[i], command_line(settings, view),
                                  [render, &scene](std::uint32_t batch_size, std::uint64_t seed) {
                                      RenderCommand command = render;
                                      command.batch_size = batch_size;
                                      command.seed = seed;
                                      return renderer_for(command, scene);
                                  },
                                  [settings, view] { return peak_bytes(settings, view); }});
    }
    return configurations;
}

/// max_edges of a render by these settings.
int max_edges_of(const Settings& settings, const TradeView& view)
{
    return render_of(settings, view).max_edges;
}

trade::Json read_results(const std::string& path)
{
    const auto json = trade::Json::parse(images::read_file(path), nullptr, false);
    if (json.is_discarded()) throw std::invalid_argument(path + ": it is no JSON");
    return json;
}

ExitStatus trade_command(TradeCommand options, const std::string& command)
{
    check(options);
    const scenes::Scene scene = load_scene(options.scene, options.frame, options.quiet);
    TradeView view{options.scene, options.size, options.frame};
    Settings base = base_of(options.base);
    if (options.needs)
        for (const std::string& knob : needs_knobs(scene)) options.knobs.push_back(knob);
    catch_interrupts();

    // Errors of names are found before anything takes long.
    plan_of(base, options.knobs, images::unlimited_edges);
    const int base_edges = max_edges_of(base, view);
    const NamedTruth named =
        options.truth.empty() ? cached_truth(options, scene, base_edges) : named_truth(options, scene);
    view.size = std::to_string(named.golden.mean.width) + "x" + std::to_string(named.golden.mean.height);
    if (named.max_edges < base_edges) base["max-edges"] = std::to_string(named.max_edges);
    const trade::Truth truth(named.golden);

    const TradePlan plan = plan_of(base, options.knobs, named.max_edges);
    const auto configurations = configurations_of(plan, view, scene);
    const trade::StudyOptions study{options.seconds, options.rounds, options.seed,
                                    images::middle_exposure(truth.mean())};
    trade::Description description{PLUMBLINE_VERSION,
                                   command,
                                   today(),
                                   processor_name(),
                                   std::max(1U, std::thread::hardware_concurrency()),
                                   scene.name,
                                   scene.hash,
                                   named.source,
                                   named.samples};
    std::vector<trade::Measurements> measured(configurations.size());
    if (options.resume && fs::exists(options.output)) try {
            measured =
                trade::restored(read_results(options.output), description, study, configurations, truth);
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument("--resume " + options.output + ": " + error.what());
        }

    const auto results = [&] {
        trade::Json json =
            trade::results(description, study, configurations, plan.knobs, truth, measured);
        json["requirements"] = needs_rows(scene, plan, measured);
        return json;
    };
    const auto keep = [&] {
        if (!options.output.empty()) images::write_atomically(options.output, results().dump(1) + "\n");
    };
    {
        Progress progress(scene.name, 0.0, 1.0, options.quiet);
        const trade::StudyMonitor monitor{[&](double done) { progress.update(done); },
                                          interrupt_requested, keep};
        description.complete = false; // what is kept on the way
        description.complete =
            trade::study(configurations, study, truth, trade::process_clock, monitor, measured);
    }
    const trade::Json found = results();
    if (!options.output.empty()) images::write_atomically(options.output, found.dump(1) + "\n");
    if (!options.report.empty()) images::write_atomically(options.report, trade::page(found));
    std::cout << (options.json ? found.dump() + "\n" : trade::table(found)) << std::flush;
    if (description.complete) return fine;
    std::cerr << "plumbline: interrupted: "
              << (options.output.empty() ? "with -o, --resume would go on from here"
                                         : "--resume goes on from here")
              << '\n';
    return interrupted;
}

} // namespace

void add_trade_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<TradeCommand>();
    CLI::App* command =
        program.add_subcommand("trade", "Measure speed against accuracy of renders of a scene");
    add_trade_options(*command, *options);
    command->footer("Knobs:\n" + describe_knobs() +
                    "Example: plumbline trade scenes/cornell_glass.dae --report trade.html");
    command->callback([options, command, &work] {
        options->size_given = command->count("--size") > 0;
        std::string line = "plumbline trade";
        for (const CLI::Option* option : command->get_options()) {
            if (option->count() == 0) continue;
            if (!option->get_positional()) line += " " + option->get_name();
            if (option->get_expected_max() == 0) continue; // a flag
            for (const std::string& result : option->results()) line += " " + result;
        }
        work = [options, line] { return trade_command(*options, line); };
    });
}

} // namespace cli
