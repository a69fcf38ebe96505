#pragma once

// The nearest neighbours in a list of clusters, between which the tree builder chooses (hploc.h): for
// one cluster, as a thread of a GPU needs them, and for all clusters of a list, with vectors of floats.
// Both give the same answer.

#include "cuda/parallel/lanes.h"
#include "cuda/trees/aabb.h"

#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

namespace fast {

/// The distance in the list, to both sides, within which the nearest neighbour of a cluster is
/// searched.
constexpr std::uint32_t search_radius = 8;

/// A subtree that has no parent yet. `slot` is the number of its first leaf; slots increase along
/// every list. When two clusters merge, the number of the new node follows from the slot of the
/// second, and the merged cluster keeps the slot of the first. So node numbers are unique and do not
/// depend on the schedule.
struct Cluster {
    Aabb box;
    std::uint32_t root; // as a child (node.h)
    std::uint32_t slot;
    std::uint32_t height; // edges from the root to the deepest leaf
};

/// The first cluster in the list that is a neighbour of cluster i.
HD constexpr std::uint32_t first_neighbour(std::uint32_t i)
{
    return i == 0 ? 1 : i < search_radius ? 0 : i - search_radius;
}

/// The neighbour whose common box with cluster i of `list` (at least two) has the smallest area, where
/// an area of NaN (0 * infinity) counts as infinite. Of several it takes the other half of the pair
/// (2 k, 2 k + 1) that i belongs to, if both boxes are equal, or else the first pair, ordered by both
/// numbers. So the best pair of all is mutual, and every round merges something; and a round merges half
/// of many equal boxes, so that they do not give a long chain of nodes.
HD inline std::uint32_t nearest_cluster(std::span<const Cluster> list, std::uint32_t i)
{
    const auto count = static_cast<std::uint32_t>(list.size());
    const std::uint32_t end = i + search_radius < count ? i + search_radius + 1 : count;
    const Aabb box = list[i].box;
    const std::uint32_t paired = i ^ 1;
    if (paired < count && box.lower == list[paired].box.lower && box.upper == list[paired].box.upper)
        return paired;
    std::uint32_t best = first_neighbour(i);
    float smallest = std::numeric_limits<float>::infinity();
    for (std::uint32_t j = best; j < end; ++j) {
        const float area = half_area(unite(box, list[j].box));
        if (j != i && area < smallest) {
            smallest = area;
            best = j;
        }
    }
    return best;
}

/// nearest_cluster for all clusters of a list of at most `most`: one by one.
template <std::uint32_t most>
class NearestOneByOne {
public:
    HD explicit NearestOneByOne(std::span<const Cluster> list)
    {
        for (std::uint32_t i = 0; i < list.size(); ++i) nearest_[i] = nearest_cluster(list, i);
    }
    [[nodiscard]] HD std::uint32_t operator[](std::uint32_t i) const { return nearest_[i]; }

private:
    std::uint32_t nearest_[most];
};

/// The same for lane_count of them at once; `most` is a multiple of that.
template <std::uint32_t most>
class NearestAtOnce {
public:
    explicit NearestAtOnce(std::span<const Cluster> list)
        : count_(static_cast<std::uint32_t>(list.size()))
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const std::uint32_t end = (count_ + lane_count - 1) / lane_count * lane_count + search_radius;
        for (int axis = 0; axis < 3; ++axis) {
            float* const lower = planes_[axis] + search_radius;
            float* const upper = planes_[3 + axis] + search_radius;
            for (std::uint32_t i = 0; i < count_; ++i) {
                lower[i] = list[i].box.lower[axis];
                upper[i] = list[i].box.upper[axis];
            }
            // Before and behind the list: boxes so large that none of them is the nearest.
            for (std::uint32_t i = 0; i < search_radius; ++i) {
                planes_[axis][i] = -infinity;
                planes_[3 + axis][i] = infinity;
            }
            for (std::uint32_t i = count_; i < end; ++i) {
                lower[i] = -infinity;
                upper[i] = infinity;
            }
        }
        for (std::uint32_t i = 0; i < count_; i += lane_count) search(i);
    }
    [[nodiscard]] std::uint32_t operator[](std::uint32_t i) const { return nearest_[i]; }

private:
    /// Of the clusters first, first + 1, ...
    void search(std::uint32_t first)
    {
        const Lanes box[6] = {plane(0, first), plane(1, first), plane(2, first),
                              plane(3, first), plane(4, first), plane(5, first)};
        Lanes smallest = all_lanes(std::numeric_limits<float>::infinity());
        Lanes best = all_lanes(0.0f); // the distance in the list; 0: none
        const auto compare_with = [&](int distance) {
            const std::uint32_t other = first + static_cast<std::uint32_t>(distance);
            Lanes extent[3];
            for (int axis = 0; axis < 3; ++axis)
                extent[axis] = larger(plane(3 + axis, other), box[3 + axis]) -
                               smaller(plane(axis, other), box[axis]);
            const Lanes area = extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0];
            best = where_below(area, smallest, all_lanes(static_cast<float>(distance)), best);
            smallest = smaller(area, smallest);
        };
        constexpr int radius = search_radius;
        for (int distance = -radius; distance < 0; ++distance) compare_with(distance);
        for (int distance = 1; distance <= radius; ++distance) compare_with(distance);
        LaneBits same_as_next = (1u << lane_count) - 1;
        for (int number = 0; number < 6; ++number)
            same_as_next &= equal(plane(number, first + 1), box[number]);
        for (std::uint32_t lane = 0; lane < lane_count && first + lane < count_; ++lane) {
            const std::uint32_t i = first + lane;
            const bool even = i % 2 == 0;
            if ((same_as_next >> (even ? lane : lane - 1) & 1) != 0 && (i ^ 1) < count_)
                nearest_[i] = i ^ 1;
            else if (const int distance = static_cast<int>(best[static_cast<int>(lane)]); distance != 0)
                nearest_[i] = static_cast<std::uint32_t>(static_cast<int>(i) + distance);
            else
                nearest_[i] = first_neighbour(i);
        }
    }
    /// Plane `number` of the boxes first, first + 1, ...; first may be up to search_radius less than 0.
    [[nodiscard]] Lanes plane(int number, std::uint32_t first) const
    {
        return load_lanes(planes_[number] + (search_radius + first));
    }

    std::uint32_t count_;
    float planes_[6][search_radius + most + search_radius]; // lower x, y, z; upper x, y, z
    std::uint32_t nearest_[most];
};

/// The form for this processor.
template <std::uint32_t most>
using NearestOf = std::conditional_t<lanes_at_once, NearestAtOnce<most>, NearestOneByOne<most>>;

} // namespace fast
