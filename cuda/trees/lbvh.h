#pragma once

// A radix tree over boxes along a Morton curve: order, tree, refit. As in morton_order.h, no stage needs
// a result on the host.

#include "cuda/parallel/buffer.h"
#include "cuda/trees/morton_order.h"
#include "cuda/trees/radix_tree.h"
#include "cuda/trees/refit.h"

#include <concepts>
#include <cstdint>
#include <span>

namespace fast {

/// The radix tree over sorted codes (node.h), and its memory.
class RadixTree {
public:
    /// For up to `capacity` primitives. Throws OutOfMemory.
    RadixTree(Memory& memory, std::uint32_t capacity)
        : nodes_(memory, internal_nodes(capacity)), leaf_links_(memory, capacity)
    {}
    /// Queues the build. The bounds in the nodes are undefined until the first refit.
    template <Executor E, class Code>
    void build(E& executor, std::span<const Code> codes)
    {
        count_ = static_cast<std::uint32_t>(codes.size());
        const std::span<std::uint32_t> links = leaf_links_.first(count_);
        if (count_ == 1) executor(1, UnlinkOnlyLeaf{links});
        executor(internal_nodes(count_), BuildRadixTree<Code>{codes, nodes(), links});
    }
    /// Queues the computation of all bounds from the boxes of the primitives.
    template <Executor E>
    void refit(E& executor, std::span<const Aabb> boxes, std::span<const std::uint32_t> primitives)
    {
        executor(count_, RefitBounds<>{boxes, primitives, leaf_links_.first(count_), nodes()});
    }

    [[nodiscard]] std::uint32_t primitive_count() const { return count_; }
    [[nodiscard]] std::span<Node> nodes() { return nodes_.first(internal_nodes(count_)); }
    [[nodiscard]] std::span<const Node> nodes() const { return nodes_.first(internal_nodes(count_)); }
    [[nodiscard]] std::span<const std::uint32_t> leaf_links() const { return leaf_links_.first(count_); }

private:
    static std::uint32_t internal_nodes(std::uint32_t primitives)
    {
        return primitives == 0 ? 0 : primitives - 1;
    }

    std::uint32_t count_ = 0;
    Buffer<Node> nodes_;
    Buffer<std::uint32_t> leaf_links_;
};

/// A radix tree over boxes, and all memory that the build needs: rebuilding allocates nothing. `Code` as
/// for MortonOrder.
template <class Code>
class Lbvh {
public:
    /// As for MortonOrder.
    template <Executor E>
    Lbvh(Memory& memory, const E& executor, std::uint32_t capacity)
        : order_(memory, executor, capacity), tree_(memory, capacity)
    {}

    /// Queues the build of the tree over `boxes`. Conditions, `finished` and errors as for MortonOrder;
    /// with boxes that are not legal the tree is undefined.
    template <Executor E, std::invocable<Stage> Finished>
    void build(E& executor, std::span<const Aabb> boxes, const Finished& finished)
    {
        order_.build(executor, boxes, finished);
        tree_.build(executor, order_.codes());
        finished(Stage::tree);
        refit(executor, boxes);
        finished(Stage::refit);
    }
    template <Executor E>
    void build(E& executor, std::span<const Aabb> boxes)
    {
        build(executor, boxes, [](Stage) {});
    }

    /// Queues a refit of the same tree to new boxes of the same primitives, for example after they
    /// moved.
    template <Executor E>
    void refit(E& executor, std::span<const Aabb> boxes)
    {
        tree_.refit(executor, boxes, order_.primitives());
    }

    // Results of the last build that was queued, in the memory of its kernels; valid once it is done.
    [[nodiscard]] std::uint32_t primitive_count() const { return tree_.primitive_count(); }
    [[nodiscard]] std::span<Node> nodes() { return tree_.nodes(); }
    [[nodiscard]] std::span<const Node> nodes() const { return tree_.nodes(); }
    [[nodiscard]] std::span<const std::uint32_t> leaf_links() const { return tree_.leaf_links(); }
    [[nodiscard]] std::span<const std::uint32_t> primitives() const { return order_.primitives(); }
    [[nodiscard]] std::span<const Code> codes() const { return order_.codes(); }
    [[nodiscard]] const MortonOrder<Code>& order() const { return order_; }

    /// Waits for the build. The lowest number of a primitive whose box is not legal, or no_primitive.
    [[nodiscard]] std::uint32_t first_rejected() const { return order_.first_rejected(); }

private:
    MortonOrder<Code> order_;
    RadixTree tree_;
};

} // namespace fast
