#pragma once

// The render that a golden is made of.

#include "cli/golden_command.h"
#include "cli/render_command.h"
#include "golden/golden.h"

#include <cstdint>
#include <filesystem>
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

} // namespace cli
