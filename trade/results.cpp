#include "trade/results.h"

#include "images/base64.h"
#include "trade/estimates.h"
#include "trade/front.h"
#include "trade/resume.h"
#include "trade/sentence.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace trade {

namespace {

constexpr double longest_limit = 100.0; // of the front, in seconds

Json number(double value)
{
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const Times& times)
{
    return {{"wall", json_of(times.wall)}, {"cpu", json_of(times.cpu)}};
}

Json json_of(const Bias& bias)
{
    return {{"verdict", describe(bias.verdict)},
            {"whole", json_of(bias.whole)},
            {"worst", json_of(bias.worst)},
            {"worst_region", bias.worst_region},
            {"p", number(bias.p)},
            {"detectable", number(bias.detectable)},
            {"reason", bias.reason}};
}

/// Mean and range.
Json range_of(const std::vector<double>& values)
{
    if (values.empty()) return nullptr;
    const auto [low, high] = std::ranges::minmax(values);
    return json_of(
        Estimate{std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size()),
                 low, high});
}

/// The first knob of a configuration, and its value there.
struct Place {
    const Knob* knob = nullptr;
    std::string value;
};

Place place_of(std::size_t configuration, const std::vector<Knob>& knobs)
{
    for (const Knob& knob : knobs)
        for (const Knob::Value& value : knob.values)
            if (value.configuration == configuration) return {&knob, value.text};
    return {};
}

/// The half of the width of an interval of a ratio, relative to it.
double half_width(const Estimate& ratio)
{
    return std::sqrt(ratio.high / ratio.low) - 1.0;
}

/// How precise ratios of times are on this machine: the median over the configurations.
Json noise_of_machine(const std::vector<Measurements>& measured, double precision)
{
    std::vector<double> widths;
    for (std::size_t i = 1; i < measured.size(); ++i)
        if (const Estimate ratio = speed(measured[i].rounds, measured[0].rounds); ratio.stated())
            widths.push_back(half_width(ratio));
    if (widths.empty()) return nullptr;
    const auto middle = widths.begin() + static_cast<std::ptrdiff_t>(widths.size() / 2);
    std::ranges::nth_element(widths, middle);
    const bool noisy = *middle > precision;
    return {{"half_width", *middle},
            {"stated", precision},
            {"sentence",
             noisy ? "The machine was too noisy for the precision asked for: the median "
                     "half width of a ratio of times is " +
                         percent_to_text(*middle) + ", and not at most " + percent_to_text(precision) +
                         ". More --seconds or a quieter machine helps."
                   : "The median half width of a ratio of times is " + percent_to_text(*middle) + "."}};
}

/// All that the parts of the results are made from.
struct Parts {
    const std::vector<Configuration>& configurations;
    const std::vector<Knob>& knobs;
    const std::vector<Measurements>& measured;
    std::vector<std::optional<Estimates>> estimates; // none where there are too few measurements
    Front front;
    std::vector<std::size_t> with_curve; // configuration of each curve of the front

    /// A ratio beside another configuration; null for the configuration itself.
    template <class Ratio>
    [[nodiscard]] Json beside(std::size_t one, std::size_t other, const Ratio& ratio) const
    {
        return one == other ? Json(nullptr)
                            : json_of(ratio(measured[one].rounds, measured[other].rounds));
    }
};

Parts parts_of(const std::vector<Configuration>& configurations, const std::vector<Knob>& knobs,
               const Truth& truth, const std::vector<Measurements>& measured, const Levels& levels)
{
    Parts parts{configurations, knobs, measured, {}, {}, {}};
    std::vector<Curve> curves;
    for (std::size_t i = 0; i < configurations.size(); ++i) {
        parts.estimates.emplace_back();
        if (!measured[i].problem.empty() || measured[i].rounds.size() < 2) continue;
        parts.estimates[i] = estimate(measured[i].rounds, truth, levels);
        curves.push_back(curve_of(measured[i].rounds, parts.estimates[i]->floor));
        parts.with_curve.push_back(i);
    }
    parts.front = front_of(curves, longest_limit);
    return parts;
}

Estimate time_beside(const std::vector<Round>& a, const std::vector<Round>& b)
{
    return time_to_equal_noise(a, b);
}

Json json_of(const Knob& knob, const Parts& parts)
{
    Json values = Json::array();
    for (const Knob::Value& value : knob.values) {
        const std::size_t i = value.configuration;
        values.push_back(
            {{"value", value.text},
             {"configuration", parts.configurations[i].name},
             {"time_to_equal_noise", parts.beside(i, knob.reference, time_beside)},
             {"speed", parts.beside(i, knob.reference, speed)},
             {"pays_from", parts.beside(i, knob.reference, samples_from_which_it_pays)},
             {"reference_pays_from", parts.beside(knob.reference, i, samples_from_which_it_pays)}});
    }
    return {{"name", knob.name},
            {"what", knob.what},
            {"reference", parts.configurations[knob.reference].name},
            {"values", values},
            {"sentence", sentence(knob, parts.estimates, parts.measured)}};
}

