// The results as text: a table for the terminal, and Markdown for the documentation.

#include "extremes/results.h"

#include "scenes/short_number.h"

#include <algorithm>

namespace extremes {

namespace {

using Line = std::vector<std::string>;

/// "leaked at 1e6; refused at 1e-9"; and where the walk left something out.
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
            text += (text.empty() ? "" : "; ") + kind + " at " + scenes::short_number(parameter);
        }
    }
    for (const Json& point : method.at("points"))
        if (const std::string why = point.at("not_walked"); !why.empty())
            text += (text.empty() ? "none; " : "; ") + std::string("not walked at ") +
                    scenes::short_number(point.at("parameter")) + ": " + why;
    return text.empty() ? "none" : text;
}

Line line_of(const Json& axis, const Json& method)
{
    const double ordinary = axis.at("ordinary");
    std::string median = "-";
    std::string largest = "-";
    for (const Json& point : method.at("points"))
        if (point.at("parameter") == ordinary && point.at("errors").get<std::uint64_t>() > 0) {
            median = scenes::short_number(point.at("median"));
            largest = scenes::short_number(point.at("largest"));
        }
    const Json& safe = method.at("safe");
    return {"  " + method.at("name").get<std::string>(), median, largest,
            safe.is_null()
                ? "nowhere"
                : scenes::short_number(safe.at(0)) + " to " + scenes::short_number(safe.at(1)),
            first_failures_of(method, ordinary)};
}

/// "up to 1e6" or "down to 1e-9"
std::string safe_words(const Json& axis, const Json& limit)
{
    const double safe = limit.at("safe");
    return (safe < axis.at("ordinary").get<double>() ? "down to " : "up to ") +
           scenes::short_number(safe);
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
        std::vector<Line> lines = {
            {"  method", "median at " + scenes::short_number(axis.at("ordinary").get<double>()),
             "largest", "no failure in", "first failures"}};
        for (const Json& method : axis.at("methods")) lines.push_back(line_of(axis, method));
        text += aligned(lines);
        for (const Json& limit : axis.at("limits")) {
            text += "  " + limit.at("method").get<std::string>() + " is safe " +
                    safe_words(axis, limit) + ", because " + limit.at("because").get<std::string>() +
                    '\n';
            if (const std::string why = limit.at("contradiction"); !why.empty())
                text += "  CONTRADICTED: " + why + '\n';
        }
        text += '\n';
    }
    return text;
}

namespace {

/// "leaked at 1e9", or that nothing fails.
std::string beyond_words(const Json& limit)
{
    if (limit.at("beyond").is_null()) return "no failure found";
    return limit.at("failure").get<std::string>() + " at " +
           scenes::short_number(limit.at("beyond").get<double>());
}

/// The largest bound along the way from the ordinary value to the limit.
std::string largest_bound(const Json& limit)
{
    double largest = 0.0;
    for (const Json& point : limit.at("bound")) largest = std::max(largest, point.at(1).get<double>());
    return scenes::short_number(largest);
}

std::string section(const Json& axis)
{
    const std::string axis_name = axis.at("name");
    std::string text = "### " + std::to_string(axis.at("number").get<int>()) + ". " +
                       axis.at("title").get<std::string>() + " (`" + axis_name + "`)\n\n" +
                       axis.at("about").get<std::string>() +
                       "\n\n![Errors and failures: " + axis.at("title").get<std::string>() +
                       "](../images/extremes_" + axis_name + ".png)\n\n";
    for (const Json& limit : axis.at("limits"))
        text += "- **" + limit.at("method").get<std::string>() + "** is safe " +
                safe_words(axis, limit) + ", because " + limit.at("because").get<std::string>() + "\n";
    if (!axis.at("limits").empty()) text += "\n";
    if (const std::string derivation = axis.at("derivation"); !derivation.empty())
        text += "Derivation: " + derivation + "\n\n";
    text += "| method | median error at " + scenes::short_number(axis.at("ordinary").get<double>()) +
            " | largest | no failure in | first failures |\n|---|---|---|---|---|\n";
    for (const Json& method : axis.at("methods")) {
        std::string row = "|";
        for (const std::string& cell : line_of(axis, method))
            row += " " + cell.substr(std::min(cell.find_first_not_of(' '), cell.size())) + " |";
        text += row + "\n";
    }
    return text + "\n";
}

} // namespace

std::string limits_in_markdown(const Json& results)
{
    std::string text = "| axis | method | safe | largest bound on the error | what fails beyond |\n"
                       "|---|---|---|---|---|\n";
    for (const Json& axis : results.at("axes"))
        for (const Json& limit : axis.at("limits"))
            text += "| " + axis.at("name").get<std::string>() + " | " +
                    limit.at("method").get<std::string>() + " | " + safe_words(axis, limit) + " | " +
                    largest_bound(limit) + " | " + beyond_words(limit) + " |\n";
    return text;
}

std::string markdown(const Json& results)
{
    std::string text = limits_in_markdown(results) + "\n";
    for (const Json& axis : results.at("axes")) text += section(axis);
    return text;
}

} // namespace extremes
