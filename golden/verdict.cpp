#include "golden/verdict.h"
#include "golden/reason.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace golden {

namespace {

constexpr double undefined = std::numeric_limits<double>::quiet_NaN();

double detectable_by(const Finding& finding)
{
    return finding.conclusive ? finding.detectable : std::numeric_limits<double>::infinity();
}

/// The finding with the smallest detectable error among those of one region and channel, of which
/// findings[first] is the first; none if no such error is defined. It is infinite for a finding that is
/// not conclusive.
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

std::string below_certainty_level(const CompareOptions& options)
{
    return ". A right picture differs so much with a chance below " + say(options.certainty_level, 3);
}

/// The channel with the largest detectable error; none if the golden is black.
std::optional<std::size_t> least_sensitive_channel(const Comparison& comparison)
{
    std::optional<std::size_t> least_sensitive;
    for (std::size_t c = 0; c < channel_count; ++c)
        if (!std::isnan(comparison.detectable[c]) &&
            (!least_sensitive || comparison.detectable[c] > comparison.detectable[*least_sensitive]))
            least_sensitive = c;
    return least_sensitive;
}

/// Why so little is detectable, if that is not just noise: a clause, or nothing.
std::string say_hidden(const Comparison& comparison, std::size_t channel)
{
    const Finding* sharpest = nullptr;
    for (const Finding& finding : comparison.findings)
        if (finding.channel == channel && finding.region.kind == RegionKind::whole &&
            finding.conclusive && !std::isnan(finding.detectable) &&
            (sharpest == nullptr || finding.detectable < sharpest->detectable))
            sharpest = &finding;
    if (sharpest == nullptr || !(sharpest->hidden > 0.5 * sharpest->detectable)) return "";
    return "the pictures have far less noise than the golden, and so few of them may lack bright "
           "samples "
           "that are rare in them; ";
}

/// The error that is found if it is only in the pixels where the least is found: a clause, or nothing.
std::string say_least_sensitive(const Comparison& comparison)
{
    if (!comparison.least_sensitive_stratum) return "";
    const Finding& finding = comparison.findings[*comparison.least_sensitive_stratum];
    const double detectable = detectable_by(finding);
    return "; of " + describe_place(finding) + " alone, " +
           (std::isfinite(detectable) ? "one of " + say_percent(detectable) : "none");
}

} // namespace

