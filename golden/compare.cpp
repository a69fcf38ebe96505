#include "golden/compare.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>

namespace golden {

namespace {

constexpr std::size_t channels = 3;
constexpr std::array<const char*, channels> channel_names = {"red", "green", "blue"};
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

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

/// One functional of several batches, in its own units.
std::vector<double> values_of(const std::vector<Row>& rows, const Functionals& functionals,
                              std::size_t functional, std::size_t channel)
{
    const double expected = functionals.expected(functional, channel);
    const double spread = functionals.spread(functional, channel);
    const std::size_t at = channel * functionals.size() + functional;
    std::vector<double> values;
    values.reserve(rows.size());
    for (const Row& row : rows) values.push_back(expected + spread * static_cast<double>(row[at]));
    return values;
}

/// How many tests share the chance of a false alarm, seen from one of them: each channel, each family
/// (kind of region and weight) and each member of a family gets an equal share of what is above it.
class Multiplicity {
public:
    Multiplicity(const Functionals& functionals, Method method)
    {
        for (const Region& region : functionals.regions()) members_[region.kind] += 1.0;
        const double weights_used = method == Method::ranks ? 3.0 : 2.0;
        families_ = static_cast<double>(members_.size()) * weights_used;
    }
    [[nodiscard]] double of(RegionKind kind) const
    {
        return static_cast<double>(channels) * families_ * members_.at(kind);
    }

private:
    std::map<RegionKind, double> members_;
    double families_ = 0.0;
};

/// What one functional of the candidate is compared with, and the comparison.
class Judge {
public:
    Judge(const Golden& golden, Method method, const CompareOptions& options)
        : golden_(golden), functionals_(golden.functionals), method_(method), options_(options),
          multiplicity_(functionals_, method)
    {}

    [[nodiscard]] bool looks_at(std::size_t functional) const
    {
        return method_ == Method::ranks || is_linear(functionals_.at(functional).weight);
    }

    [[nodiscard]] Finding judge(const std::vector<Row>& rows, std::size_t functional,
                                std::size_t channel) const
    {
        Finding finding = blank(functional, channel);
        std::vector<double> ours = values_of(rows, functionals_, functional, channel);
        std::vector<double> theirs = values_of(golden_.reference, functionals_, functional, channel);
        const Moments candidate = moments(ours);
        const Moments reference = moments(theirs);
        const double tolerance = options_.rounding * std::abs(reference.mean);
        const double level = options_.accuse / multiplicity_.of(finding.region.kind);
        if (method_ == Method::ranks) {
            std::sort(ours.begin(), ours.end());
            std::sort(theirs.begin(), theirs.end());
            finding.test = mann_whitney_beyond(ours, theirs, tolerance);
            if (is_linear(finding.weight) && reference.mean > 0.0)
                finding.detectable = detectable_scale(theirs, candidate.count, level, options_.power);
        } else {
            const double skewed = std::max(std::abs(candidate.skewness) / std::sqrt(candidate.count),
                                           std::abs(reference.skewness) / std::sqrt(reference.count));
            finding.conclusive = skewed <= options_.skewness;
            compare_means(finding, mean_estimate(candidate), mean_estimate(reference), level);
        }
        if (candidate.count >= 2.0 && reference.count >= 2.0)
            set_ratio(finding, mean_estimate(candidate), mean_estimate(reference));
        adjust(finding);
        return finding;
    }

    /// For a single picture: its own estimate of the functional instead of batches.
    [[nodiscard]] Finding judge(const MeanEstimate& candidate, double skewed, std::size_t functional,
                                std::size_t channel) const
    {
        Finding finding = blank(functional, channel);
        const Moments reference =
            moments(values_of(golden_.reference, functionals_, functional, channel));
        const double level = options_.accuse / multiplicity_.of(finding.region.kind);
        finding.conclusive = std::max(skewed, std::abs(reference.skewness) /
                                                  std::sqrt(reference.count)) <= options_.skewness;
        compare_means(finding, candidate, mean_estimate(reference), level);
        set_ratio(finding, candidate, mean_estimate(reference));
        adjust(finding);
        return finding;
    }

private:
    [[nodiscard]] Finding blank(std::size_t functional, std::size_t channel) const
    {
        const Functional f = functionals_.at(functional);
        return {functionals_.regions()[f.region],
                f.weight,
                functional,
                channel,
                true,
                {},
                1.0,
                nan,
                {nan, nan},
                nan};
    }

