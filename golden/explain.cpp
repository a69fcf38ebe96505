#include "golden/explain.h"

#include "golden/reason.h"

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
constexpr std::size_t most_named = 3;

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

/// All that make the picture of one of `named`, which are among them.
std::vector<std::string> names_of(const std::vector<Explanation>& explanations,
                                  const std::vector<Standing>& standings,
                                  const std::vector<std::size_t>& named)
{
    std::vector<std::string> names;
    for (std::size_t i = 0; i < explanations.size(); ++i) {
        const std::size_t shown = standings[i].same_as.value_or(i);
        if (std::ranges::find(named, shown) != named.end()) names.push_back(explanations[i].is);
    }
    return names;
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

FoundMistake find_mistake(const Golden& golden, const std::vector<Image>& pictures, double samples,
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
        if (!all_fit || named.size() > most_named) return {};
        return {sentence(last, standings, named, options), names_of(last, standings, named), fitted};
    }
    return {};
}

std::string explain(const Golden& golden, const std::vector<Image>& pictures, double samples,
                    const MoreExplanations& more, const CompareOptions& options)
{
    return find_mistake(golden, pictures, samples, more, options).sentence;
}

} // namespace golden
