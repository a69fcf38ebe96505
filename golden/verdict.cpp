#include "golden/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace golden {

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

double detectable_by(const Finding& finding)
{
    return finding.conclusive ? finding.detectable : std::numeric_limits<double>::infinity();
}

/// The finding that shows the smallest error of the region and channel that findings[first] is the first
/// of; none if no error is defined there. A finding that is not conclusive shows none.
std::optional<std::size_t> sharpest_in(const std::vector<Finding>& findings, std::size_t first)
{
    std::optional<std::size_t> best;
    for (std::size_t i = first; i < findings.size(); ++i) {
        const Finding& finding = findings[i];
        if (finding.channel != findings[first].channel ||
            finding.functional / weights.size() != findings[first].functional / weights.size())
            break;
        if (std::isnan(finding.detectable) && finding.conclusive) continue;
        if (!best || detectable_by(finding) < detectable_by(findings[*best])) best = i;
    }
    return best;
}

/// The channel in which least can be seen; none if the golden is black.
std::optional<std::size_t> blindest_channel(const Comparison& comparison)
{
    std::optional<std::size_t> blindest;
    for (std::size_t c = 0; c < channel_count; ++c)
        if (!std::isnan(comparison.detectable[c]) &&
            (!blindest || comparison.detectable[c] > comparison.detectable[*blindest]))
            blindest = c;
    return blindest;
}

} // namespace

std::string describe(Verdict verdict)
{
    switch (verdict) {
    case Verdict::pass:
        return "PASS";
    case Verdict::fail:
        return "FAIL";
    case Verdict::inconclusive:
        return "INCONCLUSIVE";
    }
    return "";
}

void summarise(Comparison& comparison)
{
    const std::vector<Finding>& findings = comparison.findings;
    comparison.detectable.fill(undefined);
    double conclusive = 0.0;
    for (std::size_t i = 0; i < findings.size(); ++i) {
        const Finding& finding = findings[i];
        if (finding.conclusive) {
            conclusive += 1.0;
            // Of p-values that are all 0 or all 1, the largest effect.
            const auto rank = [](const Finding& f) {
                return std::pair(f.adjusted_p, -std::abs(f.test.z));
            };
            if (!comparison.suspicion || rank(finding) < rank(findings[*comparison.suspicion]))
                comparison.suspicion = i;
        }
        if (finding.weight != Weight::matched) continue;
        const std::optional<std::size_t> sharpest = sharpest_in(findings, i);
        if (!sharpest) continue; // black
        const double detectable = detectable_by(findings[*sharpest]);
        if (finding.region.kind == RegionKind::whole)
            comparison.detectable[finding.channel] = detectable;
        const bool stratum =
            finding.region.kind == RegionKind::luminance || finding.region.kind == RegionKind::noise;
        if (stratum && (!comparison.blindest_stratum ||
                        detectable > detectable_by(findings[*comparison.blindest_stratum])))
            comparison.blindest_stratum = sharpest;
    }
    comparison.coverage = findings.empty() ? 0.0 : conclusive / static_cast<double>(findings.size());
    if (comparison.suspicion) comparison.p = findings[*comparison.suspicion].adjusted_p;
}

std::string say_percent(double fraction)
{
    std::ostringstream text;
    text.precision(2);
    text << 100.0 * fraction << "%";
    return text.str();
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
    std::string text = describe(finding);
    if (is_linear(finding.weight) && !std::isnan(finding.ratio))
        text += " is " + say(finding.ratio, 4) + " times the golden's (" + say(finding.interval.low, 4) +
                " to " + say(finding.interval.high, 4) + ")";
    else
        text += finding.test.z > 0.0 ? " is brighter than the golden's" : " is darker than the golden's";
    return text + ", p = " + say(comparison.p, 2);
}

void acquit(Comparison& comparison, const CompareOptions& options, const std::string& remark)
{
    const auto channel = blindest_channel(comparison);
    const double detectable = channel ? comparison.detectable[*channel] : 0.0;
    const std::string where = channel ? std::string(" in ") + channel_names[*channel] : "";
    if (detectable > options.specification) {
        comparison.verdict = Verdict::inconclusive;
        comparison.reason = "No difference found, but ";
        comparison.reason +=
            std::isinf(detectable)
                ? "no error of the whole picture" + where + " could have been found for certain"
                : "only an error of " + say_percent(detectable) + " of the whole picture" + where +
                      " would have been";
        comparison.reason +=
            " (required: " + say_percent(options.specification) + "): more samples are needed." + remark;
        return;
    }
    comparison.verdict = Verdict::pass;
    comparison.reason = channel ? "No difference found; an error of " + say_percent(detectable) +
                                      " of the whole picture would have been, with " +
                                      say_percent(options.power) + " probability." + remark
                                : "Both pictures are black." + remark;
}

void convict(Comparison& comparison, const std::string& how)
{
    comparison.verdict = Verdict::fail;
    comparison.reason = say_suspicion(comparison) + how + ".";
}

bool decide_at_once(Comparison& comparison, const CompareOptions& options)
{
    if (comparison.p >= options.accuse) {
        acquit(comparison, options);
        return true;
    }
    if (comparison.p < options.convict) {
        convict(comparison, ", beyond doubt");
        return true;
    }
    return false;
}

} // namespace golden
