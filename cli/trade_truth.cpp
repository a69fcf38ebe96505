#include "cli/trade_truth.h"

#include "cli/golden_render.h"
#include "cli/interrupt.h"
#include "cli/render_metadata.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "images/atomic_file.h"
#include "images/whole_number.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

namespace cli {

namespace fs = std::filesystem;

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t pilot_batches = 32;
constexpr std::uint64_t all_batches = 256; // as the goldens of this project

double seconds_between(Clock::time_point start, Clock::time_point end)
{
    return std::chrono::duration<double>(end - start).count();
}

RenderCommand render_of_truth(const TradeCommand& options, int max_edges)
{
    RenderCommand render;
    render.scene = options.scene;
    render.size = options.size;
    render.frame = options.frame;
    render.integrator = "bdpt";
    render.max_edges = max_edges;
    render.seed = golden_seed;
    render.quiet = options.quiet;
    return render;
}

/// The name says all that the truth depends on, but for the version of the program.
fs::path file_of_truth(const TradeCommand& options, const scenes::Scene& scene, int max_edges)
{
    const std::string edges =
        max_edges == images::unlimited_edges ? "unlimited" : std::to_string(max_edges);
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), "%g", options.truth_seconds);
    return fs::path(cache_folder(options)) /
           (scene.name + "-" + scene.hash.substr(0, 16) + "-" + options.size +
            (options.frame ? "-framed" : "") + "-" + edges + "-" + seconds.data() + "s.exr");
}

/// So many samples per pixel in a batch that all batches take about the time that was asked for.
std::uint32_t batch_size_for(RenderCommand render, const scenes::Scene& scene, double seconds)
{
    render.batch_size = 1;
    const auto renderer = renderer_for(render, scene);
    const images::Monitor monitor{{}, interrupt_requested};
    std::uint64_t batches = 0;
    const Clock::time_point start = Clock::now();
    double passed = 0.0;
    do {
        if (!renderer->render_batch(batches++, monitor)) throw Interrupted();
        passed = seconds_between(start, Clock::now());
    } while (passed < 0.01 * seconds);
    const double samples = seconds * static_cast<double>(batches) / passed;
    return static_cast<std::uint32_t>(std::clamp(samples / all_batches, 1.0, double{1U << 20}));
}

NamedTruth in_words(golden::Golden golden, const std::string& source)
{
    const auto samples = images::whole_number(value_of(golden.metadata, "samples"));
    const std::string edges = value_of(golden.metadata, "max_edges");
    const auto most = images::whole_number(edges);
    if (!samples || (!most && edges != "unlimited"))
        throw std::invalid_argument(source + ": its metadata do not tell its samples and max_edges");
    return {std::move(golden), source, static_cast<double>(*samples),
            most ? static_cast<int>(*most) : images::unlimited_edges};
}

} // namespace

std::string cache_folder(const TradeCommand& options)
{
    if (!options.cache.empty()) return options.cache;
    if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder != nullptr && *folder != '\0')
        return (fs::path(folder) / "plumbline").string();
    if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
        return (fs::path(home) / ".cache" / "plumbline").string();
    throw std::invalid_argument("no folder to keep the truth in: name one by --cache");
}

NamedTruth named_truth(const TradeCommand& options, const scenes::Scene& scene)
{
    NamedTruth truth = in_words(golden::read_golden(options.truth), options.truth);
    const auto expect = [&](const std::string& what, const std::string& found,
                            const std::string& expected) {
        if (found != expected)
            throw std::invalid_argument("--truth " + options.truth + ": its " + what + " is " + found +
                                        ", and not " + expected);
    };
    const images::Metadata& metadata = truth.golden.metadata;
    expect("scene_hash", value_of(metadata, "scene_hash"), scene.hash);
    expect("camera", value_of(metadata, "camera"), options.frame ? "framed" : "of the scene");
    if (options.size_given)
        expect("size",
               std::to_string(truth.golden.mean.width) + "x" + std::to_string(truth.golden.mean.height),
               options.size);
    return truth;
}

NamedTruth cached_truth(const TradeCommand& options, const scenes::Scene& scene, int max_edges)
{
    RenderCommand render = render_of_truth(options, max_edges);
    const Size size = parse_size(options.size);
    const fs::path path = file_of_truth(options, scene, max_edges);
    std::error_code ignored; // a folder that cannot be made is an error of the write
    fs::create_directories(path.parent_path(), ignored);
    images::check_place(path); // before it is rendered

    golden::GoldenMaker maker(size.width, size.height, pilot_batches);
    if (fs::exists(path)) {
        const images::ExrPicture earlier = images::read_exr(path);
        const std::string version = value_of(earlier.metadata, "version");
        const auto batch_size = images::whole_number(value_of(earlier.metadata, "batch_size"));
        if (version == PLUMBLINE_VERSION && batch_size) {
            images::expect_sound_state(path, earlier);
            if (!earlier.film) return in_words(golden::read_golden(path), path.string());
            maker = golden::GoldenMaker::resume(path);
            render.batch_size = static_cast<std::uint32_t>(*batch_size);
        }
    }
    if (maker.film().batches() == 0)
        render.batch_size = batch_size_for(render, scene, options.truth_seconds);

    images::Metadata metadata = describe(render, scene);
    const auto keep = [&](images::FilmState state) {
        metadata["samples"] = std::to_string(maker.film().batches() * render.batch_size);
        maker.write(path, metadata, state);
    };
    const auto renderer = renderer_for(render, scene);
    if (!fill_golden(maker, all_batches, *renderer,
                     {"truth of " + scene.name, options.quiet, [&] { keep(images::FilmState::keep); }}))
        throw Interrupted();
    keep(images::FilmState::omit);
    return in_words(golden::read_golden(path), path.string());
}

} // namespace cli
