#pragma once

// A better tree over the same sorted keys. Clusters of neighbours along the curve are merged pair by
// pair during a walk up the radix tree; the pairs with the smallest common box are merged first
// [Benthin et al. 2024; Meister and Bittner 2018 for the merging].
//
// The walks are one launch without a transfer to the host, with one thread per walk, as in the refit.
// Each node of the radix tree passes its clusters to its parent, at most `most_handed_on` of them. The
// second of two siblings to arrive joins both lists, and merges clusters if there are too many.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/buffer.h"
#include "cuda/parallel/executor.h"
#include "cuda/trees/lbvh.h"
#include "cuda/trees/nearest_clusters.h"

#include <cstdint>
#include <span>

namespace fast {

/// The most clusters that a node passes to its parent: half a warp in the paper.
constexpr std::uint32_t most_handed_on = 16;

/// The node that has no parent, and the height of the tree.
struct Top {
    std::uint32_t root;
    std::uint32_t height;
};

/// A list of clusters: clusters[first] to clusters[first + count - 1].
struct ClusterList {
    std::uint32_t first;
    std::uint32_t count;
};

/// Kernel over leaves: makes each a cluster. This could be the first step of the walks below. But the
/// boxes lie anywhere in memory, and a processor reads many of them at the same time only if no atomic
/// operation lies between.
struct BeginClusters {
    std::span<const Aabb> boxes;
    std::span<const std::uint32_t> primitives;
    std::span<Cluster> clusters; // one per leaf

    HD void operator()(std::uint32_t leaf) const
    {
        clusters[leaf] = {boxes[primitives[leaf]], leaf | leaf_bit, leaf, 0};
    }
};

/// Kernel over leaves: walks up the radix tree and makes the nodes of the new tree.
struct MergeClusters {
    std::span<Node> radix; // its links are read, and its arrivals counted
    std::span<const std::uint32_t> radix_leaf_links;
    std::span<ClusterList> handed_on; // two per node: by the left child, by the right child
    std::span<Cluster> clusters;      // one per leaf; at first the leaves themselves
    std::span<Node> nodes;
    std::span<std::uint32_t> leaf_links;
    std::span<Top> top; // one

    HD void operator()(std::uint32_t leaf) const
    {
        ClusterList list{leaf, 1};
        std::uint32_t link = radix_leaf_links[leaf];
        while (link != no_node) {
            Node& at = radix[link >> 1];
            handed_on[link] = list;
            if (arrive(at.arrivals) == 0) return;
            at.arrivals = 0;
            list = joined(handed_on[link & ~1u], handed_on[link | 1]);
            link = at.link;
            const std::uint32_t most = link == no_node ? 1 : most_handed_on;
            while (list.count > most) list.count = merge_nearest(list);
        }
        name_parent(clusters[list.first].root, no_node);
        top[0] = {clusters[list.first].root, clusters[list.first].height};
    }

private:
    /// Moves the clusters of the right list towards the front, next to those of the left list.
    [[nodiscard]] HD ClusterList joined(const ClusterList& left, const ClusterList& right) const
    {
        for (std::uint32_t i = 0; i < right.count; ++i)
            clusters[left.first + left.count + i] = clusters[right.first + i];
        return {left.first, left.count + right.count};
    }

    /// Merges every two clusters that are each other's nearest neighbours; returns the number of
    /// clusters left.
    [[nodiscard]] HD std::uint32_t merge_nearest(const ClusterList& list) const
    {
        const NearestOf<2 * most_handed_on> nearest(
            std::span<const Cluster>(clusters).subspan(list.first, list.count));
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < list.count; ++i) {
            const std::uint32_t j = nearest[i];
            const bool mutual = nearest[j] == i;
            if (mutual && j < i) continue; // merged already
            const Cluster cluster = clusters[list.first + i];
            clusters[list.first + kept++] = mutual ? merged(cluster, clusters[list.first + j]) : cluster;
        }
        return kept;
    }

