#pragma once

// The options of a render as data: a configuration of `plumbline trade`.

#include "cli/render_command.h"

#include <map>
#include <string>
#include <vector>

namespace cli {

/// Options of `plumbline render` without their dashes, with their values; "" for a flag. An option that
/// is missing has its default.
using Settings = std::map<std::string, std::string>;

/// The scene and how it is seen: the same for all configurations.
struct TradeView {
    std::string scene;
    std::string size;
    bool frame = false;
};

/// The options of a render of `view` by these settings, checked as by `plumbline render`. Throws
/// std::invalid_argument for what `plumbline render` refuses.
RenderCommand render_of(const Settings& settings, const TradeView& view);

/// The arguments of `plumbline` that render so, without the files that it writes.
std::vector<std::string> arguments_of(const Settings& settings, const TradeView& view);

/// The same as a command line to copy.
std::string command_line(const Settings& settings, const TradeView& view);

} // namespace cli
