// Several pictures of unknown noise.

#include "golden/compare.h"
#include "golden/verdict.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace golden {

namespace {

Comparison judge_pictures(const Golden& golden, std::span<const images::Image> pictures,
                          const std::vector<std::size_t>& without, const CompareOptions& options)
{
    Candidate candidate(golden.functionals);
    for (const images::Image& picture : pictures)
        candidate.add_batch(without.empty() ? picture : replaced(picture, without, golden.mean));
    return compare(golden, candidate, Method::welch, options);
}

/// Adds oddities that are wrong in a single picture and hidden in the mean of all. Returns whether there
/// are any.
bool look_at_each(Comparison& comparison, const Golden& golden, std::span<const images::Image> pictures)
{
    bool added = false;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        for (OddPixels& found : odd_pixels(golden, pictures[i], 0.0, 0.0)) {
            const bool known =
                std::any_of(comparison.odd.begin(), comparison.odd.end(), [&](const OddPixels& other) {
                    return other.wrong && other.kind == found.kind;
                });
            if (!found.wrong || known) continue;
            found.picture = i + 1;
            comparison.odd.insert(comparison.odd.begin(), std::move(found));
            added = true;
        }
    return added;
}

} // namespace

Comparison compare_pictures(const Golden& golden, std::span<const images::Image> pictures,
                            const CompareOptions& options)
{
    Comparison comparison = judge_pictures(golden, pictures, {}, options);
    if (look_at_each(comparison, golden, pictures)) decide_at_once(comparison, options);
    const auto bright = bright_pixels(comparison.odd);
    if (comparison.verdict == Verdict::inconclusive && !bright.empty())
        decide_without(comparison, judge_pictures(golden, pictures, bright, options), options);
    return comparison;
}

} // namespace golden
