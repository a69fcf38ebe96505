#pragma once

// Results that a long command keeps in its output, and goes on with by --resume.

#include "cli/command.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <string>

namespace cli {

/// Calls restore(json) with the content of the file `output`, if it exists. Throws
/// std::invalid_argument, "--resume FILE: REASON", if the file is no JSON or if restore() throws one;
/// images::ImageError if the file cannot be read.
void resume_from(const std::string& output,
                 const std::function<void(const nlohmann::ordered_json&)>& restore);

/// Earlier results in `file`, which show(json) prints or draws. Throws std::invalid_argument, "--from
/// FILE: REASON", if the file is no JSON, or if show() throws one or does not find what it needs in it;
/// images::ImageError if the file cannot be read.
void show_from(const std::string& file, const std::function<void(const nlohmann::ordered_json&)>& show);

/// Says on stderr that the command was interrupted, and how to go on; `output` may be empty. Returns the
/// exit status.
ExitStatus say_interrupted(const std::string& output);

} // namespace cli