/// Adds what was found out about configuration `i`.
void add_estimates(Json& one, std::size_t i, const Parts& parts)
{
    const Measurements& of_one = parts.measured[i];
    const Estimates& found = *parts.estimates[i];
    one["batches"] =
        std::accumulate(of_one.rounds.begin(), of_one.rounds.end(), std::uint64_t{0},
                        [](std::uint64_t sum, const Round& round) { return sum + round.plan.batches; });
    one["batch_size"] = of_one.plan->batch_size;
    one["build"] = json_of(found.build);
    one["render"] = json_of(found.render);
    one["bias"] = json_of(found.bias);
    one["noise"] = json_of(found.noise);
    one["bias_squared"] = json_of(found.bias_squared);
    one["floor"] = found.floor;
    one["relmse_1s"] = json_of(found.relmse_1s);
    one["efficiency"] = json_of(found.efficiency);
    one["time_to_equal_noise"] = parts.beside(i, 0, time_beside);
    one["speed"] = parts.beside(i, 0, speed);
    one["memory"] = range_of(of_one.peak_bytes);
    const auto curve = std::ranges::find(parts.with_curve, i) - parts.with_curve.begin();
    one["front"] = static_cast<bool>(parts.front.member[static_cast<std::size_t>(curve)]);
    one["skewed"] = found.skewed;
    one["picture"] = images::base64(of_one.picture);
    one["picture_seconds"] = of_one.rounds[0].render.wall;
    one["picture_samples"] = of_one.rounds[0].samples();
}

Json json_of_configuration(std::size_t i, const Parts& parts)
{
    const Measurements& of_one = parts.measured[i];
    const Place place = place_of(i, parts.knobs);
    Json one = {{"name", parts.configurations[i].name},
                {"knob", place.knob == nullptr ? "" : place.knob->name},
                {"value", place.value},
                {"base", i == 0},
                {"command", parts.configurations[i].command},
                {"problem", of_one.problem.empty() ? Json(nullptr) : Json(of_one.problem)}};
    if (parts.estimates[i])
        add_estimates(one, i, parts);
    else if (of_one.problem.empty())
        one["problem"] = "fewer than two rounds were measured: no interval";
    one["plan"] =
        of_one.plan ? Json::array({of_one.plan->batch_size, of_one.plan->batches}) : Json(nullptr);
    one["peak_bytes"] = of_one.peak_bytes;
    one["raw"] = Json::array();
    for (const Round& round : of_one.rounds) one["raw"].push_back(raw(round));
    return one;
}

} // namespace

Json json_of(const Estimate& estimate)
{
    return {{"value", number(estimate.value)},
            {"low", number(estimate.low)},
            {"high", number(estimate.high)}};
}

Json results(const Description& description, const StudyOptions& options,
             const std::vector<Configuration>& configurations, const std::vector<Knob>& knobs,
             const Truth& truth, const std::vector<Measurements>& measured)
{
    Levels levels;
    levels.configurations = configurations.size();
    const Parts parts = parts_of(configurations, knobs, truth, measured, levels);
    const golden::Moments& whole = truth.regions()[0].truth;
    Json json = {{"format", results_format},
                 {"program", description.program},
                 {"command", description.command},
                 {"date", description.date},
                 {"machine", {{"processor", description.processor}, {"threads", description.threads}}},
                 {"scene", {{"name", description.scene}, {"hash", description.scene_hash}}},
                 {"width", truth.mean().width},
                 {"height", truth.mean().height},
                 {"seconds", options.seconds},
                 {"rounds", options.rounds},
                 {"seed", options.seed},
                 {"complete", description.complete},
                 {"confidence", levels.confidence},
                 {"false_mark", levels.false_mark},
                 {"identity", identity(description, options, truth)},
                 {"truth",
                  {{"source", description.truth},
                   {"samples", description.truth_samples},
                   {"relmse", truth.own_error()},
                   {"whole_error", std::sqrt(whole.variance / whole.count) / whole.mean}}},
                 {"noise_of_machine", noise_of_machine(measured, description.precision)},
                 {"knobs", Json::array()},
                 {"configurations", Json::array()},
                 {"front", Json::array()}};
    for (const Knob& knob : knobs) json["knobs"].push_back(json_of(knob, parts));
    for (std::size_t i = 0; i < configurations.size(); ++i)
        json["configurations"].push_back(json_of_configuration(i, parts));
    for (const Segment& segment : parts.front.segments)
        json["front"].push_back({{"configuration", configurations[parts.with_curve[segment.curve]].name},
                                 {"from", segment.from},
                                 {"to", segment.to}});
    return json;
}

} // namespace trade
