#pragma once

// Counts as people write large ones: 1e3 is 1000.

#include <CLI/CLI.hpp>

#include <string>

namespace cli {

/// The digits of the whole number that `text` writes with an exponent, as in "1e3", "1.5e4" or "2E+6".
/// Any other text is returned as it is: what is no whole number, such as "1e-3", more than 20 digits,
/// and what has no exponent.
std::string without_exponent(const std::string& text);

/// Lets all options of whole numbers, those of all subcommands of `program` included, take an exponent.
void take_exponents(CLI::App& program);

} // namespace cli
