#include "golden/report.h"
#include "golden/reason.h"
#include "golden/report_page.h" // page_template, made from report_page.html
#include "images/atomic_file.h"
#include "images/base64.h"
#include "images/exposure.h"
#include "images/flip.h"
#include "images/page_template.h"
#include "images/png.h"
#include "images/strategy_sheet.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string_view>

namespace golden {

namespace {

using Json = nlohmann::ordered_json;

std::string base64_floats(const std::vector<float>& values)
{
    std::string bytes(values.size() * sizeof(float), '\0');
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return images::base64(bytes);
}

std::string base64_of(const images::Image& image)
{
    std::vector<float> values;
    for (const images::Rgb& pixel : image.pixels)
        for (int c = 0; c < 3; ++c) values.push_back(static_cast<float>(pixel[c]));
    return base64_floats(values);
}

Json json_of(const Finding& finding)
{
    return {{"region", describe(finding.region)},
            {"weight", describe(finding.weight)},
            {"channel", finding.channel},
            {"conclusive", finding.conclusive},
            {"z", finding.test.z},
            {"p", finding.test.p},
            {"adjusted_p", finding.adjusted_p},
            {"ratio", finding.ratio},
            {"low", finding.interval.low},
            {"high", finding.interval.high},
            {"detectable", finding.detectable}};
}

std::string number(const char* format, double value)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), format, value);
    return text.data();
}

/// The numbers in sentences.
std::vector<std::string> summary_of(const Comparison& comparison)
{
    std::vector<std::string> lines;
    for (const OddPixels& odd : comparison.odd) lines.push_back(describe(odd) + ".");
    lines.push_back("Method: " + describe(comparison.method) + ". " +
                    std::to_string(comparison.stages.empty() ? 0 : comparison.stages.front().batches) +
                    " batches of the candidate against " + std::to_string(comparison.golden_batches) +
                    " of the golden.");
    lines.push_back("The smallest adjusted p-value is " + number("%.3g", comparison.p) + " among " +
                    std::to_string(comparison.findings.size()) + " tests, of which " +
                    number("%.1f", 100.0 * comparison.coverage) + "% are conclusive.");
    if (comparison.suspicion) {
        const Finding& f = comparison.findings[*comparison.suspicion];
        lines.push_back((f.adjusted_p == comparison.p
                             ? "It is that of "
                             : "Confirmed is the one of " + number("%.3g", f.adjusted_p) + ", of ") +
                        describe(f) + ".");
    }
    if (comparison.least_sensitive_stratum) {
        const Finding& f = comparison.findings[*comparison.least_sensitive_stratum];
        lines.push_back("Least sensitive stratum: " + describe(f) + ", where " +
                        (std::isfinite(f.detectable)
                             ? "an error of " + number("%.2f", 100.0 * f.detectable) + "%"
                             : std::string("no error")) +
                        " is detectable.");
    }
    if (comparison.noise_ratio)
        lines.push_back("The picture's own noise is " + say_noise(comparison) + ".");
    if (const std::string limit = say_golden_limit(comparison); !limit.empty())
        lines.push_back("The golden: " + limit + ".");
    return lines;
}

Json json_of(const OddPixels& odd)
{
    Json json = {{"kind", describe(odd.kind)}, {"pixels", odd.pixels.size()}, {"x", odd.place.x},
                 {"y", odd.place.y},           {"channel", odd.channel},      {"value", odd.value},
                 {"golden", odd.expected},     {"wrong", odd.wrong}};
    if (odd.picture) json["picture"] = *odd.picture;
    return json;
}

/// The number of samples, or pictures, that makes an error of the specified size detectable; or, where
/// no number does, the size of golden that is needed.
Json needed_by(const Comparison& comparison)
{
    const bool in_samples = comparison.batch_size > 0.0;
    const double unit = in_samples ? comparison.batch_size : 1.0;
    const std::string what = in_samples ? "samples" : "batches";
    if (std::isinf(comparison.shortfall->candidate))
        return {{"golden_" + what, comparison.shortfall->golden * unit}};
    if (comparison.method == Method::welch) return {{"pictures", comparison.shortfall->candidate}};
    return {{what, comparison.shortfall->candidate * unit}};
}

