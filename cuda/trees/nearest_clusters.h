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

/// The other half of the pair (2 k, 2 k + 1) that cluster i of a list of `count`, at least two, belongs
/// to; its neighbour before it if there is none.
HD constexpr std::uint32_t partner(std::uint32_t i, std::uint32_t count)
{
    return (i ^ 1) < count ? i ^ 1 : i - 1;
}

/// The neighbour whose common box with cluster i of `list` (at least two) has the smallest area. Areas
/// that are infinite or NaN (0 * infinity) do not count; if there is no other, the partner is nearest.
///
/// Among pairs of equal area the order is: by the distance in the list; those whose first number is even
/// before the others; by the first number. That is a total order of pairs, so the first pair of all is
/// mutual, and every round merges something. And a round merges half of many equal boxes, or of many
/// boxes that follow each other at equal distances, so that they do not give a long chain of nodes.
HD inline std::uint32_t nearest_cluster(std::span<const Cluster> list, std::uint32_t i)
{
    const auto count = static_cast<std::uint32_t>(list.size());
    std::uint32_t best = partner(i, count);
    float least = std::numeric_limits<float>::infinity();
    const auto compare = [&](std::uint32_t first, std::uint32_t second) {
        const float area = half_area(unite(list[first].box, list[second].box));
        if (!(area < least)) return;
        least = area;
        best = first == i ? second : first;
    };
    for (std::uint32_t distance = 1; distance <= search_radius; ++distance) {
        const bool behind_first = i % 2 == 0 && distance % 2 == 1;
        if (behind_first && i + distance < count) compare(i, i + distance);
        if (distance <= i) compare(i - distance, i);
        if (!behind_first && i + distance < count) compare(i, i + distance);
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

/// The same for lane_count of them at once; `most` is a multiple of that. The area of a pair is computed
/// once, for both of its clusters.
template <std::uint32_t most>
class NearestAtOnce {
    static_assert(most % lane_count == 0 && search_radius == lane_count);

public:
    explicit NearestAtOnce(std::span<const Cluster> list)
        : count_(static_cast<std::uint32_t>(list.size()))
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        for (std::uint32_t i = 0; i < count_; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                planes_[axis][i] = list[i].box.lower[axis];
                planes_[3 + axis][i] = list[i].box.upper[axis];
            }
        // Behind the list: boxes so large that none of them is the nearest.
        const std::uint32_t end = (count_ + lane_count - 1) / lane_count * lane_count + search_radius;
        for (std::uint32_t i = count_; i < end; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                planes_[axis][i] = -infinity;
                planes_[3 + axis][i] = infinity;
            }
        for (auto& areas : areas_) store_lanes(all_lanes(infinity), areas); // before the list
        for (std::uint32_t i = 0; i < count_; i += lane_count) compute_areas(i);
        for (std::uint32_t i = 0; i < count_; i += lane_count) choose(i);
    }
    [[nodiscard]] std::uint32_t operator[](std::uint32_t i) const
    {
        const int step = static_cast<int>(steps_[i]);
        return step == 0 ? partner(i, count_) : i + static_cast<std::uint32_t>(step);
    }

private:
    /// Of the pairs (i, i + distance) for i = first, first + 1, ... and all distances.
    void compute_areas(std::uint32_t first)
    {
        const Lanes box[6] = {plane(0, first), plane(1, first), plane(2, first),
                              plane(3, first), plane(4, first), plane(5, first)};
        for (std::uint32_t distance = 1; distance <= search_radius; ++distance) {
            Lanes extent[3];
            for (int axis = 0; axis < 3; ++axis)
                extent[axis] = larger(plane(3 + axis, first + distance), box[3 + axis]) -
                               smaller(plane(axis, first + distance), box[axis]);
            store_lanes(extent[0] * extent[1] + extent[1] * extent[2] + extent[2] * extent[0],
                        area_of(first, distance));
        }
    }
    /// The nearest of first, first + 1, ...
    void choose(std::uint32_t first)
    {
        constexpr float preferred[lane_count] = {0.5f, 0, 0.5f, 0, 0.5f, 0, 0.5f, 0};
        struct Nearest {
            Lanes area = all_lanes(std::numeric_limits<float>::infinity());
            Lanes distance = all_lanes(0.0f);
        } before, behind;
        for (std::uint32_t distance = 1; distance <= search_radius; ++distance) {
            const Lanes far = all_lanes(static_cast<float>(distance));
            // Half a place nearer where this pair goes before the one of the same distance on the other
            // side.
            const Lanes far_behind = distance % 2 == 1 ? far - load_lanes(preferred) : far;
            const Lanes area = load_lanes(area_of(first, distance));
            behind.distance = where_below(area, behind.area, far_behind, behind.distance);
            behind.area = smaller(area, behind.area);
            const Lanes area_before = load_lanes(area_of(first, distance) - distance);
            before.distance = where_below(area_before, before.area, far, before.distance);
            before.area = smaller(area_before, before.area);
        }
        const Lanes step_behind = behind.distance + all_lanes(0.5f); // read without the fraction
        const Lanes step_before = -before.distance;
        const Lanes if_equal = where_below(behind.distance, before.distance, step_behind, step_before);
        store_lanes(where_below(behind.area, before.area, step_behind,
                                where_below(before.area, behind.area, step_before, if_equal)),
                    steps_ + first);
    }
    /// Of the pair (i, i + distance).
    [[nodiscard]] float* area_of(std::uint32_t i, std::uint32_t distance)
    {
        return areas_[distance - 1] + (search_radius + i);
    }
    /// Plane `number` of the boxes first, first + 1, ...
    [[nodiscard]] Lanes plane(int number, std::uint32_t first) const
    {
        return load_lanes(planes_[number] + first);
    }

    std::uint32_t count_;
    float planes_[6][most + search_radius];            // lower x, y, z; upper x, y, z
    float areas_[search_radius][search_radius + most]; // infinite for the pairs (-8, ...) to (-1, ...)
    float steps_[most];                                // to the nearest in the list; 0: there is none
};

/// The form for this processor.
template <std::uint32_t most>
using NearestOf = std::conditional_t<lanes_at_once, NearestAtOnce<most>, NearestOneByOne<most>>;

} // namespace fast
