// The options of `plumbline render`, and which of them exclude each other.

#include "cli/render_command.h"

#include "cli/builders.h"
#include "cli/one_of.h"
#include "cli/output_files.h"
#include "cli/reference_options.h"
#include "cli/scene_input.h"
#include "images/whole_number.h"
#include "images/write_image.h"

#include <CLI/CLI.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <stdexcept>

namespace cli {

namespace {

const std::map<std::string, images::Integrator> integrators = {{"path", images::Integrator::path},
                                                               {"bdpt", images::Integrator::bdpt},
                                                               {"light", images::Integrator::light}};
const std::map<std::string, images::Heuristic> heuristics = {{"balance", images::Heuristic::balance},
                                                             {"power", images::Heuristic::power},
                                                             {"uniform", images::Heuristic::uniform}};

constexpr std::uint64_t most_samples_per_pixel = std::uint64_t{1} << 31;

/// Each is a picture in memory and in the file.
constexpr std::uint64_t most_batches_kept = 1024;

/// Of every device; which of them have no effect with which device: idle_options.cpp.
std::vector<std::string> all_builder_names()
{
    std::vector<std::string> names = builder_names("ref");
    for (const std::string& name : builder_names("host")) names.push_back(name);
    return names;
}

/// Needed because CLI11 reads "-1" and numbers above 2^64 - 1 as 2^64 - 1.
std::string expect_seed(const std::string& text)
{
    return images::whole_number(text) ? "" : "expected a whole number from 0 to 2^64 - 1, not " + text;
}

/// The scene, the files to write, and how many samples they hold.
void add_picture_options(CLI::App& command, RenderCommand& options)
{
    command.add_option("scene", options.scene, "COLLADA file; -: standard input")->required();
    command.add_option("-o,--output", options.outputs, "Picture: .exr, .pfm or .png; may be repeated")
        ->required()
        ->option_text("TEXT REQUIRED"); // "..." as well would take a line of its own
    command.add_option("--size", options.size, "Width x height in pixels")->capture_default_str();
    command
        .add_option("-s,--samples", options.samples,
                    "Samples per pixel, those of an earlier render included")
        ->check(CLI::Range(std::uint64_t{1}, most_samples_per_pixel).description(""))
        ->capture_default_str();
    command
        .add_option("--batch", options.batch_size,
                    "Samples in a batch, unit of error and resuming [up to 4, dividing -s]")
        ->check(CLI::Range(1u, 1u << 20).description(""));
    command
        .add_option("--batches", options.batches,
                    "In place of -s: batches A to B - 1 alone, as A..B; see plumbline merge")
        ->check(expect_batches);
}

/// The processor that renders.
void add_device_options(CLI::App& command, RenderCommand& options)
{
    command
        .add_option("-t,--threads", options.threads,
                    "Threads, not for cuda; the picture does not depend on them")
        ->check(CLI::Range(1u, 1024u).description(""))
        ->capture_default_str();
    command
        .add_option("--device", options.device,
                    "ref: the reference; or the fast path in floats, on host or cuda")
        ->check(one_of({"ref", "host", "cuda"}))
        ->capture_default_str();
    command
        .add_option("--instructions", options.instructions,
                    "For host: baseline, avx2, avx512, best: same bits; fastmath: others")
        ->check(one_of({"baseline", "avx2", "avx512", "best", "fastmath"}))
        ->capture_default_str();
    command
        .add_option("--kernels", options.kernels,
                    "For cuda: whole samples, or stages of many; changes no bit")
        ->check(one_of({"samples", "stages"}))
        ->capture_default_str();
    command
        .add_option("--kernel-needs", options.kernel_needs,
                    "Fast path: kernels for scene, specular or all needs; changes no bit")
        ->check(one_of({"scene", "specular", "all"}))
        ->capture_default_str();
    command.add_flag("--deterministic", options.deterministic,
                     "The fast path gives the same bits every time; ref always does");
    command
        .add_option("--builder", options.builder,
                    "morton30, morton63; ref: sah, [sah-leaf]; others: hploc30, [hploc63]")
        ->check(one_of(all_builder_names()))
        ->capture_default_str();
}

/// The camera, the outputs and the messages.
void add_output_options(CLI::App& command, RenderCommand& options)
{
    command
        .add_option("--exposure", options.exposure,
                    "For .png: brighten the picture, in stops, -64 to 64")
        ->check(CLI::Range(-64.0, 64.0).description(""))
        ->capture_default_str();
    command.add_flag("--frame", options.frame, "Move the camera back until the whole scene is visible");
    command.add_flag("--resume", options.resume, "Continue the render in the .exr output, if it exists");
    command
        .add_option("--watch", options.watch, "Seconds between writes of the outputs while rendering")
        ->check(CLI::Range(0.0, 1e9).description(""));
    command.add_option("--strategies", options.strategies, "One layer per strategy (s,t), to this .exr");
    command.add_option("--strategies-picture", options.strategies_picture,
                       "The sheet of all strategies, to this .png");
    command.add_flag("--unweighted", options.unweighted, "Each strategy as if it were the only one");
    command.add_flag("--keep-batches", options.keep_batches,
                     "Keep each batch as a layer of the .exr outputs, for compare");
    command.add_flag("--json", options.json,
                     "Print one JSON object: time, samples, mean and its error, kernel");
    command.add_flag("-q,--quiet", options.quiet, "No progress and no notices");
}

/// Throws unless each file can be written and is no other file of this command.
void check_files(const RenderCommand& options)
{
    expect_ending(options.strategies, "--strategies", ".exr");
    expect_ending(options.strategies_picture, "--strategies-picture", ".png");
    std::vector<NamedFile> files;
    for (const std::string& path : options.outputs) files.push_back({"-o", path});
    files.push_back({"--strategies", options.strategies});
    files.push_back({"--strategies-picture", options.strategies_picture});
    expect_different_files(files, {{"the scene", options.scene}});
    for (const std::string& path : {options.strategies, options.strategies_picture})
        if (!path.empty()) images::check_writable(path);
    for (const std::string& path : options.outputs) images::check_writable(path);
}

} // namespace

void add_estimator_options(CLI::App& command, RenderCommand& options)
{
    command.add_option("--integrator", options.integrator, "path, bdpt (bidirectional) or light")
        ->check(one_of({"path", "bdpt", "light"}))
        ->capture_default_str();
    command
        .add_option("--heuristic", options.heuristic,
                    "Weights of bdpt: balance, power or, for ref, uniform (biased)")
        ->check(one_of({"balance", "power", "uniform"}))
        ->capture_default_str();
    command
        .add_option("--max-edges", options.max_edges,
                    "Longest path, the camera's edge counted [no limit]")
        ->check(CLI::Range(1, 1 << 20).description(""));
    command.add_flag("--no-roulette", options.no_roulette, "No Russian roulette");
    command.add_option("--seed", options.seed, "Seed of the random numbers")
        ->check(expect_seed)
        ->capture_default_str();
}

void add_render_options(CLI::App& command, RenderCommand& options)
{
    // In the order of the help page.
    add_picture_options(command, options);
    add_device_options(command, options);
    add_estimator_options(command, options);
    add_reference_options(command, options);
    add_output_options(command, options);
}

void expect_whole_batches(std::uint64_t samples, std::uint32_t batch_size)
{
    if (samples % batch_size != 0)
        throw std::invalid_argument("-s " + std::to_string(samples) + ": not a multiple of the " +
                                    std::to_string(batch_size) + " samples of a batch (--batch)");
}

std::string expect_batches(const std::string& text)
{
    const auto range = images::parse_range(text);
    return range && range->size() > 0 ? ""
                                      : "expected A..B for batches A to B - 1, with A < B, not " + text;
}

images::BatchRange parse_batches(const std::string& text, std::uint32_t batch_size)
{
    const auto range = images::parse_range(text);
    if (!range || range->end > most_samples_per_pixel / batch_size)
        throw std::invalid_argument("--batches " + text + ": beyond the last batch, " +
                                    std::to_string(most_samples_per_pixel / batch_size - 1));
    return *range;
}

images::BatchRange range_of(const RenderCommand& options)
{
    if (!options.batches.empty()) return parse_batches(options.batches, options.batch_size);
    expect_whole_batches(options.samples, options.batch_size);
    return {0, options.samples / options.batch_size};
}

void settle_batch_size(RenderCommand& options, bool given)
{
    if (given || !options.batches.empty()) return;
    while (options.samples % options.batch_size != 0) --options.batch_size;
}

void check(const RenderCommand& options)
{
    const images::BatchRange range = range_of(options);
    if (options.no_roulette && options.max_edges == images::unlimited_edges)
        throw std::invalid_argument("--no-roulette needs --max-edges: paths would never end");
    if (std::isnan(options.exposure) || std::isnan(options.watch))
        throw std::invalid_argument("--exposure and --watch expect numbers, and got a NaN");
    check_reference_options(options);
    const bool layers = wants_layers(options);
    if (layers && options.max_edges > images::most_edges_of_strategies)
        throw std::invalid_argument("--strategies needs --max-edges of at most " +
                                    std::to_string(images::most_edges_of_strategies) +
                                    ": one picture per strategy");
    if (layers && options.resume)
        throw std::invalid_argument(
            "--strategies cannot be resumed: layers are kept without all their digits");
    if (options.keep_batches && options.resume)
        throw std::invalid_argument(
            "--keep-batches cannot be resumed: layers are kept without all their digits");
    if (options.keep_batches && range.size() > most_batches_kept)
        throw std::invalid_argument("--keep-batches keeps at most " + std::to_string(most_batches_kept) +
                                    " batches: choose a larger --batch");
    check_files(options);
}

bool wants_layers(const RenderCommand& options)
{
    return !options.strategies.empty() || !options.strategies_picture.empty();
}

images::RenderOptions render_options(const RenderCommand& options)
{
    images::RenderOptions plan;
    plan.integrator = integrators.at(options.integrator);
    plan.heuristic = heuristics.at(options.heuristic);
    plan.seed = options.seed;
    plan.max_edges = options.max_edges;
    plan.roulette = !options.no_roulette;
    plan.roulette_from = options.roulette_from;
    plan.families = families_of(options);
    plan.batch_size = options.batch_size;
    plan.deterministic = options.deterministic;
    if (wants_layers(options))
        plan.strategies = options.unweighted ? images::StrategyPictures::unweighted
                                             : images::StrategyPictures::weighted;
    return plan;
}

} // namespace cli
