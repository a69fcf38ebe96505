// `plumbline extremes`: how far each algorithm and number format can go.

#include "cli/extremes_command.h"

#include "cli/interrupt.h"
#include "cli/kept_results.h"
#include "cli/machine.h"
#include "cli/progress.h"
#include "extremes/page.h"
#include "extremes/results.h"
#include "extremes/walk.h"
#include "extremes/wing.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <thread>

namespace cli {

namespace {

using extremes::Axis;
using extremes::WalkedAxis;

/// The methods of all axes that `names` lists; all if it lists none.
std::vector<WalkedAxis::Of> chosen_methods(const Axis& axis, const std::vector<std::string>& names)
{
    std::vector<WalkedAxis::Of> chosen;
    for (const extremes::Method& method : axis.methods)
        if (names.empty() || std::ranges::find(names, method.name) != names.end())
            chosen.push_back({method, {}});
    return chosen;
}

/// The axes and methods that the options name. Throws std::invalid_argument for a name that does not
/// exist.
std::vector<WalkedAxis> chosen_axes(const ExtremesCommand& options)
{
    const std::vector<Axis> all = extremes::all_axes();
    const auto is_named = [](const Axis& axis, const std::string& name) {
        return axis.name == name || std::to_string(axis.number) == name;
    };
    for (const std::string& name : options.axes)
        if (std::ranges::none_of(all, [&](const Axis& axis) { return is_named(axis, name); }))
            throw std::invalid_argument(name + ": no such axis (--list lists them)");
    for (const std::string& name : options.methods)
        if (std::ranges::none_of(all, [&](const Axis& axis) {
                return std::ranges::find(axis.methods, name, &extremes::Method::name) !=
                       axis.methods.end();
            })) {
            const std::string why = extremes::why_no_device(name);
            throw std::invalid_argument(name + ": no such method (" +
                                        (why.empty() ? "--list lists them" : why) + ")");
        }
    std::vector<WalkedAxis> chosen;
    for (const Axis& axis : all) {
        const bool wanted =
            options.axes.empty() || std::ranges::any_of(options.axes, [&](const std::string& name) {
                return is_named(axis, name);
            });
        if (!wanted) continue;
        chosen.push_back({axis, chosen_methods(axis, options.methods)});
        if (chosen.back().methods.empty()) chosen.pop_back();
    }
    if (chosen.empty())
        throw std::invalid_argument("none of these axes has one of these methods (--list lists them)");
    return chosen;
}

void print_list(const std::vector<WalkedAxis>& axes)
{
    for (const WalkedAxis& of : axes) {
        std::cout << of.axis.number << ' ' << of.axis.name << ": " << of.axis.title << " ("
                  << of.axis.parameter << ")\n    ";
        for (std::size_t i = 0; i < of.methods.size(); ++i)
            std::cout << (i > 0 ? ", " : "") << of.methods[i].method.name;
        std::cout << '\n';
    }
}

/// Points that are missing: methods of an axis at a parameter. Several only if they share exact answers.
struct Missing {
    WalkedAxis* axis;
    std::vector<WalkedAxis::Of*> of;
    double parameter;
};

std::vector<Missing> missing_points(std::vector<WalkedAxis>& walked)
{
    std::vector<Missing> missing;
    const auto is_missing = [](const WalkedAxis::Of& of, double parameter) {
        return std::ranges::find(of.points, parameter, &extremes::Point::parameter) == of.points.end();
    };
    for (WalkedAxis& axis : walked) {
        if (axis.axis.shared_truth)
            for (const double parameter : axis.axis.values) {
                Missing together{&axis, {}, parameter};
                for (WalkedAxis::Of& of : axis.methods)
                    if (is_missing(of, parameter)) together.of.push_back(&of);
                if (!together.of.empty()) missing.push_back(together);
            }
        else
            for (WalkedAxis::Of& of : axis.methods)
                for (const double parameter : axis.axis.values)
                    if (is_missing(of, parameter)) missing.push_back({&axis, {&of}, parameter});
    }
    return missing;
}

std::size_t all_points(const std::vector<WalkedAxis>& walked)
{
    std::size_t count = 0;
    for (const WalkedAxis& axis : walked) count += axis.methods.size() * axis.axis.values.size();
    return count;
}

/// Writes the page and prints the results.
void show_walk(const extremes::Json& found, const ExtremesCommand& options)
{
    if (!options.report.empty()) images::write_atomically(options.report, extremes::page(found));
    std::cout << (options.json       ? found.dump() + "\n"
                  : options.markdown ? extremes::markdown(found)
                                     : extremes::table(found))
              << std::flush;
}

/// The exit status, after the limits that do not hold are named on stderr.
ExitStatus judge_walk(const std::vector<WalkedAxis>& walked)
{
    const std::vector<std::string> wrong = extremes::contradictions(walked);
    for (const std::string& line : wrong)
        std::cerr << "plumbline: a limit does not hold: " << line << '\n';
    return wrong.empty() ? fine : check_failed;
}

/// Shows earlier results, of those of the chosen axes that they have. Seed and number of cases are those
/// of the first file, and must be the same in the others. Axes may be measured by different versions of
/// the program: all are named.
ExitStatus show_earlier_walk(const ExtremesCommand& options, std::vector<WalkedAxis> walked)
{
    std::optional<extremes::Description> description;
    for (const std::string& file : options.from)
        show_from(file, [&](const extremes::Json& json) {
            const extremes::Description own = extremes::description_of(json);
            if (!description) description = own;
            extremes::Description expected = *description;
            expected.program = own.program; // of another version, too
            extremes::restore(json, expected, walked, true);
            if (description->program.find(own.program) == std::string::npos)
                description->program += ", " + own.program;
        });
    for (WalkedAxis& axis : walked)
        std::erase_if(axis.methods, [](const WalkedAxis::Of& of) { return of.points.empty(); });
    std::erase_if(walked, [](const WalkedAxis& axis) { return axis.methods.empty(); });
    if (walked.empty())
        throw std::invalid_argument("--from " + options.from.front() +
                                    ": it has no point of these axes and methods");
    show_walk(extremes::results(*description, walked), options);
    return judge_walk(walked);
}

ExitStatus extremes_command(const ExtremesCommand& options, const std::string& command)
{
    check(options);
    std::vector<WalkedAxis> walked = chosen_axes(options);
    if (options.list) {
        print_list(walked);
        return fine;
    }
    if (!options.from.empty()) return show_earlier_walk(options, walked);
    catch_interrupts();
    extremes::Description description{PLUMBLINE_VERSION, command,      today(), processor_name(),
                                      options.cases,     options.seed, false};
    if (options.resume)
        resume_from(options.output,
                    [&](const extremes::Json& json) { extremes::restore(json, description, walked); });

    extremes::WalkOptions walk;
    walk.cases = options.cases;
    walk.seed = options.seed;
    walk.threads =
        options.threads > 0 ? options.threads : std::max(1U, std::thread::hardware_concurrency());
    walk.stop = interrupt_requested;
    const auto keep = [&] {
        if (!options.output.empty())
            images::write_atomically(options.output,
                                     extremes::results(description, walked).dump(1) + "\n");
    };
    const std::vector<Missing> missing = missing_points(walked);
    const std::size_t total = all_points(walked);
    std::size_t done = total;
    for (const Missing& points : missing) done -= points.of.size();
    bool stopped = false;
    {
        Progress progress("extremes", static_cast<double>(done), static_cast<double>(total),
                          options.quiet);
        auto kept = std::chrono::steady_clock::now();
        for (const Missing& at : missing) {
            std::vector<const extremes::Method*> methods;
            for (const WalkedAxis::Of* of : at.of) methods.push_back(&of->method);
            const auto tallies = extremes::visit(at.axis->axis, methods, at.parameter, walk);
            stopped = !tallies;
            if (stopped) break;
            for (std::size_t i = 0; i < methods.size(); ++i) {
                auto& points = at.of[i]->points;
                points.push_back(extremes::point_of(at.parameter, (*tallies)[i]));
                std::ranges::sort(points, {}, &extremes::Point::parameter);
            }
            done += methods.size();
            progress.update(static_cast<double>(done));
            if (std::chrono::steady_clock::now() - kept < std::chrono::seconds(10)) continue;
            keep(); // for a power cut
            kept = std::chrono::steady_clock::now();
        }
    }
    description.complete = !stopped;
    keep();
    show_walk(extremes::results(description, walked), options);
    return stopped ? say_interrupted(options.output) : judge_walk(walked);
}

} // namespace

void add_extremes_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<ExtremesCommand>();
    CLI::App* command =
        program.add_subcommand("extremes", "Walk to where each algorithm and number format breaks");
    add_extremes_options(*command, *options);
    command->footer("Example: plumbline extremes distance gap --report extremes.html\n"
                    "Exit status 1: a stated limit does not hold.");
    command->callback([options, command, &work] {
        work = [options, line = command_line(*command)] { return extremes_command(*options, line); };
    });
}

} // namespace cli
