#include "golden/explain.h"

#include "golden/judge.h"
#include "golden/pixel_noise.h"
#include "golden/reason.h"
#include "golden/scatter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace golden {

namespace {

using images::Image;
using images::Rgb;

/// Of one look at one explanation. The right one is lost with at most this chance in each look.
constexpr double rejection_level = 2e-4;
/// Below it no further test of the explanation is made.
constexpr double clear_level = 1e-12;
constexpr std::size_t most_named = 3;

Image without(const Image& picture, const Image& added)
{
    Image result = picture;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) result.pixels[i] -= added.pixels[i];
    return result;
}

/// The noise that the explanation adds to a functional. Pixels are taken as independent.
MeanEstimate noise_of(const Golden& golden, const Explanation& explanation, std::size_t functional,
                      std::size_t channel)
{
    const Functionals& functionals = golden.functionals;
    const Region& region = functionals.regions()[functionals.at(functional).region];
    const auto c = static_cast<int>(channel);
    double variance = 0.0;
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(golden.mean.width) +
                           static_cast<std::size_t>(x);
            const double error =
                functionals.pixel_weight(functional, channel, i) * explanation.error.pixels[i][c];
            variance += error * error;
        }
    return {0.0, variance, std::max(1.0, explanation.batches - 1.0)};
}

/// A functional of the candidate, and |skewness| / sqrt(n) of its noise.
struct Estimate {
    MeanEstimate value;
    double skewed;
    double scatter = 0.0; // Fit::scatter
};

/// Of a single picture, as compare_picture assumes its noise; `extra`: variance that it has besides.
Estimate estimate_of_picture(const Golden& golden, const Image& picture, double value,
                             const Moments& reference, double batches, double extra,
                             std::size_t functional, std::size_t channel)
{
    Estimate estimate{{value, reference.variance / batches + extra, reference.count - 1.0},
                      std::abs(reference.skewness) / std::sqrt(batches),
                      0.0};
    const Scatter shown = scatter(golden, picture, functional, channel);
    estimate.scatter = shown.variance + shown.golden;
    if (!(shown.variance > estimate.value.variance)) return estimate;
    const double share = shown.variance / (shown.variance + shown.golden);
    estimate.value.variance = shown.variance;
    estimate.value.degrees = std::max(1.0, (shown.blocks - 1.0) * share * share);
    estimate.skewed =
        std::max(estimate.skewed, std::abs(shown.blocks_skewness) / std::sqrt(shown.blocks));
    return estimate;
}

/// Of several pictures, each less the same explanation with its `noise`.
Estimate estimate_of_pictures(const std::vector<double>& values, const PixelNoise& pixels,
                              const Moments& reference, const MeanEstimate& noise)
{
    const Moments shown = moments(values);
    const MeanEstimate mean = moderated(shown, pixels);
    return {{mean.mean, mean.variance + noise.variance, welch_degrees(mean, noise)},
            mean_skewness(shown, pixels, reference),
            0.0};
}

/// The pictures, to which explanations are fitted.
class Fitting {
public:
    Fitting(const Golden& golden, const std::vector<Image>& pictures, double samples,
            const CompareOptions& options)
        : golden_(golden), pictures_(pictures), batches_(samples / batch_size_of(golden)),
          single_(pictures.size() == 1),
          judge_(golden, single_ ? Method::picture : Method::welch, options)
    {
        Candidate candidate(golden.functionals);
        if (!single_)
            for (const Image& picture : pictures) candidate.add_batch(picture);
        for (std::size_t f = 0; f < golden.functionals.size(); ++f)
            for (std::size_t c = 0; c < channel_count; ++c) {
                references_.push_back(moments(values_of(golden.reference, golden.functionals, f, c)));
                const bool needed = !single_ && judge_.can_test(f);
                pixels_.push_back(needed ? pixel_noise(candidate, f, c) : PixelNoise{});
            }
    }

