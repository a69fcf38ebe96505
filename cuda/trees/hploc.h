#pragma once

// A better tree over the same sorted keys. Clusters of neighbours along the curve are merged pair by
// pair during a walk up the radix tree; the pairs with the smallest common box are merged first
// [Benthin et al. 2024; Meister and Bittner 2018 for the merging].
//
// The radix tree itself is not needed: which range of leaves is the sibling of a range follows from the
// keys at its ends [Apetrei 2014]. The walks are one launch without a transfer to the host, with one
// thread per walk, as in the refit. Each range passes its clusters to its parent, at most
// `most_handed_on` of them. The second of two siblings to arrive joins both lists, and merges clusters
// if there are too many.

#include "cuda/parallel/atomic.h"
#include "cuda/parallel/buffer.h"
#include "cuda/parallel/executor.h"
#include "cuda/parallel/prefetch.h"
#include "cuda/trees/division.h"
#include "cuda/trees/morton_order.h"
#include "cuda/trees/nearest_clusters.h"
#include "cuda/trees/radix_tree.h"

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

/// What a range of leaves passes to its parent. A split lies between the two: so of the left range it is
/// the last leaf, and the first leaf of the right range follows it. The list of a range begins where the
/// range does.
struct HandedOn {
    std::uint32_t far_end; // of the left range the first leaf, of the right range the last
    std::uint32_t count;   // of clusters
};

/// Kernel over leaves: makes each a cluster, and clears the arrivals. This could be the first step of
/// the walks below. But the boxes lie anywhere in memory, and a processor reads many of them at the same
/// time only if no atomic operation lies between.
struct BeginClusters {
    std::span<const Aabb> boxes;
    std::span<const std::uint32_t> primitives;
    std::span<Cluster> clusters;       // one per leaf
    std::span<std::uint32_t> arrivals; // one per leaf

    static constexpr std::uint32_t ahead = 16; // boxes are loaded this many leaves ahead

    HD void operator()(std::uint32_t leaf) const
    {
        if (leaf + ahead < primitives.size()) prefetch(boxes[primitives[leaf + ahead]]);
        clusters[leaf] = {boxes[primitives[leaf]], leaf | leaf_bit, leaf, 0};
        arrivals[leaf] = 0;
    }
};

/// Kernel over leaves: walks up the radix tree and makes the nodes of the new tree.
template <class Code>
struct MergeClusters {
    std::span<const Code> codes;       // sorted
    std::span<std::uint32_t> arrivals; // at each split; 0 at first
    std::span<HandedOn> handed_on;     // two per split: by the left range, by the right range
    std::span<Cluster> clusters;       // one per leaf; at first the leaves themselves
    std::span<Node> nodes;
    std::span<std::uint32_t> leaf_links;
    DivisionsView divisions;
    std::span<Top> top; // one

    HD void operator()(std::uint32_t leaf) const
    {
        const auto last = static_cast<std::uint32_t>(codes.size() - 1);
        ClusterList list{leaf, 1};
        Range range{leaf, leaf};
        while (range.first > 0 || range.last < last) {
            const bool is_left = joins_behind(range);
            const std::uint32_t split = is_left ? range.last : range.first - 1;
            handed_on[link_to(split, is_left ? 0 : 1)] = {is_left ? range.first : range.last,
                                                          list.count};
            if (arrive(arrivals[split]) == 0) return;
            const HandedOn left = handed_on[link_to(split, 0)];
            const HandedOn right = handed_on[link_to(split, 1)];
            range = {left.far_end, right.far_end};
            list = joined({left.far_end, left.count}, {split + 1, right.count});
            const bool all = range.first == 0 && range.last == last;
            const std::uint32_t most = all ? 1 : most_handed_on;
            if (list.count > most) expect_merges(list);
            while (list.count > most) list.count = merge_nearest(list);
        }
        name_parent(clusters[list.first].root, no_node);
        top[0] = {clusters[list.first].root, clusters[list.first].height};
    }

private:
    /// Leaves first to last.
    struct Range {
        std::uint32_t first;
        std::uint32_t last;
    };
    /// Whether the sibling of a range that is not all leaves lies behind it, and not before it: with
    /// which neighbour its keys have the longer common prefix [Apetrei 2014, sec. 3].
    [[nodiscard]] HD bool joins_behind(const Range& range) const
    {
        const auto first = static_cast<std::int32_t>(range.first);
        const auto last = static_cast<std::int32_t>(range.last);
        return common_prefix(codes, last, last + 1) > common_prefix(codes, first, first - 1);
    }
    /// Moves the clusters of the right list towards the front, next to those of the left list.
    [[nodiscard]] HD ClusterList joined(const ClusterList& left, const ClusterList& right) const
    {
        const std::uint32_t end = left.first + left.count;
        if (end != right.first)
            for (std::uint32_t i = 0; i < right.count; ++i)
                clusters[end + i] = clusters[right.first + i];
        return {left.first, left.count + right.count};
    }

