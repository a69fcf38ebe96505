#include "trade/results.h"

#include "trade/estimate.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace trade {

namespace {

double number_in(const Json& json)
{
    return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

Estimate estimate_in(const Json& json)
{
    if (!json.is_object()) return {};
    return {number_in(json.at("value")), number_in(json.at("low")), number_in(json.at("high"))};
}

Estimate scaled(const Estimate& estimate, double factor)
{
    return {estimate.value * factor, estimate.low * factor, estimate.high * factor};
}

using Line = std::vector<std::string>;

const Line head = {"configuration",       "build, ms",         "1 sample, ms", "relMSE after 1 s",
                   "time to equal noise", "error of the mean", "bias",         "memory, MiB"};

Line line_of(const Json& one)
{
    if (!one.at("problem").is_null())
        return {one.at("name"), "not measured: " + one.at("problem").get<std::string>()};
    const Json& bias = one.at("bias");
    const bool compared = !one.at("time_to_equal_noise").is_null();
    return {one.at("name").get<std::string>() + (one.at("front").get<bool>() ? " *" : ""),
            to_text(scaled(estimate_in(one.at("build").at("wall")), 1e3)),
            to_text(scaled(estimate_in(one.at("render").at("wall")), 1e3)),
            to_text(estimate_in(one.at("relmse_1s"))) + (one.at("skewed").get<bool>() ? " ?" : ""),
            compared ? to_text(estimate_in(one.at("time_to_equal_noise"))) : "base",
            error_to_text(estimate_in(bias.at("whole"))),
            bias.at("verdict") == "biased" ? "BIASED" : bias.at("verdict").get<std::string>(),
            one.at("memory").is_null()
                ? "unknown"
                : to_text(scaled(estimate_in(one.at("memory")), 1.0 / (1 << 20)))};
}

} // namespace

std::string table(const Json& results)
{
    std::vector<Line> lines = {head};
    for (const Json& one : results.at("configurations")) lines.push_back(line_of(one));
    std::vector<std::size_t> widths(head.size(), 0);
    for (const Line& line : lines)
        for (std::size_t c = 0; line.size() == head.size() && c < line.size(); ++c)
            widths[c] = std::max(widths[c], line[c].size());
    widths.back() = 0; // nothing follows
    std::string text;
    for (const Line& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            text += line[c];
            if (c + 1 < line.size())
                text += std::string(std::max(widths[c], line[c].size()) - line[c].size() + 2, ' ');
        }
        text += '\n';
    }
    text += "\nValues with their 95% intervals; times on the wall, for one sample per pixel. *: on the "
            "Pareto front.\n?: noise so skewed that its interval may be too narrow.\n\n";
    for (const Json& knob : results.at("knobs"))
        text +=
            knob.at("name").get<std::string>() + ": " + knob.at("sentence").get<std::string>() + '\n';
    if (results.contains("requirements")) {
        text += "\nWhat the scene requires:\n";
        for (const Json& row : results.at("requirements")) {
            const std::string sentence = row.at("sentence");
            text += "  " + row.at("what").get<std::string>() + ": " + row.at("has").get<std::string>() +
                    "; left out: " + row.at("left_out").get<std::string>() +
                    (sentence.empty() ? "" : ". " + sentence) + '\n';
        }
    }
    if (const Json& noise = results.at("noise_of_machine"); noise.is_object())
        text += noise.at("sentence").get<std::string>() + '\n';
    return text;
}

} // namespace trade