    void compare_means(Finding& finding, const MeanEstimate& candidate, const MeanEstimate& reference,
                       double level) const
    {
        finding.test = welch(candidate, reference, options_.rounding * std::abs(reference.mean));
        if (finding.conclusive && reference.mean > 0.0)
            finding.detectable =
                detectable_difference(std::sqrt(candidate.variance + reference.variance),
                                      welch_degrees(candidate, reference), level, options_.power) /
                reference.mean;
    }

    void set_ratio(Finding& finding, const MeanEstimate& candidate, const MeanEstimate& reference) const
    {
        if (reference.mean == 0.0) return;
        finding.ratio = candidate.mean / reference.mean;
        finding.interval = ratio_interval(candidate, reference, options_.confidence);
    }

    void adjust(Finding& finding) const
    {
        if (finding.conclusive)
            finding.adjusted_p = bonferroni(finding.test.p, multiplicity_.of(finding.region.kind));
    }

    const Golden& golden_;
    const Functionals& functionals_;
    Method method_;
    const CompareOptions& options_;
    Multiplicity multiplicity_;
};

/// What can be seen in a region: the better of its linear weights.
double detectable_in(const std::vector<Finding>& findings, std::size_t first)
{
    double best = std::numeric_limits<double>::infinity();
    bool defined = false;
    for (std::size_t i = first; i < findings.size(); ++i) {
        const Finding& finding = findings[i];
        if (finding.channel != findings[first].channel ||
            finding.functional / weights.size() != findings[first].functional / weights.size())
            break;
        if (std::isnan(finding.detectable) && finding.conclusive) continue;
        defined = true;
        if (finding.conclusive) best = std::min(best, finding.detectable);
    }
    return defined ? best : nan;
}

void summarise(Comparison& comparison)
{
    const std::vector<Finding>& findings = comparison.findings;
    comparison.detectable.fill(nan);
    double conclusive = 0.0;
    double blindest = 0.0;
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
        const double detectable = detectable_in(findings, i);
        if (finding.region.kind == RegionKind::whole)
            comparison.detectable[finding.channel] = detectable;
        const bool stratum =
            finding.region.kind == RegionKind::luminance || finding.region.kind == RegionKind::noise;
        if (stratum && detectable > blindest) {
            blindest = detectable;
            comparison.blindest_stratum = i;
        }
    }
    comparison.coverage = findings.empty() ? 0.0 : conclusive / static_cast<double>(findings.size());
    if (comparison.suspicion) comparison.p = findings[*comparison.suspicion].adjusted_p;
}

/// The channel in which least can be seen; none if the golden is black.
std::optional<std::size_t> blindest_channel(const Comparison& comparison)
{
    std::optional<std::size_t> blindest;
    for (std::size_t c = 0; c < channels; ++c)
        if (!std::isnan(comparison.detectable[c]) &&
            (!blindest || comparison.detectable[c] > comparison.detectable[*blindest]))
            blindest = c;
    return blindest;
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

/// The verdict of a comparison that accuses no one: was it able to?
void acquit(Comparison& comparison, const CompareOptions& options, const std::string& remark = "")
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

/// The verdict on the first stage if it is already certain; false if the suspicion needs another look.
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

Comparison first_stage(const Golden& golden, const Candidate& candidate, Method method,
                       const CompareOptions& options)
{
    if (method == Method::picture)
        throw std::invalid_argument("a single picture is compared by compare_picture");
    if (candidate.batches() < 1 || (method == Method::welch && candidate.batches() < 2))
        throw std::invalid_argument(
            method == Method::ranks ? "there is no picture to compare"
                                    : "comparing with another estimator needs two independent pictures "
                                      "at least, or one and its number of samples");
    if (method == Method::welch && golden.reference.size() < 2)
        throw std::invalid_argument("the golden has one batch after its pilot: too few");
    Comparison comparison;
    comparison.method = method;
    comparison.golden_batches = golden.reference.size();
    const Judge judge(golden, method, options);
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t f = 0; f < golden.functionals.size(); ++f)
            if (judge.looks_at(f)) comparison.findings.push_back(judge.judge(candidate.rows(), f, c));
    summarise(comparison);
    comparison.stages.push_back({candidate.batches(), comparison.p, options.accuse});
    return comparison;
}

double number_in(const Metadata& metadata, const std::string& key)
{
    const auto found = metadata.find(key);
    double number = 0.0;
    if (found != metadata.end())
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), number);
    if (!(number > 0.0)) throw std::invalid_argument("the golden does not say its " + key);
    return number;
}