    /// Loads what merged() will write: otherwise writing waits for it.
    HD void expect_merges(const ClusterList& list) const
    {
        for (std::uint32_t i = 1; i < list.count; ++i) {
            const std::uint32_t name = clusters[list.first + i].slot - 1;
            prefetch_to_write(nodes[name]);
            prefetch_to_write(divisions.of[name]);
        }
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
        const Aabb box = unite(left.box, right.box);
        divisions.divide(name, left.root, right.root, box);
        const std::uint32_t higher = left.height < right.height ? right.height : left.height;
        return {box, name, left.slot, higher + 1};
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
    DivisionsView divisions;

    HD void operator()(std::uint32_t /*index*/) const
    {
        const std::uint32_t from = top[0].root;
        if (is_leaf(from) || from == 0) return;
        const Node moved = nodes[0];
        nodes[0] = nodes[from];
        nodes[from] = moved;
        const Division division = divisions.of[0];
        divisions.of[0] = divisions.of[from];
        divisions.of[from] = division;
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

/// The tree, and the memory that is needed to build it from sorted codes. It can be used again.
class Hploc {
public:
    /// For up to `capacity` primitives. Throws OutOfMemory.
    Hploc(Memory& memory, std::uint32_t capacity)
        : nodes_(memory, capacity), leaf_links_(memory, capacity), divisions_(memory, capacity),
          arrivals_(memory, capacity), handed_on_(memory, 2 * std::size_t{capacity}),
          clusters_(memory, capacity), top_(memory, 1)
    {}
    /// Queues the build over the primitives of the last build of `order`, which are its leaves. The
    /// conditions on the boxes are those of MortonOrder::build.
    template <Executor E, class Code>
    void build(E& executor, std::span<const Aabb> boxes, const MortonOrder<Code>& order)
    {
        count_ = static_cast<std::uint32_t>(order.codes().size());
        if (count_ == 0) return;
        const std::span<Node> nodes = nodes_.first(count_ - 1);
        const std::span<std::uint32_t> leaf_links = leaf_links_.first(count_);
        const std::span<Cluster> clusters = clusters_.first(count_);
        const std::span<std::uint32_t> arrivals = arrivals_.first(count_);
        executor(count_, BeginClusters{boxes, order.primitives(), clusters, arrivals});
        executor(count_,
                 MergeClusters<Code>{order.codes(), arrivals, handed_on_.first(2 * std::size_t{count_}),
                                     clusters, nodes, leaf_links, divisions_.view(), top_.all()});
        executor(1, MoveRootToFront{top_.all(), nodes, leaf_links, divisions_.view()});
    }

    /// Nodes as in node.h, except for the order of leaves: leaves keep the numbers that they have in
    /// the radix tree, and a node does not cover a range of them.
    [[nodiscard]] std::span<const Node> nodes() const
    {
        return nodes_.first(count_ == 0 ? 0 : count_ - 1);
    }
    [[nodiscard]] std::span<const std::uint32_t> leaf_links() const { return leaf_links_.first(count_); }

    /// How the tree is best collapsed (division.h).
    [[nodiscard]] std::span<const Division> divisions() const { return divisions_.all(); }

    /// Waits for the build. Returns the number of edges from the root to the deepest leaf. No bound on
    /// it is known, and a traversal cannot go deeper than `deepest_tree` levels. (Many boxes
    /// nested in each other give such a tree; the height of the radix tree does not depend on boxes.)
    [[nodiscard]] std::uint32_t height() const { return count_ == 0 ? 0 : top_.read(1)[0].height; }

private:
    std::uint32_t count_ = 0;
    Buffer<Node> nodes_;
    Buffer<std::uint32_t> leaf_links_;
    Divisions divisions_;
    Buffer<std::uint32_t> arrivals_;
    Buffer<HandedOn> handed_on_;
    Buffer<Cluster> clusters_;
    Buffer<Top> top_;
};

} // namespace fast
