#pragma once

// The paths of a right renderer, each with the share that every strategy has in it. What a wrong
// renderer makes of the same path follows from these shares (path_mistakes.h).

#include "ref/transport/mis_weight.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace check {

/// A path x_0 ... x_k from an emitter to the eye.
struct FinishedPath {
    const ref::World& world;
    const ref::Path& x;
    std::vector<bool> possible; // of s = 0 ... k: whether the strategy (s, k + 1 - s) can make the path
    /// p_s / p_j of the strategy j that made the path: the densities of all strategies in one unit.
    std::vector<double> density;

    [[nodiscard]] std::size_t edges() const { return x.size() - 1; }
    /// The weight of strategy s by the balance heuristic among all strategies.
    [[nodiscard]] double share(std::size_t s) const { return share_of[s]; }
    std::vector<double> share_of;
};

/// The path with its shares; `s`: of the strategy that made it. `x` must outlive it.
FinishedPath finished(const ref::World& world, const ref::PathOptions& options, const ref::Path& x,
                      std::size_t s);

/// Receives a path, the pixel that sees it, and its light: value times weight, as the reference adds it
/// to a picture (W m^-2 sr^-1).
using UsePath =
    std::function<void(const FinishedPath& path, std::uint32_t pixel, const ref::Rgb& light)>;

/// Calls `use` for all paths of one sample of bidirectional path tracing: those of
/// ref::trace_bidirectionally with the same options, of which all families must be present.
void for_each_path(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id,
                   const UsePath& use);

} // namespace check
