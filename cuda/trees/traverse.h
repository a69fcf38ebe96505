#pragma once

// Traverses a tree along a ray: the closest hit (intersect), and whether there is any hit (occluded).

#include "cuda/trees/intersect.h"
#include "cuda/trees/node.h"
#include "cuda/trees/slabs.h"
#include "cuda/trees/traversal_stack.h"
#include "cuda/trees/wide_tree.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

namespace fast {

/// A tree for traversal, at most `deepest_tree` deep. Triangles are in the order of leaves: leaf l
/// holds triangles[l].
struct TreeView {
    std::span<const Node> nodes;
    std::span<const std::uint32_t> primitives; // by leaf: the number of its triangle
    std::span<const Triangle> triangles;       // by leaf
};

/// Kernel over leaves: brings triangles into the order of leaves.
struct OrderTriangles {
    std::span<const Triangle> triangles;
    std::span<const std::uint32_t> primitives;
    std::span<Triangle> ordered;

    HD void operator()(std::uint32_t leaf) const { ordered[leaf] = triangles[primitives[leaf]]; }
};

/// The default counter of nodes: counts nothing.
struct NotCounted {
    HD void operator()() const {}
};

/// Calls test(leaf) for every leaf whose box the ray enters at a t <= limit, the nearer of two
/// children first. `test` returns the new limit: the t of the closest hit so far, or a negative number
/// to stop. In a tree over one primitive the only leaf is always tested. Calls count() for every node.
template <class Test, class Count = NotCounted>
HD void traverse(const TreeView& tree, const Ray& ray, const Test& test, const Count& count = {})
{
    if (tree.nodes.empty()) {
        if (!tree.primitives.empty()) test(0);
        return;
    }
    const Slabs slabs(ray, unite(tree.nodes[0].bounds[0], tree.nodes[0].bounds[1]));
    constexpr float never = std::numeric_limits<float>::infinity();
    float limit = ray.t_max;
    TraversalStack stack;
    std::uint32_t next = 0;
    do {
        if (is_leaf(next)) {
            limit = test(next & ~leaf_bit);
            continue;
        }
        count();
        const Node& node = tree.nodes[next];
        const float entry[2] = {slabs.entry(node.bounds[0], limit), slabs.entry(node.bounds[1], limit)};
        const int nearer = entry[1] < entry[0] ? 1 : 0;
        for (const int side : {1 - nearer, nearer})
            if (entry[side] < never) stack.push(node.children[side], entry[side]);
    } while (stack.pop(limit, next));
}

/// Sorts in ascending order by a network of five exchanges [Knuth 1998, sec. 5.3.4].
HD inline void sort_four(std::uint32_t (&keys)[4])
{
    const auto order = [&](int i, int j) {
        const std::uint32_t smaller = keys[i] < keys[j] ? keys[i] : keys[j];
        const std::uint32_t larger = keys[i] < keys[j] ? keys[j] : keys[i];
        keys[i] = smaller;
        keys[j] = larger;
    };
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
}

/// The same for a wide tree: calls test(group) for groups of triangles.
template <class Test, class Count = NotCounted>
HD void traverse(const WideTreeView& tree, const Ray& ray, const Test& test, const Count& count = {})
{
    if (tree.nodes.empty()) {
        if (!tree.groups.empty()) test(0);
        return;
    }
    const WideSlabs slabs{Slabs(ray, tree.bounds)};
    float limit = ray.t_max;
    TraversalStack stack;
    std::uint32_t next = 0;
    for (;;) {
        if (is_leaf(next)) {
            limit = test(next & ~leaf_bit);
            if (!stack.pop(limit, next)) return;
            continue;
        }
        count();
        const WideNode& node = tree.nodes[next];
        Lanes near;
        Lanes far;
        slabs.entries(node, limit, near, far);
        std::uint32_t keys[4];
        sort_keys(near, far, keys);
        sort_four(keys);
        if (keys[0] == not_ordered) {
            if (!stack.pop(limit, next)) return;
            continue;
        }
        for (int i = 3; i >= 1; --i)
            stack.push_if(keys[i] != not_ordered, node.children[keys[i] & 3],
                          std::bit_cast<float>(keys[i] & ~3u));
        next = node.children[keys[0] & 3];
    }
}

/// The hit of smallest t; of several at the same t, that of the lowest primitive number.
template <class View>
HD Hit intersect(const View& tree, const Ray& ray)
{
    const ShearedRay sheared(ray);
    Hit best{ray.t_max, no_primitive, 0, 0};
    traverse(tree, ray, [&](std::uint32_t leaf) {
        Hit hit{0, tree.primitives[leaf], 0, 0};
        if (intersect_triangle(sheared, tree.triangles[leaf], ray.t_max, hit) && comes_before(hit, best))
            best = hit;
        return best.t;
    });
    return best;
}

/// Whether the ray hits anything.
template <class View>
HD bool occluded(const View& tree, const Ray& ray)
{
    const ShearedRay sheared(ray);
    bool found = false;
    traverse(tree, ray, [&](std::uint32_t leaf) {
        Hit hit{};
        found = found || intersect_triangle(sheared, tree.triangles[leaf], ray.t_max, hit);
        return found ? -1.0f : ray.t_max;
    });
    return found;
}

/// Kernel over rays.
template <class View>
struct IntersectRays {
    View tree;
    std::span<const Ray> rays;
    std::span<Hit> hits;

    HD void operator()(std::uint32_t i) const { hits[i] = intersect(tree, rays[i]); }
};

/// Kernel over rays: 1 where anything is hit, 0 elsewhere.
template <class View>
struct TestOcclusion {
    View tree;
    std::span<const Ray> rays;
    std::span<std::uint8_t> hits;

    HD void operator()(std::uint32_t i) const { hits[i] = occluded(tree, rays[i]) ? 1 : 0; }
};

} // namespace fast
