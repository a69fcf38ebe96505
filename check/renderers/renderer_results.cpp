#include "check/renderers/renderer_results.h"

#include "golden/reason.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace check {

namespace {

using Json = nlohmann::ordered_json;

template <class... Values>
std::string formatted(const char* format, const Values&... values)
{
    std::array<char, 512> text{};
    std::snprintf(text.data(), text.size(), format, values...);
    return text.data();
}

/// "0.43%", "none", or "-" where there is nothing to see.
std::string say_visible(double error)
{
    if (std::isnan(error)) return "-";
    return std::isinf(error) ? "none" : golden::say_percent(error);
}

/// The last three lines, each behind `indent`.
std::string end_of(const std::string& lines, const std::string& indent)
{
    std::size_t begin = lines.size();
    for (int i = 0; i < 3 && begin != std::string::npos && begin > 0; ++i)
        begin = lines.rfind('\n', begin - 1);
    std::string text =
        begin == std::string::npos || lines.empty() ? lines : lines.substr(begin == 0 ? 0 : begin + 1);
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
        text.insert(at + 1, indent);
    return indent + text;
}

std::string row_of(const SceneCheck& scene, int width)
{
    std::string ratio = "-";
    std::string interval = "-";
    std::string visible = "-";
    if (const auto& comparison = scene.comparison()) {
        const WholePicture whole = whole_picture(*comparison);
        if (std::isfinite(whole.ratio)) ratio = formatted("%.2f%%", 100.0 * whole.ratio);
        if (std::isfinite(whole.low) && std::isfinite(whole.high))
            interval = formatted("%.2f .. %.2f%%", 100.0 * whole.low, 100.0 * whole.high);
        visible = say_visible(whole.visible);
    }
    return formatted("%-*s  %-12s  %10s  %20s  %13s  %8zu\n", width, scene.scene().name.c_str(),
                     describe(scene.verdict()).c_str(), ratio.c_str(), interval.c_str(), visible.c_str(),
                     scene.pictures().size());
}

std::string reason_of(const SceneCheck& scene)
{
    std::string text = scene.scene().name + ": " + scene.reason() + "\n";
    if (const auto& missing = scene.missing()) {
        text += missing->last_lines.empty()
                    ? "    It printed nothing.\n"
                    : "    The end of its output:\n" + end_of(missing->last_lines, "        ") + "\n";
        text += "    The command: " + missing->command + "\n";
    }
    return text;
}

SceneVerdict worst(const RendererCheck& check)
{
    for (const SceneVerdict verdict :
         {SceneVerdict::no_picture, SceneVerdict::fail, SceneVerdict::inconclusive})
        if (count(check, verdict) > 0) return verdict;
    return SceneVerdict::pass;
}

Json json_of(const SceneCheck& scene)
{
    Json json = {{"name", scene.scene().name},
                 {"verdict", describe(scene.verdict())},
                 {"reason", scene.reason()},
                 {"diagnosis", scene.diagnosis()},
                 {"pictures", scene.pictures().size()},
                 {"pictures_of_earlier_runs", scene.from_earlier_run()},
                 {"seconds", scene.seconds()},
                 {"required_error", scene.error()},
                 {"false_alarm", scene.false_alarm()},
                 {"features", scene.scene().features}};
    if (const auto& comparison = scene.comparison()) {
        json["p"] = comparison->p;
        json["coverage"] = comparison->coverage;
        json["visible_error"] = comparison->detectable;
        json["whole"] = Json::array();
        for (std::size_t c = 0; c < golden::channel_count; ++c) {
            const golden::Finding& finding = golden::whole_picture(*comparison, c);
            json["whole"].push_back({{"ratio", finding.ratio},
                                     {"low", finding.interval.low},
                                     {"high", finding.interval.high}});
        }
    }
    if (const auto& missing = scene.missing())
        json["missing"] = {
            {"why", missing->why}, {"last_lines", missing->last_lines}, {"command", missing->command}};
    return json;
}

} // namespace

WholePicture whole_picture(const golden::Comparison& comparison)
{
    WholePicture result{0, NAN, NAN, NAN, NAN};
    double furthest = -1.0;
    for (std::size_t c = 0; c < golden::channel_count; ++c) {
        result.visible = std::fmax(result.visible, comparison.detectable[c]);
        const golden::Finding& finding = golden::whole_picture(comparison, c);
        if (std::isnan(finding.ratio) || !(std::abs(finding.test.z) > furthest)) continue;
        furthest = std::abs(finding.test.z);
        result = {c, finding.ratio, finding.interval.low, finding.interval.high, result.visible};
    }
    return result;
}

std::string summary(const RendererCheck& check)
{
    std::string text;
    for (const SceneVerdict verdict :
         {SceneVerdict::pass, SceneVerdict::fail, SceneVerdict::no_picture, SceneVerdict::inconclusive})
        if (const std::size_t number = count(check, verdict); number > 0)
            text += (text.empty() ? "" : ", ") + std::to_string(number) + " " + describe(verdict);
    return text;
}

std::string results_table(const RendererCheck& check)
{
    int width = 5;
    for (const SceneCheck& scene : check.scenes)
        width = std::max(width, static_cast<int>(scene.scene().name.size()));
    std::string text = formatted("%-*s  %-12s  %10s  %20s  %13s  %8s\n", width, "scene", "verdict",
                                 "ratio", "99% interval", "visible error", "pictures");
    for (const SceneCheck& scene : check.scenes) text += row_of(scene, width);
    bool first = true;
    for (const SceneCheck& scene : check.scenes) {
        if (scene.verdict() == SceneVerdict::pass) continue;
        text += (first ? "\n" : "") + reason_of(scene);
        first = false;
    }
    for (const std::string& sentence : in_common(check)) text += "\n" + sentence + "\n";
    std::size_t earlier = 0;
    for (const SceneCheck& scene : check.scenes) earlier += scene.from_earlier_run();
    if (earlier > 0) text += "\n" + std::to_string(earlier) + " pictures are of an earlier run.\n";
    if (check.time_up) text += "\nThe time was spent before all scenes had a verdict: see --budget.\n";
    return text + "\n" + summary(check) + formatted(", after %.1f s\n", check.seconds);
}

Json results_json(const RendererCheck& check, const RendererOptions& options)
{
    Json json = {{"verdict", describe(worst(check))},
                 {"command", options.command},
                 {"samples", options.samples},
                 {"seed", options.series},
                 {"seconds", check.seconds},
                 {"interrupted", check.stopped},
                 {"budget_spent", check.time_up},
                 {"in_common", in_common(check)},
                 {"scenes", Json::array()}};
    for (const SceneCheck& scene : check.scenes) json["scenes"].push_back(json_of(scene));
    return json;
}

} // namespace check
