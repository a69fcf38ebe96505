#pragma once

// The subcommand `render`: its options, and the function that adds it (see command.h).

#include "cli/command.h"
#include "images/batch_range.h"
#include "images/render_options.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace cli {

struct RenderCommand {
    std::string scene;
    std::vector<std::string> outputs;
    std::string size = "240x160";
    std::uint64_t samples = 64;
    std::uint32_t batch_size = 4;
    std::string batches; // "4..8": a part of a render, these batches alone; empty: all of `samples`
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    std::string device = "ref";
    std::string instructions = "best";
    std::string kernels = "samples";
    std::string kernel_needs = "scene";
    std::string integrator = "path";
    std::string builder;       // empty: the default of the device (builders.h)
    std::size_t leaf_size = 8; // of the builder sah-leaf
    std::string heuristic = "balance";
    int max_edges = images::unlimited_edges;
    bool no_roulette = false;
    int roulette_from = images::RenderOptions{}.roulette_from;
    std::vector<std::string> without; // families of strategies
    bool deterministic = false;
    std::uint64_t seed = 0;
    double exposure = 0.0;
    bool frame = false;
    bool resume = false;
    double watch = 0.0; // seconds; 0: write once, at the end
    std::string strategies;
    std::string strategies_picture;
    bool unweighted = false;
    bool keep_batches = false;
    bool json = false;
    bool quiet = false;
};

/// Adds the options to `command`, which sets `options` when it is parsed.
void add_render_options(CLI::App& command, RenderCommand& options);

/// Of these, the integrator with its weights, longest path, roulette and seed.
void add_estimator_options(CLI::App& command, RenderCommand& options);

/// Unless a batch size was `given`: takes the largest one up to the default that divides the samples, so
/// that any number of samples is whole batches.
void settle_batch_size(RenderCommand& options, bool given);

/// Whether a picture of every strategy is to be written.
bool wants_layers(const RenderCommand& options);

/// Throws std::invalid_argument or images::ImageError for options that exclude each other, and for files
/// that cannot be written.
void check(const RenderCommand& options);

/// The batches to render. Throws std::invalid_argument as parse_batches and expect_whole_batches.
images::BatchRange range_of(const RenderCommand& options);

/// For CLI11: what is wrong with the text of --batches, or nothing.
std::string expect_batches(const std::string& text);

/// "4..8" as the range of batches that a part holds. Throws std::invalid_argument for a range that ends
/// beyond the largest number of samples.
images::BatchRange parse_batches(const std::string& text, std::uint32_t batch_size);

/// Throws std::invalid_argument unless `samples` per pixel are whole batches.
void expect_whole_batches(std::uint64_t samples, std::uint32_t batch_size);

/// The options as renderers take them.
images::RenderOptions render_options(const RenderCommand& options);

/// Adds the subcommand to `program`.
void add_render_command(CLI::App& program, Work& work);

} // namespace cli
