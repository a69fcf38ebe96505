#pragma once

// The primitives in the order of a Morton curve: bounds of the centroids, codes, sort. The stages are
// launched one after the other on an executor, and no stage needs a result on the host. So on a device
// they can be queued at once, or captured in a graph.

#include "cuda/parallel/buffer.h"
#include "cuda/parallel/reduce.h"
#include "cuda/parallel/sorted_pairs.h"
#include "cuda/trees/check_input.h"
#include "cuda/trees/morton.h"
#include "cuda/trees/node.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>

namespace fast {

/// The parts of a build of a radix tree, in their order (lbvh.h).
enum class Stage { bounds, codes, sort, tree, refit };
constexpr std::array<const char*, 5> stage_names = {"bounds", "codes", "sort", "tree", "refit"};

/// A sorted order, and all memory that is needed to find it: sorting again allocates nothing. `Code` is
/// std::uint32_t for codes of 30 bits or std::uint64_t for 63.
template <class Code>
class MortonOrder {
public:
    /// For up to `capacity` primitives, at most most_primitives, in the memory that the kernels of
    /// `executor` access. Throws OutOfMemory, and std::invalid_argument for a larger capacity.
    template <Executor E>
    MortonOrder(Memory& memory, const E& executor, std::uint32_t capacity)
        : pairs_(memory, executor, checked(capacity), code_bits<Code>), centroid_bounds_(memory, 1),
          centroid_bounds_scratch_(memory,
                                   reduce_scratch(executor, capacity, BoundCentroid{},
                                                  UniteCentroidBounds{}, empty_centroid_bounds()))
    {}

    /// Queues the sort of `boxes`, which must not change until it is done. A second one may be queued
    /// only on the same executor, after the first. `finished(stage)` is called as soon as a stage is
    /// queued: bounds, codes, sort. Throws std::length_error for more boxes than the capacity.
    ///
    /// Boxes that are empty or not finite are not legal. With such boxes the sort ends, the order is
    /// undefined, and first_rejected() gives the lowest number of such a box.
    template <Executor E, std::invocable<Stage> Finished>
    void build(E& executor, std::span<const Aabb> boxes, const Finished& finished)
    {
        if (boxes.size() > pairs_.capacity())
            throw std::length_error("a tree over " + std::to_string(boxes.size()) +
                                    " primitives does not fit where there is room for " +
                                    std::to_string(pairs_.capacity()));
        const auto count = static_cast<std::uint32_t>(boxes.size());

        map_reduce(executor, count, BoundCentroid{boxes}, UniteCentroidBounds{}, empty_centroid_bounds(),
                   centroid_bounds_scratch_.all(), centroid_bounds_.all());
        finished(Stage::bounds);

        executor(count,
                 ComputeMortonCodes<Code>{boxes, centroid_bounds_.all(), pairs_.keys().first(count),
                                          pairs_.values().first(count)});
        finished(Stage::codes);

        pairs_.sort(executor, count);
        finished(Stage::sort);
    }
    template <Executor E>
    void build(E& executor, std::span<const Aabb> boxes)
    {
        build(executor, boxes, [](Stage) {});
    }

    // Results of the last build that was queued, in the memory of its kernels; valid once it is done.
    [[nodiscard]] std::span<const std::uint32_t> primitives() const { return pairs_.sorted_values(); }
    [[nodiscard]] std::span<const Code> codes() const
    {
        return pairs_.sorted_keys();
    } // in the order of leaves

    /// Waits for the build. The lowest number of a primitive whose box is not legal, or no_primitive.
    [[nodiscard]] std::uint32_t first_rejected() const
    {
        return centroid_bounds_.read(1)[0].first_rejected;
    }

private:
    static std::uint32_t checked(std::uint32_t capacity)
    {
        if (capacity > most_primitives)
            throw std::invalid_argument("a tree may have " + std::to_string(most_primitives) +
                                        " primitives, not " + std::to_string(capacity));
        return capacity;
    }

    SortedPairs<Code> pairs_; // codes with primitives
    Buffer<CentroidBounds> centroid_bounds_;
    Buffer<CentroidBounds> centroid_bounds_scratch_;
};

} // namespace fast
