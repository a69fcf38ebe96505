#pragma once

// Whole numbers with an exponent: 1e3 is 1000.

#include <string>

namespace CLI {
class App;
}

namespace cli {

/// The digits of the whole number that `text` writes with an exponent, as in "1e3", "1.5e4" or "2E+6".
/// Any other text is returned unchanged: without an exponent, not a whole number ("1e-3"), or of more
/// than 20 digits.
std::string without_exponent(const std::string& text);

/// All options of whole numbers of `program` and of its subcommands accept an exponent.
void take_exponents(CLI::App& program);

} // namespace cli