Json numbers_of(const Report& report)
{
    const Comparison& comparison = report.comparison;
    Json json = {{"verdict", describe(comparison.verdict)},
                 {"reason", comparison.reason},
                 {"diagnosis", comparison.diagnosis},
                 {"method", describe(comparison.method)},
                 {"p", comparison.p},
                 {"coverage", comparison.coverage},
                 {"detectable", comparison.detectable},
                 {"golden_limit", comparison.golden_limit},
                 {"golden_batches", comparison.golden_batches},
                 {"summary", summary_of(comparison)},
                 {"width", report.golden.mean.width},
                 {"height", report.golden.mean.height},
                 {"golden", report.golden.metadata},
                 {"candidate", report.candidate_metadata}};
    if (comparison.noise_ratio) json["noise_ratio"] = *comparison.noise_ratio;
    if (comparison.noise_error) json["noise_error"] = *comparison.noise_error;
    if (comparison.shortfall) json["needed"] = needed_by(comparison);
    json["odd_pixels"] = Json::array();
    for (const OddPixels& odd : comparison.odd) json["odd_pixels"].push_back(json_of(odd));
    json["whole"] = Json::array();
    json["tiles"] = Json::array();
    json["stages"] = Json::array();
    json["findings"] = Json::array();
    for (std::size_t channel = 0; channel < channel_count; ++channel) {
        json["whole"].push_back(json_of(whole_picture(comparison, channel)));
        const TileMap tiles = tile_map(comparison, channel);
        json["tiles"].push_back({{"columns", tiles.columns}, {"rows", tiles.rows}, {"z", tiles.z}});
    }
    for (const Stage& stage : comparison.stages)
        json["stages"].push_back({{"batches", stage.batches}, {"p", stage.p}, {"level", stage.level}});
    for (const Finding& finding : comparison.findings) json["findings"].push_back(json_of(finding));
    return json;
}

/// The sheet of all layers that are named for a strategy, as a data URI; empty if there is none.
std::string sheet_of(const images::Layers& layers)
{
    images::Strategies strategies;
    for (const auto& [name, image] : layers) {
        int s = 0;
        int t = 0;
        int end = 0;
        if (std::sscanf(name.c_str(), "s%dt%d%n", &s, &t, &end) == 2 &&
            static_cast<std::size_t>(end) == name.size())
            strategies.emplace(std::pair(s, t), image);
    }
    if (strategies.empty()) return {};
    return "data:image/png;base64," +
           images::base64(images::encode_png(images::strategy_sheet(strategies)));
}

} // namespace

std::string report_json(const Report& report)
{
    return numbers_of(report).dump();
}

std::string report_page(const Report& report)
{
    Json data = numbers_of(report);
    const images::ErrorMap flip_map = images::flip(report.golden.mean, report.candidate);
    data["exposure"] = images::middle_exposure(report.golden.mean);
    data["pictures"] = {{"golden", base64_of(report.golden.mean)},
                        {"candidate", base64_of(report.candidate)},
                        {"flip", base64_floats({flip_map.begin(), flip_map.end()})}};
    if (const std::string sheet = sheet_of(report.strategies); !sheet.empty())
        data["pictures"]["strategies"] = sheet;
    const std::string verdict = describe(report.comparison.verdict);
    const std::string title = images::html_text(report.title);
    const std::string reason = images::html_text(report.comparison.reason);
    const std::string text = images::script_data(data.dump(-1, ' ', true));
    return images::fill(
        page_template,
        std::array<images::Mark, 4>{
            {{"@TITLE@", title}, {"@VERDICT@", verdict}, {"@REASON@", reason}, {"@DATA@", text}}});
}

void write_report(const std::filesystem::path& path, const Report& report)
{
    images::write_atomically(path, report_page(report));
}

} // namespace golden
