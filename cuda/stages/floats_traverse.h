#pragma once

// Traverses a wide tree along many rays together: every node and triangle that some of them need is
// tested for all. That is worth while as long as several rays need it: near the root, in a small tree,
// or if the rays are coherent. Where few rays are left, each goes on alone [Benthin, Wald, Woop, Ernst,
// Mark 2012]. The queries (floats_trace_rays.h) give the same bits as for single rays.

#include "cuda/stages/floats_triangle.h"
#include "cuda/trees/rounding.h"
#include "cuda/trees/surfaces.h"

#include <array>
#include <bit>
#include <optional>

namespace fast {

/// A node that no more rays enter is traversed by each of them alone.
constexpr int few_rays = 3 * static_cast<int>(floats_at_once) / 8;

/// In a tree of no more nodes all rays stay together to the end.
constexpr std::size_t small_tree = 16;

/// The test of many rays against a box: Slabs of cuda/trees/slabs.h, ray by ray.
class SlabsOfRays {
public:
    SlabsOfRays(const RayOf<Floats>& rays, const Aabb& root)
    {
        const Vec3Of<Floats> below = magnitude_of(Vec3Of<Floats>(root.lower) - rays.origin);
        const Vec3Of<Floats> above = magnitude_of(Vec3Of<Floats>(root.upper) - rays.origin);
        Floats m = 0.0f;
        for (int axis = 0; axis < 3; ++axis) m = greater(m, greater(below[axis], above[axis]));
        for (int axis = 0; axis < 3; ++axis) {
            const Floats origin = rays.origin[axis];
            const Floats padding = unit_roundoff * (64.0f * m + 2.0f * magnitude_of(origin));
            reciprocal_[axis] = 1.0f / rays.direction[axis];
            descends_[axis] = reciprocal_[axis] < 0.0f;
            entering_[axis] = select(descends_[axis], origin - padding, origin + padding);
            leaving_[axis] = select(descends_[axis], origin + padding, origin - padding);
        }
    }
    /// Where the rays are in box c of `node` at a t from 0 to `limit`; `near`: the smallest such t.
    [[nodiscard]] Mask entered(const WideNode& node, int c, const Floats& limit, Floats& near) const
    {
        near = 0.0f;
        Floats far = limit;
        for (int axis = 0; axis < 3; ++axis) {
            const Floats lower(node.planes[axis][c]);
            const Floats upper(node.planes[3 + axis][c]);
            const Floats enter =
                (select(descends_[axis], upper, lower) - entering_[axis]) * reciprocal_[axis];
            const Floats leave =
                (select(descends_[axis], lower, upper) - leaving_[axis]) * reciprocal_[axis];
            // In the plane of a face 0 * infinity is NaN, which these comparisons ignore.
            near = select(enter > near, enter, near);
            far = select(leave < far, leave, far);
        }
        return near <= far;
    }

private:
    Floats reciprocal_[3], entering_[3], leaving_[3];
    Mask descends_[3];
};

/// Calls test(group, here) for every group whose box some rays of `active` enter at a t <= their limit,
/// where `here` are these rays; or alone(node, here) for a node that few rays enter. Both may lower
/// `limit`, and set it below 0 for rays that need no more.
template <class Test, class Alone>
void traverse_together(const WideTreeView& tree, const RayOf<Floats>& rays, const Mask& active,
                       const Floats& limit, const Test& test, const Alone& alone)
{
    if (tree.nodes.empty()) {
        if (!tree.groups.empty()) test(0, active);
        return;
    }
    struct Waiting {
        Floats near; // infinity for rays that do not enter
        std::uint32_t child;
    };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const int few = tree.nodes.size() > small_tree ? few_rays : 0;
    const SlabsOfRays slabs(rays, tree.bounds);
    std::array<Waiting, TraversalStack::most> stack;
    std::size_t height = 0;
    stack[height++] = {select(active, Floats(0.0f), Floats(infinity)), 0};
    while (height > 0) {
        const Waiting& top = stack[--height];
        const std::uint32_t child = top.child;
        const Mask here = top.near <= limit && top.near < infinity;
        const std::uint32_t bits = bits_of(here);
        if (bits == 0) continue;
        if (std::popcount(bits) <= few && !is_leaf(child)) {
            alone(child, bits);
            continue;
        }
        if (is_leaf(child)) {
            test(child & ~leaf_bit, here);
            continue;
        }
        const WideNode& node = tree.nodes[child];
        const int first_ray = std::countr_zero(bits);
        std::array<float, most_children> order; // of the children pushed: where the first ray enters
        const std::size_t bottom = height;
        for (int c = 0; c < most_children && node.children[c] != no_node; ++c) {
            Floats near;
            const Mask entered = slabs.entered(node, c, limit, near) && here;
            if (none(entered)) continue;
            near = select(entered, near, Floats(infinity));
            const float key = lane_of(near, first_ray);
            // Sorted by insertion: the nearest child is on top.
            std::size_t place = height++;
            for (; place > bottom && order[place - 1 - bottom] < key; --place) {
                order[place - bottom] = order[place - 1 - bottom];
                stack[place] = stack[place - 1];
            }
            order[place - bottom] = key;
            stack[place] = {near, node.children[c]};
        }
    }
}

/// What traverse_below needs of single rays, computed for those rays that need it.
class SingleRays {
public:
    SingleRays(const RayOf<Floats>& rays, const Aabb& root) : rays_(rays), root_(root) {}

    struct One {
        Ray ray;
        ShearedRay sheared;
        WideSlabs slabs;
    };
    const One& operator[](int lane)
    {
        std::optional<One>& one = ones_[static_cast<std::size_t>(lane)];
        if (!one) {
            const Ray ray = lane_of(rays_, lane);
            one = One{ray, ShearedRay(ray), WideSlabs{Slabs(ray, root_)}};
        }
        return *one;
    }

private:
    const RayOf<Floats>& rays_;
    const Aabb& root_;
    std::array<std::optional<One>, floats_at_once> ones_;
};

} // namespace fast
