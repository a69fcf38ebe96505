#include "cli/trade_settings.h"

#include "check/shell_line.h"
#include "cli/idle_options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <stdexcept>

namespace cli {

std::vector<std::string> arguments_of(const Settings& settings, const TradeView& view)
{
    std::vector<std::string> arguments = {"render", view.scene, "--size", view.size};
    if (view.frame) arguments.emplace_back("--frame");
    for (const auto& [option, value] : settings) {
        arguments.push_back("--" + option);
        if (!value.empty()) arguments.push_back(value);
    }
    return arguments;
}

std::string command_line(const Settings& settings, const TradeView& view)
{
    std::string line = "plumbline";
    for (const std::string& argument : arguments_of(settings, view)) {
        line += " " + check::shell_word(argument);
        if (argument == view.scene) line += " -o picture.exr";
    }
    return line;
}

RenderCommand render_of(const Settings& settings, const TradeView& view)
{
    CLI::App command;
    RenderCommand options;
    add_render_options(command, options);
    std::vector<std::string> arguments = arguments_of(settings, view);
    arguments.erase(arguments.begin());             // "render"
    arguments.emplace_back("--output=picture.exr"); // required; nothing is written
    std::ranges::reverse(arguments);                // CLI11 takes them from the back
    try {
        command.parse(arguments);
    } catch (const CLI::ParseError& error) {
        throw std::invalid_argument(error.what());
    }
    settle_batch_size(options, false);
    expect_no_idle_options(command, options);
    if (options.no_roulette && options.max_edges == images::unlimited_edges)
        throw std::invalid_argument("roulette=off needs max-edges: paths would never end");
    return options;
}

} // namespace cli