    [[nodiscard]] Fit fit(const Explanation& explanation) const
    {
        const Functionals& functionals = golden_.functionals;
        std::vector<Image> undone;
        std::vector<Row> rows;
        for (const Image& picture : pictures_) {
            undone.push_back(without(picture, explanation.adds));
            rows.push_back(functionals.evaluate(undone.back()));
        }
        Fit result;
        std::array<double, channel_count> detectable{};
        detectable.fill(std::numeric_limits<double>::infinity());
        for (std::size_t f = 0; f < functionals.size(); ++f)
            for (std::size_t c = 0; c < channel_count; ++c) {
                if (!judge_.can_test(f)) continue;
                const Moments& reference = references_[f * channel_count + c];
                const Estimate estimate = estimated(undone.front(), rows, explanation, f, c);
                if (f == 0) result.scatter[c] = estimate.scatter;
                const auto p = judge_.adjusted_p(estimate.value, estimate.skewed, reference, f, c);
                if (!p) continue;
                result.p = std::min(result.p, *p);
                if (result.p < clear_level) return result;
                if (functionals.regions()[functionals.at(f).region].kind != RegionKind::whole) continue;
                const double found = judge_.compared(estimate.value, f, c).detectable;
                // Where the golden is black nothing can be wrong by a factor.
                detectable[c] = std::isnan(found) ? 0.0 : std::min(detectable[c], found);
            }
        result.detectable = *std::max_element(detectable.begin(), detectable.end());
        return result;
    }

private:
    [[nodiscard]] Estimate estimated(const Image& undone, const std::vector<Row>& rows,
                                     const Explanation& explanation, std::size_t functional,
                                     std::size_t channel) const
    {
        const MeanEstimate noise = noise_of(golden_, explanation, functional, channel);
        const std::vector<double> values = values_of(rows, golden_.functionals, functional, channel);
        const std::size_t at = functional * channel_count + channel;
        if (!single_) return estimate_of_pictures(values, pixels_[at], references_[at], noise);
        return estimate_of_picture(golden_, undone, values.front(), references_[at], batches_,
                                   noise.variance, functional, channel);
    }

    const Golden& golden_;
    const std::vector<Image>& pictures_;
    double batches_; // of a single picture
    bool single_;
    Judge judge_;
    std::vector<Moments> references_; // per functional, then channel
    std::vector<PixelNoise> pixels_;  // the same, of several pictures
};

/// The largest relative difference of the whole picture among the channels.
double difference(const Golden& golden, const std::vector<Image>& pictures)
{
    Rgb sum(0.0);
    Rgb expected(0.0);
    for (const Image& picture : pictures)
        for (const Rgb& pixel : picture.pixels) sum += pixel / static_cast<double>(pictures.size());
    for (const Rgb& pixel : golden.mean.pixels) expected += pixel;
    double largest = 0.0;
    for (int c = 0; c < 3; ++c)
        if (expected[c] > 0.0) largest = std::max(largest, std::abs(sum[c] / expected[c] - 1.0));
    return largest;
}

bool is_black(const Image& image)
{
    return std::all_of(image.pixels.begin(), image.pixels.end(),
                       [](const Rgb& pixel) { return pixel == Rgb(0.0); });
}

/// Whether two sums of the same samples differ by no more than rounding.
bool same(const Image& a, const Image& b)
{
    constexpr double rounding = 1e-9;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            if (!(std::abs(a.pixels[i][c] - b.pixels[i][c]) <=
                  rounding * (std::abs(a.pixels[i][c]) + std::abs(b.pixels[i][c]))))
                return false;
    return true;
}

struct Standing {
    bool alive = true;
    bool fits = false;
    Fit fit = {};
    std::optional<std::size_t> same_as = {}; // an earlier explanation that makes the same picture
};

/// Mistakes that change nothing here are dropped, and of several that make the same picture the first is
/// kept.
std::vector<Standing> standings_of(const std::vector<Explanation>& explanations)
{
    std::vector<Standing> standings(explanations.size());
    for (std::size_t i = 0; i < explanations.size(); ++i) {
        if (is_black(explanations[i].adds)) standings[i].alive = false;
        for (std::size_t j = 0; j < i && standings[i].alive; ++j)
            if (standings[j].alive && same(explanations[i].adds, explanations[j].adds)) {
                standings[i].alive = false;
                standings[i].same_as = j;
            }
    }
    return standings;
}

