// `plumbline check-renderer`: renders the scenes with somebody else's renderer, and judges the pictures.

#include "cli/check_renderer_command.h"

#include "check/renderers/check_renderer.h"
#include "check/renderers/render_picture.h"
#include "check/renderers/renderer_page.h"
#include "check/renderers/renderer_results.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/words_after_dashes.h"
#include "images/atomic_file.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

namespace cli {

namespace {

namespace fs = std::filesystem;

fs::path program_file()
{
    std::error_code ignored;
    return fs::read_symlink("/proc/self/exe", ignored);
}

void print_scenes(const std::vector<check::SuiteScene>& scenes)
{
    for (const check::SuiteScene& scene : scenes) {
        std::cout << scene.name << ':';
        for (const std::string& feature : scene.features) std::cout << ' ' << feature;
        std::cout << '\n';
    }
}

/// A line of progress for each round of a scene.
class RoundProgress {
public:
    explicit RoundProgress(bool quiet) : quiet_(quiet) {}

    void update(const check::SceneCheck& scene, std::uint64_t has, std::uint64_t wanted)
    {
        if (&scene != scene_ || wanted != wanted_) {
            line_.reset(); // ends the line before the next begins
            line_.emplace(scene.scene().name + ", " + std::to_string(wanted) + " pictures",
                          static_cast<double>(has), static_cast<double>(wanted), quiet_);
        }
        scene_ = &scene;
        wanted_ = wanted;
        line_->update(static_cast<double>(has));
    }
    /// A line for each look at a scene's mistakes, of `total` batches.
    void update_mistakes(const check::SceneCheck& scene, double done, double total)
    {
        if (&scene != scene_ || total != look_) {
            line_.reset();
            line_.emplace(scene.scene().name + ", mistakes of light transport", 0.0, total, quiet_);
        }
        scene_ = &scene;
        look_ = total;
        wanted_ = 0;
        line_->update(done);
    }
    void end() { line_.reset(); }

private:
    bool quiet_;
    const check::SceneCheck* scene_ = nullptr;
    std::uint64_t wanted_ = 0;
    double look_ = 0.0;
    std::optional<Progress> line_;
};

/// Throws std::invalid_argument for an unknown placeholder.
void check_placeholders(const std::vector<std::string>& command)
{
    check::words_for(command, {"", 0, 0, 0, 0, "", ""});
}

ExitStatus status_of(const check::RendererCheck& found)
{
    using check::SceneVerdict;
    if (found.stopped) return interrupted;
    if (count(found, SceneVerdict::fail) + count(found, SceneVerdict::no_picture) > 0)
        return check_failed;
    return count(found, SceneVerdict::inconclusive) > 0 ? inconclusive : fine;
}

check::RendererOptions renderer_options(const CheckRendererCommand& options)
{
    check::RendererOptions result;
    result.command = options.command;
    result.ending = "." + options.format;
    result.samples = options.samples;
    result.series = options.seed;
    result.error = options.error / 100.0;
    result.first_pictures = options.pictures;
    result.most_pictures = options.most_pictures;
    result.budget = options.budget;
    result.time_limit = options.timeout;
    result.stop = interrupt_requested;
    result.mistakes = !options.no_mistakes;
    result.threads = std::max(1U, std::thread::hardware_concurrency());
    return result;
}

ExitStatus check_renderer_command(const CheckRendererCommand& options)
{
    check(options);
    const fs::path suite = check::find_suite(options.suite, program_file());
    const auto scenes = check::chosen_scenes(suite, options.scenes, options.without);
    if (options.list) {
        print_scenes(scenes);
        return fine;
    }
    check_placeholders(options.command);
    catch_interrupts();
    check::RendererOptions plan = renderer_options(options);
    RoundProgress progress(options.quiet);
    plan.progress = [&](const auto& scene, auto has, auto wanted) {
        progress.update(scene, has, wanted);
    };
    plan.mistakes_progress = [&](const auto& scene, double done, double total) {
        progress.update_mistakes(scene, done, total);
    };
    std::optional<check::PictureFolder> folder;
    if (options.keep.empty())
        folder.emplace();
    else
        folder.emplace(options.keep, check::Origin{plan.command, plan.samples, plan.series, plan.ending},
                       scenes);
    const check::RendererCheck found = check::check_renderer(scenes, plan, *folder);
    progress.end();
    if (!options.report.empty())
        images::write_atomically(options.report, check::renderer_page(found, plan));
    if (options.json)
        std::cout << check::results_json(found, plan)
                         .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
                  << std::endl;
    else
        std::cout << check::results_table(found) << std::flush;
    if (found.stopped)
        std::cerr << "plumbline: interrupted"
                  << (options.keep.empty() ? "" : ": the same command goes on from here") << '\n';
    return status_of(found);
}

} // namespace

void add_check_renderer_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<CheckRendererCommand>();
    CLI::App* command =
        program.add_subcommand("check-renderer", "Judge another program's renderings of our scenes");
    add_check_renderer_options(*command, *options);
    command->footer(
        "Placeholders of the command after --:\n    {scene} {width} {height} {samples} {seed} "
        "{max_edges} {out}\n"
        "Exit status: 0 all PASS, 1 one FAILs or has no picture, 3 INCONCLUSIVE, 2 bad input.\n"
        "Example: plumbline check-renderer --without glass --report page.html -- \\\n"
        "    ./mine {scene} --spp {samples} --seed {seed} --size {width}x{height} -o {out}");
    command->callback([options, &work] {
        options->command = words_after_dashes();
        work = [options] { return check_renderer_command(*options); };
    });
}

} // namespace cli
