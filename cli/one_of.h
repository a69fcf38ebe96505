#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace cli {

/// A check that the value is one of `words`, without a text of its own on the help page, as the option's
/// text names the words.
inline CLI::Validator one_of(const std::vector<std::string>& words)
{
    return CLI::IsMember(words).description("");
}

} // namespace cli
