// A single picture of unknown noise.

#include "golden/compare.h"
#include "golden/verdict.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace golden {

namespace {

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
    for (std::size_t c = 0; c < 3; ++c)
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
    comparison.false_alarm = options.convict;
    comparison.stages.push_back({static_cast<std::uint64_t>(std::llround(std::max(1.0, batches))),
                                 comparison.p, options.accuse});
    if (decide_at_once(comparison, options)) return comparison;
    comparison.verdict = Verdict::inconclusive;
    comparison.reason = "Suspicious: " + say_suspicion(comparison) +
                        ". A second, independent picture must confirm or clear it.";
    return comparison;
}

} // namespace golden