void summarise(Comparison& comparison)
{
    const std::vector<Finding>& findings = comparison.findings;
    comparison.detectable.fill(undefined);
    double conclusive = 0.0;
    for (std::size_t i = 0; i < findings.size(); ++i) {
        const Finding& finding = findings[i];
        if (finding.conclusive) {
            conclusive += 1.0;
            // Among equal p-values, which may all be 0 or 1, the largest effect.
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
        if (stratum && (!comparison.least_sensitive_stratum ||
                        detectable > detectable_by(findings[*comparison.least_sensitive_stratum])))
            comparison.least_sensitive_stratum = sharpest;
    }
    comparison.coverage = findings.empty() ? 0.0 : conclusive / static_cast<double>(findings.size());
    if (comparison.suspicion) comparison.p = findings[*comparison.suspicion].adjusted_p;
}

void summarise_reach(Comparison& comparison, const Golden& golden, const CompareOptions& options)
{
    comparison.golden_limit.fill(undefined);
    comparison.shortfall.reset();
    for (std::size_t c = 0; c < channel_count; ++c) {
        Reach best;
        for (const Finding& finding : comparison.findings) {
            if (finding.channel != c || finding.region.kind != RegionKind::whole) continue;
            best.limit = std::fmin(best.limit, finding.reach.limit);
            best.candidate = std::fmin(best.candidate, finding.reach.candidate);
            best.golden = std::fmin(best.golden, finding.reach.golden);
        }
        comparison.golden_limit[c] = best.limit;
        if (!(comparison.detectable[c] > options.specification) || std::isnan(best.limit)) continue;
        const Shortfall found{best.candidate * comparison.candidate_batches,
                              static_cast<double>(golden.functionals.pilot().batches) +
                                  best.golden * static_cast<double>(golden.reference.size())};
        if (!comparison.shortfall) comparison.shortfall = found;
        comparison.shortfall->candidate = std::max(comparison.shortfall->candidate, found.candidate);
        comparison.shortfall->golden = std::max(comparison.shortfall->golden, found.golden);
    }
}

void pass_or_inconclusive(Comparison& comparison, const CompareOptions& options,
                          const std::string& remark)
{
    const auto channel = least_sensitive_channel(comparison);
    const double detectable = channel ? comparison.detectable[*channel] : 0.0;
    const std::string where = channel ? std::string(" in ") + channel_names[*channel] : "";
    if (detectable > options.specification) {
        comparison.verdict = Verdict::inconclusive;
        std::string text = "No difference found, but ";
        text += std::isinf(detectable) ? "no error of the whole picture" + where + " is detectable"
                                       : "only an error of " + say_percent(detectable) +
                                             " of the whole picture" + where + " would have been found";
        text += " (required: " + say_percent(options.specification) +
                "): " + say_hidden(comparison, *channel);
        give_reason(comparison, text + say_shortfall(comparison) + "." + remark);
        return;
    }
    comparison.verdict = Verdict::pass;
    give_reason(comparison, channel ? "No difference found; an error of " + say_percent(detectable) +
                                          " of the whole picture would have been found, with " +
                                          say_percent(options.power) + " probability" +
                                          say_least_sensitive(comparison) + "." + remark
                                    : "Both pictures are black." + remark);
}

void fail(Comparison& comparison, const std::string& how)
{
    comparison.verdict = Verdict::fail;
    give_reason(comparison, "The picture is wrong: " + say_suspicion(comparison) + how + ".");
}

bool decide_at_once(Comparison& comparison, const CompareOptions& options, bool can_render_again)
{
    if (std::any_of(comparison.odd.begin(), comparison.odd.end(),
                    [](const OddPixels& odd) { return odd.wrong; })) {
        comparison.verdict = Verdict::fail;
        give_reason(comparison, comparison.p < options.suspicion_level
                                    ? "Besides, " + say_suspicion(comparison) + "."
                                    : std::string());
        return true;
    }
    if (comparison.p >= options.suspicion_level) {
        pass_or_inconclusive(comparison, options);
        return true;
    }
    const auto certain = [&](const Finding& finding) {
        return finding.conclusive && finding.certain_p < options.certainty_level &&
               !(can_render_again && finding.darker_by_means);
    };
    if (std::ranges::any_of(comparison.findings, certain)) {
        fail(comparison, below_certainty_level(options));
        return true;
    }
    return false;
}

void decide_without(Comparison& comparison, const Comparison& without, const CompareOptions& options)
{
    comparison.false_alarm += options.certainty_level;
    const std::string them = bright_pixels(comparison.odd).size() == 1 ? "it" : "them";
    // Removing bright pixels makes a picture darker, so only a difference to the bright side counts.
    if (without.suspicion && without.findings[*without.suspicion].certain_p < options.certainty_level &&
        without.findings[*without.suspicion].test.z > 0.0) {
        comparison.verdict = Verdict::fail;
        give_reason(comparison, "Without " + them + ", " + say_suspicion(without) +
                                    below_certainty_level(options) + ".");
        return;
    }
    const bool blind = std::any_of(comparison.detectable.begin(), comparison.detectable.end(),
                                   [](double error) { return std::isinf(error); });
    const bool only_they_hinder = without.verdict == Verdict::pass;
    if (!only_they_hinder && (!blind || without.p < options.suspicion_level)) return;
    comparison.shortfall = without.shortfall;
    give_reason(comparison, "Without " + them + ": " + without.reason +
                                " Another picture, with another seed, shows which it is: a rare bright "
                                "sample moves, a defect stays where it is.");
}

} // namespace golden
