#pragma once

// The picture of every strategy (s, t) by itself: what each contributes, or what each would show alone.

#include "images/image.h"
#include "ref/transport/world.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ref {

/// Strategies have s >= 0, t >= 1 and at most this many edges: one picture each must fit in memory.
inline constexpr int most_edges_of_layers = 16;

/// One picture for each strategy of at most `max_edges` edges.
class StrategyLayers {
public:
    /// `weighted`: each path counts with its weight, and the layers add up to the picture. Otherwise
    /// each layer is what its strategy would show if it were the only one. 1 <= max_edges <=
    /// most_edges_of_layers; throws std::invalid_argument.
    StrategyLayers(int width, int height, int max_edges, bool weighted);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }

    /// Layers of the same kind that hold nothing yet.
    [[nodiscard]] StrategyLayers empty_copy() const { return {width_, height_, max_edges_, weighted_}; }
    /// Adds one contribution to its strategy's sum.
    void add(const Contribution& contribution);
    /// Adds the sums in `batch`, over `samples` samples per pixel.
    void add_batch(const StrategyLayers& batch, std::uint32_t samples);

    /// The mean pictures so far, by (s, t), of those strategies that found anything at all.
    [[nodiscard]] std::map<std::pair<int, int>, images::Image> means() const;

private:
    int width_;
    int height_;
    int max_edges_;
    bool weighted_;
    std::uint64_t samples_ = 0;
    std::vector<images::Image> sums_; // strategy (s, t) at index_of(s, t)
};

/// The name of a strategy's layer in a picture file: "s2t3".
inline std::string layer_name(int s, int t)
{
    return "s" + std::to_string(s) + "t" + std::to_string(t);
}

} // namespace ref
