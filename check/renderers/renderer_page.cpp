#include "check/renderers/renderer_page.h"

#include "check/renderers/renderer_page_parts.h" // made from the files in page/
#include "check/renderers/renderer_results.h"
#include "check/shell_line.h"
#include "golden/reason.h"
#include "images/base64.h"
#include "images/exposure.h"
#include "images/film.h"
#include "images/page_template.h"
#include "images/png.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace check {

namespace {

using images::html_text;
using images::Image;
using images::Rgb;

/// The name of the verdict's class in the style sheet.
std::string_view class_of(SceneVerdict verdict)
{
    switch (verdict) {
    case SceneVerdict::pass:
        return "pass";
    case SceneVerdict::fail:
        return "fail";
    case SceneVerdict::no_picture:
        return "no_picture";
    case SceneVerdict::inconclusive:
        break;
    }
    return "inconclusive";
}

images::Film film_of(const std::vector<Image>& pictures)
{
    images::Film film(pictures.front().width, pictures.front().height);
    for (const Image& picture : pictures) film.add_batch(picture);
    return film;
}

/// From white to red for z > 0, to blue for z < 0.
Rgb colour_of(double z)
{
    constexpr double full = 6.0;
    const double part = std::clamp(std::abs(z) / full, 0.0, 1.0);
    const Rgb end = z > 0.0 ? Rgb(0.45, 0.01, 0.02) : Rgb(0.015, 0.13, 0.41);
    return Rgb(1.0) + (end - Rgb(1.0)) * part;
}

double mean_of(const Rgb& colour)
{
    return (colour.r + colour.g + colour.b) / 3.0;
}

std::string figure(const Image& picture, double exposure, const std::string& caption)
{
    return "<figure><img alt=\"\" src=\"data:image/png;base64," +
           images::base64(images::encode_png(picture, exposure)) + "\"><figcaption>" + caption +
           "</figcaption></figure>\n";
}

std::string cell(const std::string& text)
{
    return "<td class=\"n\">" + text + "</td>";
}

std::string percent(double value)
{
    if (!std::isfinite(value)) return "–";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.2f%%", 100.0 * value);
    return text.data();
}

std::string row_html(const SceneCheck& scene)
{
    std::string row = "<tr><td>" + html_text(scene.scene().name) + "</td><td><span class=\"word " +
                      std::string(class_of(scene.verdict())) + "\">" + describe(scene.verdict()) +
                      "</span></td>";
    if (const auto& comparison = scene.comparison()) {
        const WholePicture whole = whole_picture(*comparison);
        row += cell(percent(whole.ratio) + " (" + golden::channel_names[whole.channel] + ")") +
               cell(percent(whole.low) + " … " + percent(whole.high)) +
               cell(std::isfinite(whole.visible) ? golden::say_percent(whole.visible) : "–");
    } else
        row += cell("–") + cell("–") + cell("–");
    return row + cell(std::to_string(scene.pictures().size())) + "</tr>\n";
}

std::string scene_html(const SceneCheck& scene)
{
    const images::Image& expected = scene.golden().mean;
    const double exposure = images::middle_exposure(expected);
    std::string pictures = figure(expected, exposure, "golden");
    if (!scene.pictures().empty())
        pictures += figure(film_of(scene.pictures()).mean(), exposure,
                           "candidate, mean of " + std::to_string(scene.pictures().size())) +
                    figure(difference_picture(scene.golden(), scene.pictures()), 0.0, "difference");
    std::string output;
    if (const auto& missing = scene.missing())
        output = "<pre>" +
                 html_text(missing->command + "\n\n" +
                           (missing->last_lines.empty() ? "It printed nothing." : missing->last_lines)) +
                 "</pre>\n";
    const std::string name = html_text(scene.scene().name);
    const std::string verdict = describe(scene.verdict());
    const std::string reason = html_text(scene.reason());
    return images::fill(page_parts::scene,
                        std::array<images::Mark, 6>{{{"@CLASS@", class_of(scene.verdict())},
                                                     {"@NAME@", name},
                                                     {"@VERDICT@", verdict},
                                                     {"@REASON@", reason},
                                                     {"@OUTPUT@", output},
                                                     {"@PICTURES@", pictures}}});
}

std::string how(const RendererCheck& check, const RendererOptions& options)
{
    double chance = 0.0;
    for (const SceneCheck& scene : check.scenes) chance += scene.false_alarm();
    std::string text = std::to_string(options.samples) + " samples per pixel in each picture. ";
    if (check.stopped) text += "The check was interrupted. ";
    if (check.time_up) text += "The check ended when its time was spent. ";
    return text + "The chance that a right renderer FAILs in any scene is at most " +
           golden::say(chance, 2) + ".";
}

SceneVerdict worst_of(const RendererCheck& check)
{
    if (count(check, SceneVerdict::fail) + count(check, SceneVerdict::no_picture) > 0)
        return SceneVerdict::fail;
    return count(check, SceneVerdict::inconclusive) > 0 ? SceneVerdict::inconclusive
                                                        : SceneVerdict::pass;
}

} // namespace

Image difference_picture(const golden::Golden& golden, const std::vector<Image>& pictures)
{
    const images::Film film = film_of(pictures);
    const images::BatchMoments moments = film.moments();
    const Image error = images::standard_error(moments, film.batches());
    const double batches = static_cast<double>(golden.batches());
    Image result(golden.mean.width, golden.mean.height);
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const double of_golden = mean_of(golden.standard_error.pixels[i]);
        const double own =
            pictures.size() > 1 ? mean_of(error.pixels[i]) : of_golden * std::sqrt(batches);
        const double expected = mean_of(golden.mean.pixels[i]);
        const double difference = mean_of(moments.mean.pixels[i]) - expected;
        const double rounding = 2e-6 * std::abs(expected); // as the comparison allows
        const double deviation = std::hypot(of_golden, own, rounding);
        const double z = difference == 0.0 ? 0.0 : difference / deviation;
        result.pixels[i] = colour_of(z);
    }
    return result;
}

std::string renderer_page(const RendererCheck& check, const RendererOptions& options)
{
    std::string common;
    for (const std::string& sentence : in_common(check)) common += "<br>" + html_text(sentence);
    std::string rows;
    std::string scenes;
    // Those that fail first: they are why the page is read.
    for (const SceneVerdict verdict :
         {SceneVerdict::no_picture, SceneVerdict::fail, SceneVerdict::inconclusive, SceneVerdict::pass})
        for (const SceneCheck& scene : check.scenes)
            if (scene.verdict() == verdict) {
                rows += row_html(scene);
                scenes += scene_html(scene);
            }
    const std::string title =
        html_text("Check of " + (options.command.empty() ? "" : options.command[0]));
    const std::string command = html_text(shell_line(options.command));
    const std::string verdicts = summary(check);
    const std::string note = how(check, options);
    return images::fill(page_parts::page,
                        std::array<images::Mark, 8>{{{"@TITLE@", title},
                                                     {"@CLASS@", class_of(worst_of(check))},
                                                     {"@SUMMARY@", verdicts},
                                                     {"@COMMON@", common},
                                                     {"@COMMAND@", command},
                                                     {"@HOW@", note},
                                                     {"@ROWS@", rows},
                                                     {"@SCENES@", scenes}}});
}

} // namespace check