/// The variance of a linear functional of a picture as its own pixels tell it: the picture's difference
/// from the golden, summed over small blocks, would vary from block to block by noise alone. Blocks, as
/// reconstruction filters make neighbouring pixels depend on each other.
Moments scatter(const Golden& golden, const Image& picture, std::size_t functional, std::size_t channel)
{
    const Functionals& functionals = golden.functionals;
    const Region& region = functionals.regions()[functionals.at(functional).region];
    const int side = std::clamp(std::max(picture.width, picture.height) / 32, 1, 4);
    std::vector<double> blocks;
    for (int y0 = region.y0; y0 < region.y1; y0 += side)
        for (int x0 = region.x0; x0 < region.x1; x0 += side) {
            double sum = 0.0;
            bool inside = false;
            for (int y = y0; y < std::min(y0 + side, region.y1); ++y)
                for (int x = x0; x < std::min(x0 + side, region.x1); ++x) {
                    const auto i =
                        static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                        static_cast<std::size_t>(x);
                    const double weight = functionals.pixel_weight(functional, channel, i);
                    const auto c = static_cast<int>(channel);
                    if (weight == 0.0) continue;
                    inside = true;
                    sum += weight * (picture.pixels[i][c] - golden.mean.pixels[i][c]);
                }
            if (inside) blocks.push_back(sum);
        }
    return moments(blocks);
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

std::string describe(Method method)
{
    switch (method) {
    case Method::ranks:
        return "same estimator, batch by batch (Mann-Whitney)";
    case Method::welch:
        return "another estimator, several pictures (Welch's t)";
    case Method::picture:
        return "a single picture, its noise assumed (Welch's t)";
    }
    return "";
}

std::string describe(const Finding& finding)
{
    return std::string(channel_names[finding.channel]) + " of " + describe(finding.region) + " (" +
           describe(finding.weight) + ")";
}

Candidate::Candidate(const Functionals& functionals)
    : functionals_(&functionals), film_(functionals.width(), functionals.height())
{}

void Candidate::add_batch(const Image& batch)
{
    rows_.push_back(functionals_->evaluate(batch));
    film_.add_batch(batch);
}

const Finding& whole_picture(const Comparison& comparison, std::size_t channel)
{
    const auto found =
        std::find_if(comparison.findings.begin(), comparison.findings.end(), [&](const Finding& f) {
            return f.channel == channel && f.region.kind == RegionKind::whole &&
                   f.weight == Weight::plain;
        });
    if (found == comparison.findings.end()) throw std::invalid_argument("no such channel");
    return *found;
}

TileMap tile_map(const Comparison& comparison, std::size_t channel)
{
    TileMap map;
    for (const Finding& f : comparison.findings) {
        if (f.channel != channel || f.region.kind != RegionKind::fine_tile ||
            f.weight != Weight::matched)
            continue;
        if (f.region.y0 == 0) ++map.columns;
        map.z.push_back(f.conclusive ? f.test.z : nan);
    }
    if (map.columns > 0) map.rows = static_cast<int>(map.z.size()) / map.columns;
    return map;
}

void check_comparable(const Golden& golden, const Metadata& candidate, Method method)
{
    const auto both_say = [&](const std::string& key) {
        return golden.metadata.contains(key) && candidate.contains(key);
    };
    const auto demand_equal = [&](const std::string& key, const std::string& name) {
        if (both_say(key) && golden.metadata.at(key) != candidate.at(key))
            throw std::invalid_argument("its " + name + " is " + candidate.at(key) +
                                        ", the golden's is " + golden.metadata.at(key));
    };
    demand_equal("scene_hash", "scene's hash");
    demand_equal("camera", "camera");
    demand_equal("max_edges", "greatest path length");
    if (method != Method::ranks) return;
    for (const char* key : {"batch_size", "integrator", "heuristic", "roulette"}) demand_equal(key, key);
    if (both_say("seed") && golden.metadata.at("seed") == candidate.at("seed"))
        throw std::invalid_argument("has the golden's own seed, " + candidate.at("seed") +
                                    ": the two are not independent");
}

Comparison compare(const Golden& golden, const Candidate& candidate, Method method,
                   const CompareOptions& options)
{
    Comparison comparison = first_stage(golden, candidate, method, options);
    if (decide_at_once(comparison, options)) return comparison;
    comparison.verdict = Verdict::inconclusive;
    comparison.reason = "Suspicious: " + say_suspicion(comparison) + ". One right picture in " +
                        say(1.0 / options.accuse, 3) +
                        " looks so: a fresh render must confirm or clear it.";
    return comparison;
}

Comparison compare(const Golden& golden, const RenderStage& render, Method method,
                   const CompareOptions& options)
{
    if (options.stages.empty()) throw std::invalid_argument("there is no stage to render");
    Candidate first(golden.functionals);
    render(0, options.stages[0], first);
    Comparison comparison = first_stage(golden, first, method, options);
    if (decide_at_once(comparison, options)) return comparison;

    const Finding suspicion = comparison.findings[*comparison.suspicion];
    const Judge judge(golden, method, options);
    for (std::size_t stage = 1; stage < options.stages.size(); ++stage) {
        Candidate fresh(golden.functionals);
        render(stage, options.stages[stage], fresh);
        const Finding again = judge.judge(fresh.rows(), suspicion.functional, suspicion.channel);
        const double p = again.conclusive ? one_sided(again.test, suspicion.test.z) : 1.0;
        comparison.stages.push_back({fresh.batches(), p, options.confirm});
        if (p >= options.confirm) {
            acquit(comparison, options,
                   " (" + say_suspicion(comparison) +
                       "; a fresh render did not confirm it, p = " + say(p, 2) + ".)");
            return comparison;
        }
    }
    if (comparison.stages.size() == 1)
        comparison.reason = "Suspicious: " + say_suspicion(comparison) + ", and no stage to confirm it.";
    else
        convict(comparison, "; confirmed on a fresh render, p = " + say(comparison.stages.back().p, 2));
    return comparison;
}

Comparison compare_picture(const Golden& golden, const Image& picture, double samples,
                           const CompareOptions& options)
{
    if (!(samples > 0.0)) throw std::invalid_argument("the number of samples must be positive");
    if (golden.reference.size() < 2)
        throw std::invalid_argument("the golden has one batch after its pilot: too few");
    const Functionals& functionals = golden.functionals;
    const std::vector<Row> row = {functionals.evaluate(picture)};
    const double batches = samples / number_in(golden.metadata, "batch_size");
    Comparison comparison;
    comparison.method = Method::picture;
    comparison.golden_batches = golden.reference.size();
    const Judge judge(golden, Method::picture, options);
    for (std::size_t c = 0; c < channels; ++c)
        for (std::size_t f = 0; f < functionals.size(); ++f) {
            if (!judge.looks_at(f)) continue;
            const Moments reference = moments(values_of(golden.reference, functionals, f, c));
            MeanEstimate estimate{values_of(row, functionals, f, c)[0], reference.variance / batches,
                                  reference.count - 1.0};
            double skewed = std::abs(reference.skewness) / std::sqrt(batches);
            const Moments blocks = scatter(golden, picture, f, c);
            const double shown = blocks.variance * blocks.count;
            const Functional functional = functionals.at(f);
            if (functional.region == 0 && functional.weight == Weight::matched &&
                estimate.variance > 0.0)
                comparison.noise_ratio =
                    std::max(comparison.noise_ratio.value_or(0.0), shown / estimate.variance);
            if (shown > estimate.variance) {
                estimate.variance = shown;
                estimate.degrees = blocks.count - 1.0;
                skewed = std::max(skewed, std::abs(blocks.skewness) / std::sqrt(blocks.count));
            }
            comparison.findings.push_back(judge.judge(estimate, skewed, f, c));
        }
    summarise(comparison);
    comparison.stages.push_back({static_cast<std::uint64_t>(std::llround(std::max(1.0, batches))),
                                 comparison.p, options.accuse});
    if (decide_at_once(comparison, options)) return comparison;
    comparison.verdict = Verdict::inconclusive;
    comparison.reason = "Suspicious: " + say_suspicion(comparison) +
                        ". A second, independent picture must confirm or clear it.";
    return comparison;
}

} // namespace golden
