// The results as a table in plain text.

#include "extremes/results.h"

#include <algorithm>
#include <array>
#include <cstdio>

namespace extremes {

namespace {

using Line = std::vector<std::string>;

std::string three_digits(double x)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", x);
    return text.data();
}

/// "leaked from 1e6 on; refused below 1e-9"
std::string first_failures_of(const Json& method, double ordinary)
{
    std::string text;
    for (const Json& first : method.at("first_failures")) {
        const std::string kind = first.at("kind");
        for (const char* side : {"below", "above"}) {
            if (first.at(side).is_null()) continue;
            const double parameter = first.at(side);
            if (parameter == ordinary && side == std::string("above") && !first.at("below").is_null())
                continue; // said already
            text += (text.empty() ? "" : "; ") + kind + " at " + three_digits(parameter);
        }
    }
    return text.empty() ? "none" : text;
}

Line line_of(const Json& axis, const Json& method)
{
    const double ordinary = axis.at("ordinary");
    std::string median = "-";
    std::string largest = "-";
    for (const Json& point : method.at("points"))
        if (point.at("parameter") == ordinary && point.at("errors").get<std::uint64_t>() > 0) {
            median = three_digits(point.at("median"));
            largest = three_digits(point.at("largest"));
        }
    const Json& safe = method.at("safe");
    return {"  " + method.at("name").get<std::string>(), median, largest,
            safe.is_null() ? "nowhere" : three_digits(safe.at(0)) + " to " + three_digits(safe.at(1)),
            first_failures_of(method, ordinary)};
}

std::string aligned(const std::vector<Line>& lines)
{
    std::string text;
    for (const Line& line : lines) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            std::size_t width = 0;
            for (const Line& other : lines) width = std::max(width, other[c].size());
            text += line[c];
            if (c + 1 < line.size()) text += std::string(width - line[c].size() + 2, ' ');
        }
        text += '\n';
    }
    return text;
}

} // namespace

std::string table(const Json& results)
{
    std::string text;
    for (const Json& axis : results.at("axes")) {
        text += std::to_string(axis.at("number").get<int>()) + " " + axis.at("name").get<std::string>() +
                ": " + axis.at("title").get<std::string>() + " (" +
                axis.at("parameter").get<std::string>() + ")\n";
        std::vector<Line> lines = {{"  method",
                                    "median at " + three_digits(axis.at("ordinary").get<double>()),
                                    "largest", "no failure in", "first failures"}};
        for (const Json& method : axis.at("methods")) lines.push_back(line_of(axis, method));
        text += aligned(lines);
        for (const Json& limit : axis.at("limits")) {
            const bool below = limit.at("safe").get<double>() < axis.at("ordinary").get<double>();
            text += "  " + limit.at("method").get<std::string>() +
                    (below ? " is safe down to " : " is safe up to ") +
                    three_digits(limit.at("safe").get<double>()) + ", because " +
                    limit.at("because").get<std::string>() + '\n';
            if (const std::string why = limit.at("contradiction"); !why.empty())
                text += "  CONTRADICTED: " + why + '\n';
        }
        text += '\n';
    }
    return text;
}

} // namespace extremes
