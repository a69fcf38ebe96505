#pragma once

// A ray's way through a tree, and the two questions that it answers: what is hit first, and is anything
// hit?

#include "cuda/trees/intersect.h"
#include "cuda/trees/node.h"
#include "cuda/trees/slabs.h"
#include "cuda/trees/wide_tree.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

namespace gpu {

/// What rays need of a tree, which may be `deepest_tree` deep. Triangles are in the order of leaves: a
/// leaf's number is its triangle's.
struct TreeView {
    std::span<const Node> nodes;
    std::span<const std::uint32_t> primitives; // by leaf: which primitive its triangle is
    std::span<const Triangle> triangles;       // by leaf
};

/// Kernel over leaves: brings triangles into their order.
struct OrderTriangles {
    std::span<const Triangle> triangles;
    std::span<const std::uint32_t> primitives;
    std::span<Triangle> ordered;

    HD void operator()(std::uint32_t leaf) const { ordered[leaf] = triangles[primitives[leaf]]; }
};

/// Nodes and leaves that a ray has yet to visit, and where it would enter them.
class Waiting {
public:
    HD void push(std::uint32_t child, float entry)
    {
        children_[height_] = child;
        entries_[height_] = entry;
        ++height_;
    }
    HD void push_if(bool wanted, std::uint32_t child, float entry)
    {
        children_[height_] = child;
        entries_[height_] = entry;
        height_ += wanted ? 1 : 0;
    }
    /// Takes the latest one that begins at t <= limit away, and those above; false if there is none.
    /// What begins at the very limit counts: it may hold a primitive of lower number at the same t.
    HD bool pop(float limit, std::uint32_t& child)
    {
        while (height_ > 0) {
            --height_;
            child = children_[height_];
            if (entries_[height_] <= limit) return true;
        }
        return false;
    }

private:
    // A step down a tree leaves one child waiting; one down a wide tree three, and it may be a step to a
    // child that the narrow tree has no deeper, while its sibling has been opened twice.
    static constexpr int most = 3 * deepest_tree + 4;
    std::uint32_t children_[most];
    float entries_[most];
    int height_ = 0;
};

/// For those who do not count nodes.
struct NotCounted {
    HD void operator()() const {}
};

/// Calls test(leaf) for every leaf whose box the ray enters at a t <= limit, of two children the nearer
/// one first. `test` returns the limit from then on: the t of the closest hit so far, or a negative
/// number to stop. Of a tree over one primitive the only leaf is tested in any case. Calls count() for
/// every node.
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
    Waiting waiting;
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
            if (entry[side] < never) waiting.push(node.children[side], entry[side]);
    } while (waiting.pop(limit, next));
}

/// In five steps, whatever they are.
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

/// The same by way of wide nodes: calls test(group).
template <class Test, class Count = NotCounted>
HD void traverse(const WideTreeView& tree, const Ray& ray, const Test& test, const Count& count = {})
{
    if (tree.nodes.empty()) {
        if (!tree.groups.empty()) test(0);
        return;
    }
    const WideSlabs slabs{Slabs(ray, tree.bounds)};
    float limit = ray.t_max;
    Waiting waiting;
    std::uint32_t next = 0;
    for (;;) {
        if (is_leaf(next)) {
            limit = test(next & ~leaf_bit);
            if (!waiting.pop(limit, next)) return;
            continue;
        }
        count();
        const WideNode& node = tree.nodes[next];
        Lanes near;
        Lanes far;
        slabs.entries(node, limit, near, far);
        std::uint32_t keys[4];
        sortable(near, far, keys);
        sort_four(keys);
        if (keys[0] == not_ordered) {
            if (!waiting.pop(limit, next)) return;
            continue;
        }
        for (int i = 3; i >= 1; --i)
            waiting.push_if(keys[i] != not_ordered, node.children[keys[i] & 3],
                            std::bit_cast<float>(keys[i] & ~3u));
        next = node.children[keys[0] & 3];
    }
}

/// The hit of smallest t; of several at the same t, that of the lowest primitive number.
template <class View>
HD Hit closest_hit(const View& tree, const Ray& ray)
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
HD bool any_hit(const View& tree, const Ray& ray)
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
struct FindClosestHits {
    View tree;
    std::span<const Ray> rays;
    std::span<Hit> hits;

    HD void operator()(std::uint32_t i) const { hits[i] = closest_hit(tree, rays[i]); }
};

/// Kernel over rays: 1 where anything is hit, 0 elsewhere.
template <class View>
struct FindAnyHits {
    View tree;
    std::span<const Ray> rays;
    std::span<std::uint8_t> hits;

    HD void operator()(std::uint32_t i) const { hits[i] = any_hit(tree, rays[i]) ? 1 : 0; }
};

} // namespace gpu