    /// Merges two clusters into one, under a new node.
    [[nodiscard]] HD Cluster merged(const Cluster& left, const Cluster& right) const
    {
        const std::uint32_t name = right.slot - 1; // >= 0: slot 0 is always the first in its list
        nodes[name].bounds[0] = left.box;
        nodes[name].bounds[1] = right.box;
        nodes[name].children[0] = left.root;
        nodes[name].children[1] = right.root;
        nodes[name].arrivals = 0;
        name_parent(left.root, link_to(name, 0));
        name_parent(right.root, link_to(name, 1));
        const std::uint32_t higher = left.height < right.height ? right.height : left.height;
        return {unite(left.box, right.box), name, left.slot, higher + 1};
    }

    HD void name_parent(std::uint32_t child, std::uint32_t link) const
    {
        (is_leaf(child) ? leaf_links[child & ~leaf_bit] : nodes[child].link) = link;
    }
};

/// Kernel of one index: exchanges the root with node 0.
struct MoveRootToFront {
    std::span<const Top> top;
    std::span<Node> nodes;
    std::span<std::uint32_t> leaf_links;

    HD void operator()(std::uint32_t /*index*/) const
    {
        const std::uint32_t from = top[0].root;
        if (is_leaf(from) || from == 0) return;
        const Node moved = nodes[0];
        nodes[0] = nodes[from];
        nodes[from] = moved;
        const std::uint32_t parent = moved.link >> 1 == from ? 0 : moved.link >> 1;
        nodes[parent].children[moved.link & 1] = from;
        nodes[from].link = link_to(parent, moved.link & 1);
        for (const std::uint32_t node : {std::uint32_t{0}, from})
            for (std::uint32_t side = 0; side < 2; ++side) {
                const std::uint32_t child = nodes[node].children[side];
                (is_leaf(child) ? leaf_links[child & ~leaf_bit] : nodes[child].link) =
                    link_to(node, side);
            }
    }
};

/// The tree, and the memory that is needed to build it from a radix tree. It can be used again.
class Hploc {
public:
    /// For up to `capacity` primitives. Throws OutOfMemory.
    Hploc(Memory& memory, std::uint32_t capacity)
        : nodes_(memory, capacity), leaf_links_(memory, capacity),
          handed_on_(memory, 2 * std::size_t{capacity}), clusters_(memory, capacity), top_(memory, 1)
    {}
    /// Queues the build over the primitives of the last build of `sorted` (Lbvh::build_links is enough),
    /// in the order of its leaves. The conditions on the boxes are those of Lbvh::build.
    template <Executor E, class Code>
    void build(E& executor, std::span<const Aabb> boxes, Lbvh<Code>& sorted)
    {
        count_ = sorted.primitive_count();
        if (count_ == 0) return;
        const std::span<Node> nodes = nodes_.first(count_ - 1);
        const std::span<std::uint32_t> leaf_links = leaf_links_.first(count_);
        const std::span<Cluster> clusters = clusters_.first(count_);
        executor(count_, BeginClusters{boxes, sorted.primitives(), clusters});
        executor(count_, MergeClusters{sorted.nodes(), sorted.leaf_links(),
                                       handed_on_.first(2 * std::size_t{count_}), clusters, nodes,
                                       leaf_links, top_.all()});
        executor(1, MoveRootToFront{top_.all(), nodes, leaf_links});
    }

    /// Nodes as in node.h, except for the order of leaves: leaves keep the numbers that they have in
    /// the radix tree, and a node does not cover a range of them.
    [[nodiscard]] std::span<const Node> nodes() const
    {
        return nodes_.first(count_ == 0 ? 0 : count_ - 1);
    }
    [[nodiscard]] std::span<const std::uint32_t> leaf_links() const { return leaf_links_.first(count_); }

    /// Waits for the build. Returns the number of edges from the root to the deepest leaf. No bound on
    /// it is known, and a traversal cannot go deeper than `deepest_tree` levels. (Many boxes
    /// nested in each other give such a tree; the height of the radix tree does not depend on boxes.)
    [[nodiscard]] std::uint32_t height() const { return count_ == 0 ? 0 : top_.read(1)[0].height; }

private:
    std::uint32_t count_ = 0;
    Buffer<Node> nodes_;
    Buffer<std::uint32_t> leaf_links_;
    Buffer<ClusterList> handed_on_;
    Buffer<Cluster> clusters_;
    Buffer<Top> top_;
};

} // namespace fast