/// An explanation that leaves far more scatter than one that fits is wrong: what it leaves is structure,
/// which the tests of a single picture take for noise.
void dismiss(const std::vector<Explanation>& explanations, std::vector<Standing>& standings)
{
    constexpr double far_more = 2.0;
    for (const bool fitted : {false, true}) {
        std::array<double, channel_count> least{};
        least.fill(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < standings.size(); ++i)
            for (std::size_t c = 0; c < channel_count; ++c)
                if (standings[i].fits && (fitted || !explanations[i].fitted))
                    least[c] = std::min(least[c], standings[i].fit.scatter[c]);
        for (Standing& standing : standings)
            for (std::size_t c = 0; c < channel_count; ++c)
                if (standing.fit.scatter[c] > far_more * least[c])
                    standing.alive = standing.fits = false;
    }
}

std::size_t count(const std::vector<Explanation>& explanations, const std::vector<Standing>& standings,
                  bool fitted, bool Standing::*state)
{
    std::size_t found = 0;
    for (std::size_t i = 0; i < standings.size(); ++i)
        if (explanations[i].fitted == fitted && standings[i].*state) ++found;
    return found;
}

std::string sentence(const std::vector<Explanation>& explanations,
                     const std::vector<Standing>& standings, const std::vector<std::size_t>& named,
                     const CompareOptions& options)
{
    std::string text = "Your picture is ";
    double detectable = 0.0;
    for (const std::size_t i : named) {
        if (i != named.front()) text += i == named.back() ? ", or " : ", ";
        text += explanations[i].is;
        detectable = std::max(detectable, standings[i].fit.detectable);
    }
    text += named.size() == 1 ? ": with this undone, " : ": with either undone, ";
    text += detectable <= options.specification
                ? "it PASSes."
                : "no difference is left; an error of " + say_percent(detectable) +
                      " of the whole picture would have been found.";
    std::string others;
    for (std::size_t i = 0; i < explanations.size(); ++i)
        if (named.size() == 1 && standings[i].same_as == named.front())
            others += (others.empty() ? "" : ", or ") + explanations[i].is;
    return others.empty() ? text : text + " It would be the same if it were " + others + ".";
}

} // namespace

Fit fit(const Golden& golden, const std::vector<Image>& pictures, double samples,
        const Explanation& explanation, const CompareOptions& options)
{
    return Fitting(golden, pictures, samples, options).fit(explanation);
}

std::string explain(const Golden& golden, const std::vector<Image>& pictures, double samples,
                    const MoreExplanations& more, const CompareOptions& options)
{
    constexpr double part_of_difference = 0.125;
    const double enough =
        std::max(options.specification, part_of_difference * difference(golden, pictures));
    CompareOptions looks = options;
    looks.suspicion_level = rejection_level;
    const Fitting fitting(golden, pictures, samples, looks);
    std::vector<Standing> standings;
    std::vector<Explanation> last;
    for (;;) {
        std::vector<Explanation> explanations = more();
        if (explanations.empty()) break;
        last = std::move(explanations);
        if (standings.empty()) standings = standings_of(last);
        for (std::size_t i = 0; i < last.size(); ++i) {
            Standing& standing = standings[i];
            if (!standing.alive) continue;
            standing.fit = fitting.fit(last[i]);
            standing.alive = standing.fit.p >= rejection_level;
            standing.fits = standing.alive && standing.fit.detectable <= enough;
        }
        dismiss(last, standings);
        const bool any_fits = count(last, standings, false, &Standing::fits) > 0;
        const bool undecided = count(last, standings, false, &Standing::fits) <
                               count(last, standings, false, &Standing::alive);
        const bool fitted_undecided = count(last, standings, true, &Standing::fits) <
                                      count(last, standings, true, &Standing::alive);
        if (!undecided && (any_fits || !fitted_undecided)) break;
    }
    for (const bool fitted : {false, true}) {
        std::vector<std::size_t> named;
        for (std::size_t i = 0; i < standings.size(); ++i)
            if (standings[i].alive && last[i].fitted == fitted) named.push_back(i);
        if (named.empty()) continue;
        const bool all_fit = count(last, standings, fitted, &Standing::fits) == named.size();
        return all_fit && named.size() <= most_named ? sentence(last, standings, named, options) : "";
    }
    return "";
}

} // namespace golden
