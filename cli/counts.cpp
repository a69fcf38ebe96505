#include "cli/counts.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace cli {

namespace {

/// 2^64 - 1, the largest that any option takes, has 20.
constexpr std::size_t most_digits = 20;

bool are_digits(std::string_view text)
{
    return std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

} // namespace

std::string without_exponent(const std::string& text)
{
    const std::size_t e = text.find_first_of("eE");
    if (e == std::string::npos) return text;
    const std::string mantissa = text.substr(0, e);
    std::string exponent = text.substr(e + 1);
    if (exponent.starts_with('+')) exponent.erase(0, 1);

    const std::size_t dot = std::min(mantissa.find('.'), mantissa.size());
    std::string digits = mantissa.substr(0, dot);
    std::string fraction = dot < mantissa.size() ? mantissa.substr(dot + 1) : "";
    if (digits.empty() || !are_digits(digits) || !are_digits(fraction)) return text;

    std::size_t power = 0;
    const auto [rest, error] =
        std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
    if (error != std::errc() || rest != exponent.data() + exponent.size() || power > most_digits)
        return text;

    fraction.erase(fraction.find_last_not_of('0') + 1);
    if (fraction.size() > power) return text; // not a whole number
    digits += fraction + std::string(power - fraction.size(), '0');
    digits.erase(0, std::min(digits.find_first_not_of('0'), digits.size() - 1));
    return digits.size() > most_digits ? text : digits;
}

void take_exponents(CLI::App& program)
{
    const auto is_count = [](const CLI::Option* option) {
        const std::string type = option->get_type_name();
        return type.starts_with("UINT") || type.starts_with("INT");
    };
    for (CLI::Option* option : program.get_options())
        if (is_count(option)) option->transform(without_exponent, "", "exponent");
    for (CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
        take_exponents(*command);
}

} // namespace cli
