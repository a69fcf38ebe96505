#pragma once

// Pictures of parts of a scene's light, with their noise.

#include "check/mistakes/path_mistakes.h"
#include "images/film.h"
#include "images/renderer.h"

#include <cstdint>
#include <vector>

namespace check {

/// One picture for each part of Mistakes, all from the same samples, by the reference.
class PartPictures {
public:
    /// `options`: of the renders; max_edges is that of the longest path that a part has. `world`, of the
    /// size of the pictures, and `parts` must outlive it.
    PartPictures(const ref::World& world, const ref::PathOptions& options,
                 const std::vector<PathFactor>& parts, std::uint32_t samples_per_batch,
                 unsigned threads);

    /// Adds batches until there are `batches`. False if monitor.stop returned true; then those of the
    /// last round are lost. The pictures do not depend on the threads. Throws what the renderer throws.
    bool render(std::uint64_t batches, const images::Monitor& monitor = {});

    [[nodiscard]] std::uint64_t batches() const { return films_.front().batches(); }
    /// Per part, in their order: the mean over the batches, and its standard error.
    [[nodiscard]] const images::Film& of(std::size_t part) const { return films_.at(part); }

private:
    /// One picture per part.
    [[nodiscard]] std::vector<images::Image> batch(std::uint64_t number,
                                                   const images::Monitor& monitor) const;

    const ref::World& world_;
    ref::PathOptions options_;
    const std::vector<PathFactor>& parts_;
    std::uint32_t samples_;
    unsigned threads_;
    std::vector<images::Film> films_;
};

} // namespace check
