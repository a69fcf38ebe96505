#pragma once

// The subcommand `explain`: its options, and the function that adds it (see command.h).

#include "cli/command.h"
#include "cli/render_command.h"

#include <cstdint>
#include <string>

namespace cli {

struct ExplainCommand {
    RenderCommand render; // the picture of which a sample is explained
    std::string pixel;    // "X,Y"; empty: any, with --where or --largest
    std::uint32_t sample = 0;
    std::string where; // a condition (explain/condition.h); empty: none
    bool largest = false;
    std::string picture; // .svg; empty: none
    std::string report;  // .html; empty: none
    bool json = false;
};

/// Adds the options to `command`, which sets `options` when it is parsed.
void add_explain_options(CLI::App& command, ExplainCommand& options);

/// Throws std::invalid_argument for options that exclude each other, and where one is missing.
void check(const ExplainCommand& options, const CLI::App& command);

/// The number of --pixel in a picture of `width` x `height`: y * width + x. Throws
/// std::invalid_argument.
std::uint32_t pixel_of(const ExplainCommand& options, int width, int height);

/// Adds the subcommand to `program`.
void add_explain_command(CLI::App& program, Work& work);

} // namespace cli
