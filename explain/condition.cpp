#include "explain/condition.h"

#include "explain/names.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <stdexcept>

namespace explain {

namespace {

using Quantity = double (*)(const Strategy&);

const std::map<std::string, Quantity> quantities = {
    {"s", [](const Strategy& a) { return static_cast<double>(a.s); }},
    {"t", [](const Strategy& a) { return static_cast<double>(a.t); }},
    {"edges", [](const Strategy& a) { return static_cast<double>(a.s + a.t - 1); }},
    {"weight", [](const Strategy& a) { return a.made ? a.made->weight : 0.0; }},
    {"value", [](const Strategy& a) { return a.made ? ref::max_component(a.made->value) : 0.0; }},
    {"adds", [](const Strategy& a) { return ref::max_component(a.contribution()); }}};

std::string name_of_family(const Strategy& strategy)
{
    return std::string(family_of(strategy));
}

std::string name_of_obstacle(const Strategy& strategy)
{
    return std::string(name_of(strategy.obstacle));
}

const std::vector<std::string> family_names = {"emission_hit", "next_event", "light_image",
                                               "inner_connection"};

std::vector<std::string> obstacles()
{
    std::vector<std::string> names;
    for (int i = 0; i <= static_cast<int>(Obstacle::vanishes); ++i)
        names.emplace_back(name_of(static_cast<Obstacle>(i)));
    return names;
}

bool compare(double x, const std::string& sign, double y)
{
    if (sign == "=") return x == y;
    if (sign == "!=") return x != y;
    if (sign == "<") return x < y;
    if (sign == "<=") return x <= y;
    return sign == ">" ? x > y : x >= y;
}

[[noreturn]] void refuse(const std::string& term, const std::string& why)
{
    throw std::invalid_argument("--where: " + (term.empty() ? "a term is empty" : term + ": " + why));
}

std::string joined(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

} // namespace

Condition::Condition(const std::string& text) : text_(text)
{
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
        end = text.find(',', begin);
        add_term(text.substr(begin, end == std::string::npos ? end : end - begin));
    }
}

void Condition::add_term(const std::string& term)
{
    const std::size_t at = term.find_first_of("=!<>");
    if (at == std::string::npos) refuse(term, "expected a comparison, such as s=2 or weight>0.5");
    const std::size_t length = term.find_first_not_of("=!<>", at) - at;
    const std::string name = term.substr(0, at);
    const std::string sign = term.substr(at, length);
    const std::string right = at + length < term.size() ? term.substr(at + length) : "";
    if (sign != "=" && sign != "!=" && sign != "<" && sign != "<=" && sign != ">" && sign != ">=")
        refuse(term, "expected =, !=, <, <=, > or >=, not " + sign);

    if (name == "family" || name == "obstacle") {
        const std::vector<std::string> names = name == "family" ? family_names : obstacles();
        if (std::ranges::find(names, right) == names.end())
            refuse(term, "expected one of " + joined(names));
        if (sign != "=" && sign != "!=") refuse(term, "a name can only be compared by = and !=");
        has_obstacle_ = has_obstacle_ || name == "obstacle";
        const auto what = name == "family" ? name_of_family : name_of_obstacle;
        terms_.emplace_back(
            [=](const Strategy& strategy) { return (what(strategy) == right) == (sign == "="); });
        return;
    }
    const auto quantity = quantities.find(name);
    if (quantity == quantities.end())
        refuse(term, "expected s, t, edges, weight, value, adds, family or obstacle");
    double number = 0.0;
    const char* const end = right.data() + right.size();
    const auto [rest, error] = std::from_chars(right.data(), end, number);
    if (right.empty() || error != std::errc() || rest != end) refuse(term, "expected a number");
    terms_.emplace_back([of = quantity->second, sign, number](const Strategy& strategy) {
        return compare(of(strategy), sign, number);
    });
}

bool Condition::holds(const Strategy& strategy) const
{
    if (!has_obstacle_ && !strategy.made) return false;
    return std::ranges::all_of(terms_, [&](const auto& term) { return term(strategy); });
}

} // namespace explain
