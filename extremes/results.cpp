#include "extremes/results.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace extremes {

namespace {

Json or_null(const std::optional<double>& value)
{
    return value ? Json(*value) : Json(nullptr);
}

Json json_of(const Point& point)
{
    Json failures = Json::object();
    for (std::size_t kind = 0; kind < failure_kinds; ++kind)
        if (point.failures.at(kind) > 0)
            failures[std::string(failure_names.at(kind))] = point.failures.at(kind);
    return {
        {"parameter", point.parameter}, {"cases", point.cases},     {"errors", point.errors},
        {"median", point.median},       {"largest", point.largest}, {"failures", failures},
        {"refusal", point.refusal},     {"notice", point.notice},   {"not_walked", point.not_walked}};
}

Point point_from(const Json& json)
{
    Point point;
    // What is 0 or empty may be left out.
    json.at("parameter").get_to(point.parameter);
    point.cases = json.value("cases", point.cases);
    point.errors = json.value("errors", point.errors);
    point.median = json.value("median", point.median);
    point.largest = json.value("largest", point.largest);
    point.refusal = json.value("refusal", point.refusal);
    point.notice = json.value("notice", point.notice);
    point.not_walked = json.value("not_walked", point.not_walked);
    const Json failures = json.value("failures", Json::object());
    for (const auto& [name, count] : failures.items()) {
        const auto kind = failure_of(name);
        if (!kind) throw std::invalid_argument("it has an unknown failure, " + name);
        point.failures.at(static_cast<std::size_t>(*kind)) = count.get<std::uint64_t>();
    }
    return point;
}

Json json_of(const Axis& axis, const WalkedAxis::Of& of)
{
    Json first = Json::array();
    for (std::size_t kind = 0; kind < failure_kinds; ++kind) {
        const auto failure = static_cast<Failure>(kind);
        const auto below = first_failure(axis, of.points, failure, false);
        const auto above = first_failure(axis, of.points, failure, true);
        if (below || above)
            first.push_back(
                {{"kind", name(failure)}, {"below", or_null(below)}, {"above", or_null(above)}});
    }
    Json points = Json::array();
    for (const Point& point : of.points) points.push_back(json_of(point));
    const auto safe = safe_range(axis, of.points);
    return {{"name", of.method.name},
            {"format", of.method.format == Format::binary64 ? "double" : "float"},
            {"safe", safe ? Json::array({safe->from, safe->to}) : Json(nullptr)},
            {"first_failures", first},
            {"points", points}};
}

/// The bound at the values of the axis within the limit, and at the limit itself.
Json bound_curve(const Axis& axis, const Limit& limit)
{
    const auto [from, to] = std::minmax(axis.ordinary, limit.safe);
    std::vector<double> parameters = {limit.safe};
    for (const double value : axis.values)
        if (value >= from && value <= to && value != limit.safe) parameters.push_back(value);
    std::ranges::sort(parameters);
    Json curve = Json::array();
    for (const double parameter : parameters)
        if (const double bound = limit.bound(parameter); std::isfinite(bound))
            curve.push_back(Json::array({parameter, bound}));
    return curve;
}

const WalkedAxis::Of* method_of(const WalkedAxis& walked, const std::string& name)
{
    const auto found = std::ranges::find_if(
        walked.methods, [&](const WalkedAxis::Of& of) { return of.method.name == name; });
    return found == walked.methods.end() ? nullptr : &*found;
}

Json json_of(const WalkedAxis& walked)
{
    const Axis& axis = walked.axis;
    Json json = {{"number", axis.number},     {"name", axis.name},
                 {"title", axis.title},       {"parameter", axis.parameter},
                 {"about", axis.about},       {"derivation", axis.derivation},
                 {"ordinary", axis.ordinary}, {"logarithmic", axis.logarithmic},
                 {"values", axis.values},     {"methods", Json::array()},
                 {"limits", Json::array()}};
    for (const WalkedAxis::Of& of : walked.methods) json["methods"].push_back(json_of(axis, of));
    for (const Limit& limit : axis.limits)
        if (const WalkedAxis::Of* of = method_of(walked, limit.method); of != nullptr)
            json["limits"].push_back(
                {{"method", limit.method},
                 {"safe", limit.safe},
                 {"beyond", std::isnan(limit.beyond) ? Json(nullptr) : Json(limit.beyond)},
                 {"failure", name(limit.failure)},
                 {"because", limit.because},
                 {"bound", bound_curve(axis, limit)},
                 {"contradiction", contradiction(axis, limit, of->points)}});
    return json;
}

} // namespace

Json results(const Description& description, const std::vector<WalkedAxis>& walked)
{
    Json json = {{"format", results_format},
                 {"program", description.program},
                 {"command", description.command},
                 {"date", description.date},
                 {"processor", description.processor},
                 {"cases", description.cases},
                 {"seed", description.seed},
                 {"complete", description.complete},
                 {"axes", Json::array()}};
    for (const WalkedAxis& axis : walked) json["axes"].push_back(json_of(axis));
    return json;
}

std::vector<std::string> contradictions(const std::vector<WalkedAxis>& walked)
{
    std::vector<std::string> lines;
    for (const WalkedAxis& of : walked)
        for (const Limit& limit : of.axis.limits)
            if (const WalkedAxis::Of* method = method_of(of, limit.method); method != nullptr)
                if (const std::string why = contradiction(of.axis, limit, method->points); !why.empty())
                    lines.push_back(of.axis.name + ", " + limit.method + ": " + why);
    return lines;
}

namespace {

void expect_format(const Json& json)
{
    if (json.at("format") != results_format) throw std::invalid_argument("its format is another one");
}

std::invalid_argument no_result(const nlohmann::json::exception& error)
{
    return std::invalid_argument(std::string("it is no result of this program: ") + error.what());
}

} // namespace

Description description_of(const Json& json)
{
    try {
        expect_format(json);
        return {json.at("program"), json.at("command"), json.at("date"),    json.at("processor"),
                json.at("cases"),   json.at("seed"),    json.at("complete")};
    } catch (const nlohmann::json::exception& error) {
        throw no_result(error);
    }
}

void restore(const Json& json, const Description& description, std::vector<WalkedAxis>& walked,
             bool with_unwalked)
{
    try {
        expect_format(json);
        const Json expected = {
            {"program", description.program}, {"cases", description.cases}, {"seed", description.seed}};
        for (const auto& [key, value] : expected.items())
            if (json.at(key) != value)
                throw std::invalid_argument("its " + key + " is " + json.at(key).dump() + ", and not " +
                                            value.dump());
        for (const Json& axis : json.at("axes"))
            for (WalkedAxis& into : walked) {
                if (axis.at("name") != into.axis.name) continue;
                for (const Json& method : axis.at("methods"))
                    for (WalkedAxis::Of& of : into.methods) {
                        if (method.at("name") != of.method.name) continue;
                        for (const Json& point : method.at("points"))
                            if (Point read = point_from(point);
                                (read.cases > 0 || (with_unwalked && !read.not_walked.empty())) &&
                                std::ranges::find(into.axis.values, read.parameter) !=
                                    into.axis.values.end())
                                of.points.push_back(std::move(read));
                    }
            }
    } catch (const nlohmann::json::exception& error) {
        throw no_result(error);
    }
}

} // namespace extremes
