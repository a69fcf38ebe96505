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
constexpr int few_rays = 3 * static_cast<int>(floats_at_once) / 4;

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
        const std::size_t bottom = height;
        std::size_t nearest = bottom; // of the children pushed, the one that the first ray enters first
        float least = infinity;
        for (int c = 0; c < most_children && node.children[c] != no_node; ++c) {
            Floats near;
            const Mask entered = slabs.entered(node.box(c), limit, near) && here;
            near = select(entered, near, Floats(infinity));
            stack[height] = {near, node.children[c]};
            const float key = lane_of(near, first_ray);
            nearest = key < least ? height : nearest;
            least = key < least ? key : least;
            height += any(entered) ? 1 : 0;
        }
        if (height > bottom) std::swap(stack[nearest], stack[height - 1]);
    }
}

/// Vectors in memory, for code that reads single lanes.
class StoredVectors {
public:
    void operator=(const Vec3Of<Floats>& v)
    {
        x_ = v.x;
        y_ = v.y;
        z_ = v.z;
    }
    [[nodiscard]] Vec3 operator[](int lane) const { return {x_[lane], y_[lane], z_[lane]}; }

private:
    StoredLanes<Floats> x_, y_, z_;
};

/// Many rays in memory, for the test of one of them against all boxes of a wide node at once: the same
/// as WideSlabs, but nothing is copied per ray.
class StoredSlabs {
public:
    void operator=(const SlabRayOf<Floats>& rays)
    {
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const Floats& reciprocal = rays.reciprocal[static_cast<int>(axis)];
            const Mask descends = reciprocal < 0.0f;
            reciprocal_[axis] = reciprocal;
            entering_[axis] = rays.entering[static_cast<int>(axis)];
            leaving_[axis] = rays.leaving[static_cast<int>(axis)];
            first_[axis] = select(descends, Words(3 + axis), Words(axis));
            last_[axis] = select(descends, Words(axis), Words(3 + axis));
        }
    }
    /// As WideSlabs::entered, of the ray in `lane`.
    [[nodiscard]] LaneBits entered(int lane, const WideNode& node, float limit, Lanes& near) const
    {
        return boxes_entered({enter(lane, node, 0), enter(lane, node, 1), enter(lane, node, 2)},
                             {leave(lane, node, 0), leave(lane, node, 1), leave(lane, node, 2)}, limit,
                             near);
    }

private:
    [[nodiscard]] Lanes enter(int lane, const WideNode& node, int axis) const
    {
        return multiply_add(node.planes[first_[axis][lane]], all_lanes(reciprocal_[axis][lane]),
                            all_lanes(entering_[axis][lane]));
    }
    [[nodiscard]] Lanes leave(int lane, const WideNode& node, int axis) const
    {
        return multiply_add(node.planes[last_[axis][lane]], all_lanes(reciprocal_[axis][lane]),
                            all_lanes(leaving_[axis][lane]));
    }

    StoredLanes<Floats> reciprocal_[3];
    StoredLanes<Floats> entering_[3];
    StoredLanes<Floats> leaving_[3];
    StoredLanes<Words> first_[3]; // the plane by which the ray enters a box
    StoredLanes<Words> last_[3];
};

/// One of them, in place of WideSlabs.
struct OneOfSlabs {
    const StoredSlabs& all;
    int lane;

    [[nodiscard]] LaneBits entered(const WideNode& node, float limit, Lanes& near) const
    {
        return all.entered(lane, node, limit, near);
    }
};

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
        OneOfSlabs slabs;
    };
    One operator[](int lane)
    {
        if (!stored_) store();
        return {{origins_[lane], t_max_[lane], directions_[lane]},
                ShearedRay({kz_[lane], sheared_origins_[lane], factors_[lane]}),
                {slabs_, lane}};
    }

private:
    void store()
    {
        origins_ = rays_.origin;
        directions_ = rays_.direction;
        t_max_ = rays_.t_max;
        slabs_ = slab_rays_;
        const ShearOf<Floats> shears = sheared_.shears();
        kz_ = shears.kz;
        sheared_origins_ = shears.origin;
        factors_ = shears.factors;
        stored_ = true;
    }

    const RayOf<Floats>& rays_;
    const SlabRayOf<Floats>& slab_rays_;
    const ShearedRays& sheared_;
    bool stored_ = false;
    StoredVectors origins_, directions_, sheared_origins_, factors_;
    StoredLanes<Floats> t_max_;
    StoredLanes<Words> kz_;
    StoredSlabs slabs_;
};

} // namespace fast
