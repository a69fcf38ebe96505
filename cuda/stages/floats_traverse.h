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

namespace fast {

/// A node that no more rays enter is traversed by each of them alone.
constexpr int few_rays = 5 * static_cast<int>(floats_at_once) / 8;

/// In a tree of no more nodes all rays stay together to the end.
constexpr std::size_t small_tree = 16;

/// Calls test(group, here) for every group whose box some rays of `active` enter at a t <= their limit,
/// where `here` are these rays; or alone(node, here) for a node that few rays enter. Both may lower
/// `limit`, and set it below 0 for rays that need no more.
template <class Test, class Alone>
void traverse_together(const WideTreeView& tree, const SlabRayOf<Floats>& rays, const Mask& active,
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
    const SlabsOf<Floats> slabs(rays);
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
            const Mask entered = slabs.entered(node.box(c), limit, near) && here;
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

/// The same rays one by one, as traverse_below and intersect_group need them. They are stored when the
/// first of them is needed.
class SingleRays {
public:
    SingleRays(const RayOf<Floats>& rays, const SlabRayOf<Floats>& slab_rays, const ShearedRays& sheared)
        : rays_(rays), slab_rays_(slab_rays), sheared_(sheared)
    {}
    struct One {
        Ray ray;
        ShearedRay sheared;
        WideSlabs slabs;
    };
    One operator[](int lane)
    {
        if (!stored_) store();
        return {stored_rays_[lane], ShearedRay(shears_[lane]), WideSlabs(stored_slab_rays_[lane])};
    }

private:
    void store()
    {
        stored_rays_ = rays_;
        stored_slab_rays_ = slab_rays_;
        shears_ = sheared_.shears();
        stored_ = true;
    }

    const RayOf<Floats>& rays_;
    const SlabRayOf<Floats>& slab_rays_;
    const ShearedRays& sheared_;
    bool stored_ = false;
    StoredLanes<RayOf<Floats>> stored_rays_;
    StoredLanes<SlabRayOf<Floats>> stored_slab_rays_;
    StoredLanes<ShearOf<Floats>> shears_;
};

} // namespace fast
