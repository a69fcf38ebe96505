// `plumbline trade`: speed against accuracy on a scene.

#include "cli/trade_command.h"

#include "cli/interrupt.h"
#include "cli/kept_results.h"
#include "cli/machine.h"
#include "cli/progress.h"
#include "cli/trade_needs.h"
#include "cli/trade_study.h"
#include "images/atomic_file.h"
#include "images/exposure.h"
#include "trade/page.h"
#include "trade/results.h"
#include "trade/resume.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <iostream>
#include <memory>
#include <stdexcept>
#include <thread>

namespace cli {

namespace {

/// Earlier measurements, with --resume.
std::vector<trade::Measurements> earlier(const TradeCommand& options,
                                         const trade::Description& description,
                                         const trade::StudyOptions& study,
                                         const std::vector<trade::Configuration>& configurations,
                                         const trade::Truth& truth)
{
    std::vector<trade::Measurements> measured(configurations.size());
    if (options.resume)
        resume_from(options.output, [&](const trade::Json& json) {
            measured = trade::restored(json, description, study, configurations, truth);
        });
    return measured;
}

/// The part of all rounds that is measured.
double part_done(const std::vector<trade::Measurements>& measured, std::size_t rounds)
{
    double done = 0.0;
    for (const trade::Measurements& of_one : measured)
        done +=
            static_cast<double>(of_one.rounds.size()) / static_cast<double>(rounds * measured.size());
    return done;
}

/// Writes the page and prints the results.
void show_study(const trade::Json& found, const TradeCommand& options)
{
    if (!options.report.empty()) images::write_atomically(options.report, trade::page(found));
    std::cout << (options.json ? found.dump() + "\n" : trade::table(found)) << std::flush;
}

ExitStatus trade_command(const TradeCommand& options, const std::string& command)
{
    check(options);
    if (!options.from.empty()) {
        show_from(options.from, [&](const trade::Json& json) {
            if (json.at("format") != trade::results_format)
                throw std::invalid_argument("its format is another one");
            show_study(json, options);
        });
        return fine;
    }
    catch_interrupts();
    const TradeStudy what = study_of(options);
    const trade::Truth truth(what.named.golden);
    const auto configurations = configurations_of(what);
    const trade::StudyOptions study{options.seconds, options.rounds, options.seed,
                                    images::middle_exposure(truth.mean())};
    trade::Description description{PLUMBLINE_VERSION,
                                   command,
                                   today(),
                                   processor_name(),
                                   std::max(1U, std::thread::hardware_concurrency()),
                                   what.scene.name,
                                   what.scene.hash,
                                   what.named.source,
                                   what.named.samples};
    auto measured = earlier(options, description, study, configurations, truth);

    const auto results = [&] {
        trade::Json json =
            trade::results(description, study, configurations, what.plan.knobs, truth, measured);
        json["requirements"] = needs_rows(what.scene, what.kernels, what.plan, measured);
        return json;
    };
    const auto write = [&](const trade::Json& json) {
        if (!options.output.empty()) images::write_atomically(options.output, json.dump(1) + "\n");
    };
    const auto keep = [&] {
        if (!options.output.empty()) write(results());
    };
    {
        Progress progress(what.scene.name, part_done(measured, options.rounds), 1.0, options.quiet);
        const trade::StudyMonitor monitor{[&](double done) { progress.update(done); },
                                          interrupt_requested, keep};
        description.complete = false; // what is kept on the way
        description.complete =
            trade::study(configurations, study, truth, trade::process_clock, monitor, measured);
    }
    const trade::Json found = results();
    write(found);
    show_study(found, options);
    return description.complete ? fine : say_interrupted(options.output);
}

} // namespace

void add_trade_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<TradeCommand>();
    CLI::App* command =
        program.add_subcommand("trade", "Measure speed against accuracy of renders of a scene");
    add_trade_options(*command, *options);
    command->footer([] { // when it is asked for: it looks for a GPU
        return "Knobs:\n" + describe_knobs() +
               "Example: plumbline trade scenes/cornell_glass.dae --report trade.html";
    });
    command->callback([options, command, &work] {
        options->size_given = command->count("--size") > 0;
        const std::string line = command_line(*command);
        work = [options, line] { return trade_command(*options, line); };
    });
}

} // namespace cli
