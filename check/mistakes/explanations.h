#pragma once

// Explanations of a picture by renders of the golden's scene: the usual mistakes of light transport.

#include "check/mistakes/part_pictures.h"
#include "golden/explain.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace check {

/// How much is rendered: a batch has at least this many samples, so that a small picture has more of
/// them per pixel, and the first look comes after `first_batches`. Every further look has twice as many
/// batches.
struct ExplanationBudget {
    std::uint32_t batch_samples = 1 << 13;
    std::uint64_t first_batches = 16;
    std::uint64_t most_batches = 512;
};

/// Pictures that are larger than this need too much memory for a picture of each mistake.
inline constexpr std::size_t most_explained_pixels = std::size_t{1} << 18;

/// Some of the usual mistakes.
struct SomeMistakes {
    std::vector<std::string> is; // Mistake::is
    bool roulette = false;       // roulette that is not compensated, wherever it is
};

/// The mistakes of usual_mistakes, with less noise after each call of `render`.
class SceneExplanations {
public:
    /// `options`: those of the golden, with another seed. `scene` must outlive it. `only`: the mistakes
    /// of interest; by default all. Throws
    /// std::invalid_argument for pictures of more than most_explained_pixels and the errors of
    /// ref::World.
    SceneExplanations(const scenes::Scene& scene, int width, int height, ref::PathOptions options,
                      unsigned threads, const ExplanationBudget& budget = {},
                      const std::optional<SomeMistakes>& only = {});

    /// Whether the scene can have none of the mistakes that `only` names. Nothing can be rendered then.
    [[nodiscard]] bool empty() const { return mistakes_.parts.empty(); }

    /// Renders more. False if the budget is spent or `monitor` stopped it.
    bool render(const images::Monitor& monitor = {});

    /// By what was rendered so far. `mean`: the picture that is to be explained, for mistakes with a
    /// parameter that is fitted to it.
    [[nodiscard]] std::vector<golden::Explanation> explanations(const images::Image& mean,
                                                                const images::Image& golden) const;

    /// The batches that there are after the next call of `render`.
    [[nodiscard]] std::uint64_t next_batches() const;

private:
    [[nodiscard]] golden::Explanation explanation(const Mistake& mistake) const;

    ExplanationBudget budget_;
    ref::World world_;
    Mistakes mistakes_;
    PartPictures pictures_;
};

} // namespace check
