#include "cli/golden_render.h"

#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_metadata.h"
#include "images/whole_number.h"

#include <chrono>
#include <stdexcept>

namespace cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t number_in(const images::Metadata& metadata, const std::string& key)
{
    const std::string text = value_of(metadata, key);
    const auto value = images::whole_number(text);
    if (!value)
        throw std::invalid_argument("the golden's metadata has no number " + key + ", but '" + text +
                                    "'");
    return *value;
}

} // namespace

RenderCommand render_of(const GoldenCommand& options, const std::string& scene)
{
    RenderCommand command;
    command.scene = scene;
    command.size = options.size;
    command.samples = options.samples;
    command.batch_size = options.batch_size;
    command.threads = options.threads;
    command.integrator = "bdpt";
    command.max_edges = options.max_edges;
    command.seed = golden_seed;
    return command;
}

RenderCommand render_of(const golden::Golden& golden, const std::string& scene)
{
    const images::Metadata& metadata = golden.metadata;
    const auto text = [&](const std::string& key) {
        const auto found = metadata.find(key);
        if (found == metadata.end())
            throw std::invalid_argument("the golden's metadata does not say its " + key);
        return found->second;
    };
    RenderCommand command;
    command.scene = scene;
    command.size = std::to_string(golden.mean.width) + "x" + std::to_string(golden.mean.height);
    command.samples = number_in(metadata, "samples");
    command.batch_size = static_cast<std::uint32_t>(number_in(metadata, "batch_size"));
    command.integrator = text("integrator");
    command.heuristic = text("heuristic");
    command.max_edges = text("max_edges") == "unlimited"
                            ? images::unlimited_edges
                            : static_cast<int>(number_in(metadata, "max_edges"));
    command.no_roulette = text("roulette") == "off";
    command.frame = text("camera") == "framed";
    command.seed = number_in(metadata, "seed");
    return command;
}

std::string golden_command_of(const GoldenCommand& options, const std::string& scene)
{
    return "plumbline golden " + fs::path(scene).filename().string() + " --size " + options.size +
           " -s " + std::to_string(options.samples) + " --batch " + std::to_string(options.batch_size) +
           " --pilot " + std::to_string(options.pilot_batches) + " --max-edges " +
           std::to_string(options.max_edges);
}

bool fill_golden(golden::GoldenMaker& maker, std::uint64_t end, images::Renderer& renderer,
                 const Following& following)
{
    const images::BatchRange there = maker.film().range();
    const auto first = static_cast<double>(there.first);
    Progress progress(following.name, static_cast<double>(there.size()),
                      static_cast<double>(end) - first, following.quiet);
    const images::Monitor monitor{[&](double done) { progress.update(done - first); },
                                  interrupt_requested};
    Clock::time_point kept = Clock::now();
    const auto add = [&](const images::Batch& batch) {
        maker.add_batch(batch.mean);
        if (std::chrono::duration<double>(Clock::now() - kept).count() < following.watch) return;
        following.keep();
        kept = Clock::now();
    };
    if (render_batches(renderer, there.end, end, monitor, add)) return true;
    if (maker.film().batches() > 0) following.keep();
    return false;
}

fs::path golden_file(const GoldenCommand& options, const std::string& scene)
{
    return fs::path(options.folder) / fs::path(scene).stem().concat(".exr");
}

} // namespace cli
