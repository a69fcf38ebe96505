#include "check/mistakes/explanations.h"

#include "check/mistakes/fit_roulette.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace check {

namespace {

using images::Image;

ref::PathOptions with_one_edge_more(ref::PathOptions options)
{
    ++options.max_edges;
    return options;
}

std::uint32_t samples_per_pixel(int width, int height, const ExplanationBudget& budget)
{
    const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (pixels > most_explained_pixels)
        throw std::invalid_argument("pictures of more than " + std::to_string(most_explained_pixels) +
                                    " pixels are too large to look for mistakes of light transport");
    return static_cast<std::uint32_t>((budget.batch_samples + pixels - 1) / pixels);
}

/// Those that `only` names, with the parts that they need.
Mistakes chosen(Mistakes all, const std::optional<SomeMistakes>& only)
{
    if (!only) return all;
    std::erase_if(all.mistakes, [&](const Mistake& mistake) {
        return std::ranges::find(only->is, mistake.is) == only->is.end();
    });
    if (!only->roulette) all.roulettes.clear();
    std::map<std::size_t, std::size_t> numbers; // of the parts, new by old
    std::vector<PathFactor> parts;
    const auto keep = [&](std::size_t& part) {
        const auto [number, is_new] = numbers.try_emplace(part, parts.size());
        if (is_new) parts.push_back(all.parts[part]);
        part = number->second;
    };
    for (Mistake& mistake : all.mistakes)
        for (PartOfMistake& adds : mistake.adds) keep(adds.part);
    for (RouletteMistake& roulette : all.roulettes) {
        for (PartOfMistake& adds : roulette.adds) keep(adds.part);
        for (RouletteMistake::Decisions& decisions : roulette.decisions) keep(decisions.part);
    }
    all.parts = std::move(parts);
    return all;
}

} // namespace

SceneExplanations::SceneExplanations(const scenes::Scene& scene, int width, int height,
                                     ref::PathOptions options, unsigned threads,
                                     const ExplanationBudget& budget,
                                     const std::optional<SomeMistakes>& only)
    : budget_(budget), world_(scene, width, height),
      mistakes_(chosen(usual_mistakes(scene, options.max_edges), only)),
      pictures_(world_, with_one_edge_more(options), mistakes_.parts,
                samples_per_pixel(width, height, budget), threads)
{}

std::uint64_t SceneExplanations::next_batches() const
{
    const std::uint64_t now = pictures_.batches();
    return now == 0 ? budget_.first_batches : std::min(2 * now, budget_.most_batches);
}

bool SceneExplanations::render(const images::Monitor& monitor)
{
    return pictures_.batches() < budget_.most_batches && pictures_.render(next_batches(), monitor);
}

std::vector<golden::Explanation> SceneExplanations::explanations(const Image& mean,
                                                                 const Image& golden) const
{
    std::vector<golden::Explanation> all;
    for (const Mistake& mistake : mistakes_.mistakes) all.push_back(explanation(mistake));
    if (mistakes_.roulettes.empty()) return all;
    all.push_back(explanation(best_roulette(mistakes_.roulettes, pictures_, mean, golden)));
    all.back().fitted = true;
    return all;
}

golden::Explanation SceneExplanations::explanation(const Mistake& mistake) const
{
    const images::Film& first = pictures_.of(mistake.adds.front().part);
    const Image none(first.width(), first.height());
    golden::Explanation result{mistake.is, none, none, static_cast<double>(first.batches())};
    for (const auto& [part, times] : mistake.adds) {
        const images::Film& film = pictures_.of(part);
        const images::BatchMoments moments = film.moments();
        const Image error = images::standard_error(moments, film.batches());
        for (std::size_t i = 0; i < none.pixels.size(); ++i) {
            result.adds.pixels[i] += times * moments.mean.pixels[i];
            // The parts are of the same paths: their errors may all have the same sign.
            result.error.pixels[i] += std::abs(times) * error.pixels[i];
        }
    }
    return result;
}

} // namespace check
