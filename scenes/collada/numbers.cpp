#include "scenes/collada/numbers.h"

#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

namespace scenes::collada {
namespace {

constexpr std::string_view white_space = " \t\n\r";

/// Removes the next word from the front of `text` and returns it; empty at the end.
std::string_view next_word(std::string_view& text)
{
    text.remove_prefix(std::min(text.find_first_not_of(white_space), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(white_space));
    text.remove_prefix(word.size());
    return word;
}

double to_double(std::string_view word, const Element& element)
{
    // XML Schema allows a plus sign, std::from_chars does not.
    const bool plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
    const char* const end = word.data() + word.size();
    double value = 0;
    const auto [rest, error] = std::from_chars(word.data() + (plus ? 1 : 0), end, value);
    if (error == std::errc::result_out_of_range)
        fail(element, in_quotes(word) + " is out of the range of a double");
    if (error != std::errc() || rest != end) fail(element, in_quotes(word) + " is not a number");
    if (!std::isfinite(value)) fail(element, in_quotes(word) + " is not a finite number");
    return value;
}

std::uint32_t to_index(std::string_view word, const Element& element)
{
    const char* const end = word.data() + word.size();
    std::uint32_t value = 0;
    const auto [rest, error] = std::from_chars(word.data(), end, value);
    if (error == std::errc() && rest == end) return value;
    if (error == std::errc::result_out_of_range) fail(element, in_quotes(word) + " is too large");
    if (word.size() > 1 && word[0] == '-') fail(element, in_quotes(word) + " is negative");
    fail(element, in_quotes(word) + " is not a whole number");
}

void check_count(const Element& element, const std::vector<double>& values, std::size_t count)
{
    if (values.size() != count)
        fail(element,
             std::to_string(values.size()) + " numbers where there should be " + std::to_string(count));
}

} // namespace

std::vector<double> numbers(const Element& element)
{
    const std::string text = text_of(element);
    std::vector<double> values;
    std::string_view rest = text;
    for (auto word = next_word(rest); !word.empty(); word = next_word(rest))
        values.push_back(to_double(word, element));
    return values;
}

std::vector<double> numbers(const Element& element, std::size_t count)
{
    std::vector<double> values = numbers(element);
    check_count(element, values, count);
    return values;
}

double number(const Element& element)
{
    return numbers(element, 1)[0];
}

Vec3 vector(const Element& element)
{
    const std::vector<double> v = numbers(element, 3);
    return {v[0], v[1], v[2]};
}

std::vector<std::uint32_t> indices(const Element& element)
{
    const std::string text = text_of(element);
    std::vector<std::uint32_t> values;
    std::string_view rest = text;
    for (auto word = next_word(rest); !word.empty(); word = next_word(rest))
        values.push_back(to_index(word, element));
    return values;
}

std::uint32_t count_attribute(const Element& element, const char* name,
                              std::optional<std::uint32_t> fallback)
{
    const char* value = element.Attribute(name);
    if (value == nullptr && fallback) return *fallback;
    std::string_view rest = required_attribute(element, name);
    const std::string_view word = next_word(rest);
    if (!next_word(rest).empty())
        fail(element, "attribute \"" + std::string(name) + "\" is not one number");
    return to_index(word, element);
}

Rgb emission_color(const Element& element, Alpha alpha)
{
    std::vector<double> values = numbers(element);
    if (alpha == Alpha::ignored && values.size() == 4) values.pop_back();
    check_count(element, values, 3);
    for (const double value : values)
        if (value < 0) fail(element, "a negative colour");
    return {values[0], values[1], values[2]};
}

Rgb reflection_color(const Element& element, Alpha alpha)
{
    const Rgb color = emission_color(element, alpha);
    for (int i = 0; i < 3; ++i)
        if (color[i] > 1) fail(element, "greater than 1: no surface reflects more than it receives");
    return color;
}

} // namespace scenes::collada
