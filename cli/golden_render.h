#pragma once

// The render that a golden is made of, and the loop that makes one.

#include "cli/golden_command.h"
#include "cli/render_command.h"
#include "golden/golden.h"
#include "images/renderer.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>

namespace cli {

/// The seed of all goldens. No candidate may use it, as the two would share random numbers.
inline constexpr std::uint64_t golden_seed = 271828182845904523;

/// The render that a golden is made of, and that its metadata describe.
RenderCommand render_of(const GoldenCommand& options, const std::string& scene);

/// The same, read back from a golden's metadata. Throws std::invalid_argument if something is missing.
RenderCommand render_of(const golden::Golden& golden, const std::string& scene);

/// The path of the golden of a scene file.
std::filesystem::path golden_file(const GoldenCommand& options, const std::string& scene);

/// The command that makes the golden, for its metadata.
std::string golden_command_of(const GoldenCommand& options, const std::string& scene);

/// How a golden in the making is followed and kept.
struct Following {
    std::string name; // in the line of progress
    bool quiet = false;
    std::function<void()> keep;                             // writes what is there, with its state
    double watch = std::numeric_limits<double>::infinity(); // seconds between calls of `keep`
};

/// Renders the batches that `maker` lacks, of a golden or of a part of one, up to the number `end`.
/// False if it was interrupted: then what is there was kept. Throws the errors of renderer and maker.
bool fill_golden(golden::GoldenMaker& maker, std::uint64_t end, images::Renderer& renderer,
                 const Following& following);

} // namespace cli
