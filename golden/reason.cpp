#include "golden/reason.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace golden {

namespace {

/// Rounded up to two digits.
std::string say_about(double count)
{
    double unit = 1.0;
    while (count / unit > 100.0) unit *= 10.0;
    return say(std::ceil(count / unit) * unit, 15);
}

/// The largest of three channels. NaN, of a channel in which the golden is black, is ignored.
double largest(const std::array<double, 3>& errors)
{
    double result = 0.0;
    for (const double error : errors) result = std::fmax(result, error);
    return result;
}

/// "= 0.013"; a p-value that is rounded to 0 is not 0.
std::string say_p(double p)
{
    constexpr double smallest = 1e-300;
    return p < smallest ? "< 1e-300" : "= " + say(p, 2);
}

std::string say_fixed(double number)
{
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.2f", number);
    return text.data();
}

/// Whether most fine tiles differ from the golden by the same factor.
bool is_scaled(const Comparison& comparison, const Finding& whole)
{
    double tiles = 0.0;
    double alike = 0.0;
    for (const Finding& finding : comparison.findings) {
        if (finding.region.kind != RegionKind::fine_tile || finding.weight != Weight::matched ||
            finding.channel != whole.channel || std::isnan(finding.ratio))
            continue;
        tiles += 1.0;
        const bool differs = finding.interval.low > 1.0 || finding.interval.high < 1.0;
        alike += differs && finding.interval.low <= whole.interval.high &&
                 finding.interval.high >= whole.interval.low;
    }
    return tiles >= 4.0 && alike >= 0.9 * tiles;
}

/// The picture with its rows in reverse order.
images::Image upside_down(const images::Image& image)
{
    images::Image turned(image.width, image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) turned.at(x, y) = image.at(x, image.height - 1 - y);
    return turned;
}

/// The sum over pixels of |a - b| / (|a| + |b|), to which each value adds at most 1.
double distance(const images::Image& a, const images::Image& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double both = std::abs(a.pixels[i][c]) + std::abs(b.pixels[i][c]);
            if (both > 0.0) sum += std::abs(a.pixels[i][c] - b.pixels[i][c]) / both;
        }
    return sum;
}

} // namespace

std::string say_percent(double fraction)
{
    return say(100.0 * fraction, 2) + "%";
}

std::string say(double number, int digits)
{
    std::ostringstream text;
    text.precision(digits);
    text << number;
    return text.str();
}

std::string say_suspicion(const Comparison& comparison)
{
    const Finding& finding = comparison.findings[*comparison.suspicion];
    std::string text = describe_place(finding);
    if (is_linear(finding.weight) && !std::isnan(finding.ratio) && std::isfinite(finding.interval.high))
        text += " is " + say(finding.ratio, 4) + " times the golden's (99% interval " +
                say(finding.interval.low, 4) + " to " + say(finding.interval.high, 4) + ")";
    else
        text += finding.test.z > 0.0 ? " is brighter than the golden's" : " is darker than the golden's";
    return text + ", p " + say_p(finding.adjusted_p);
}

std::string say_shortfall(const Comparison& comparison)
{
    if (!comparison.shortfall) return "more samples are needed";
    const bool in_samples = comparison.batch_size > 0.0;
    const double unit = in_samples ? comparison.batch_size : 1.0;
    const std::string units = in_samples ? " samples per pixel" : " batches";
    if (std::isinf(comparison.shortfall->candidate)) {
        const double limit = largest(comparison.golden_limit);
        return "more samples do not help, as the golden's own noise hides " +
               (std::isinf(limit) ? "everything" : "errors below " + say_percent(limit)) +
               "; a golden of about " + say_about(comparison.shortfall->golden * unit) + units +
               " is needed";
    }
    const bool pictures = comparison.method == Method::welch;
    const double factor = pictures ? 1.0 : unit;
    return "about " + say_about(comparison.shortfall->candidate * factor) +
           (pictures ? " such pictures" : units) + " are needed instead of " +
           say(comparison.candidate_batches * factor, 12);
}

std::string say_noise(const Comparison& comparison)
{
    return say_fixed(*comparison.noise_ratio) + " +- " + say_fixed(*comparison.noise_error) +
           " times what its samples were assumed to have" +
           (comparison.odd.empty() ? "" : ", the pixels named above left out");
}

std::string say_golden_limit(const Comparison& comparison)
{
    const double limit = largest(comparison.golden_limit);
    const double detectable = largest(comparison.detectable);
    if (!(limit > 0.0)) return "";
    if (std::isinf(limit)) return "its own noise hides all errors";
    constexpr double nearly = 1.2;
    return "its own noise hides errors below " + say_percent(limit) +
           (detectable < nearly * limit ? ": more samples of the candidate hardly help" : "");
}

void give_reason(Comparison& comparison, const std::string& text)
{
    std::string reason;
    for (const OddPixels& odd : comparison.odd) {
        if (!reason.empty()) reason += " ";
        reason += describe(odd) + ".";
    }
    if (!reason.empty() && !text.empty()) reason += " ";
    comparison.reason = reason + text;
}

std::string say_possible_causes(const Comparison& comparison, const Golden& golden,
                                const images::Metadata& candidate, const images::Image& mean)
{
    if (comparison.verdict == Verdict::pass || !comparison.suspicion) return "";
    const bool diagnosed = !comparison.diagnosis.empty();
    if (!diagnosed && 2.0 * distance(mean, upside_down(golden.mean)) < distance(mean, golden.mean))
        return " The picture agrees better with the golden upside down: its first row should be the "
               "top.";
    std::string text = diagnosed ? " " + comparison.diagnosis : "";
    const Finding& suspicion = comparison.findings[*comparison.suspicion];
    const Finding& whole = whole_picture(comparison, suspicion.channel);
    const auto edges = golden.metadata.find("max_edges");
    if (whole.interval.low > 1.0 && edges != golden.metadata.end() && !candidate.contains("max_edges"))
        text += " The golden's paths have at most " + edges->second +
                " edges, the camera's counted: a picture that is brighter nearly everywhere may have "
                "longer ones.";
    constexpr double black = 0.01;
    if (!diagnosed && whole.ratio > black && is_scaled(comparison, whole))
        text += " It differs by nearly the same factor everywhere, as by another exposure or unit.";
    return text;
}

} // namespace golden
