#pragma once

// The options that all renderers of this project have. Plain data: kernels may include it.

#include <cstdint>
#include <limits>

namespace images {

enum class Integrator {
    path, // emission hits and next events, weighted against each other alone
    bdpt, // all strategies
    light // light image alone, with weight 1
};

/// The weights of strategies that can make the same path [Veach 1997, sec. 9.2].
enum class Heuristic {
    balance, // in proportion to their densities
    power,   // in proportion to the squares of their densities
    /// A warning example, of the reference only: 1 / (i + j + 1) for i eye and j light vertices after
    /// the first, as in a course report of 2015. The k strategies s = 1 ... k of a path of k edges count
    /// 1 / k each, whether they can make the path or not, and s = 0 counts only for k = 1, and then
    /// alone. Unbiased only where all of s = 1 ... k can make the path, as in a room of diffuse walls.
    /// Light by way of mirrors and glass is too dim (docs/bdpt.md).
    uniform
};

/// Whether a batch also holds a picture of each strategy (s, t). Weighted, each path counts with its
/// weight, and the pictures add up to the mean; unweighted, each is the picture of its strategy with
/// weight 1.
enum class StrategyPictures { none, weighted, unweighted };

/// A set of families of strategies (ref/transport/connect.h): those that are true.
struct Families {
    bool emission_hit = true;
    bool next_event = true;
    bool light_image = true;
    bool inner_connection = true;
    constexpr bool operator==(const Families&) const = default;
};

inline constexpr int unlimited_edges = std::numeric_limits<int>::max();

/// With pictures of strategies: there are more than 150 of them, and each must fit in memory.
inline constexpr int most_edges_of_strategies = 16;

struct RenderOptions {
    Integrator integrator = Integrator::bdpt;
    Heuristic heuristic = Heuristic::balance; // of bidirectional path tracing
    std::uint64_t seed = 0;
    int max_edges = unlimited_edges; // of a path, the camera's included; at least 1
    bool roulette = true;            // unbiased either way; with none, max_edges must bound the paths
    /// The first bounce of a walk that roulette may end, at least 1. Of the reference only; the fast
    /// path has the default.
    int roulette_from = 5;
    std::uint32_t batch_size = 4; // samples per pixel of a batch
    /// With pictures, max_edges is at most most_edges_of_strategies.
    StrategyPictures strategies = StrategyPictures::none;
    /// Those that contribute. The weights are those of all families, so a picture lacks exactly the
    /// weighted contributions of the families that are left out. Of the reference only.
    Families families = {};
    bool deterministic = false; // the same bits every time, even if that takes more time and memory
};

} // namespace images
