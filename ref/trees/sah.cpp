#include "ref/trees/sah.h"

#include "ref/trees/refit.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace ref {

namespace {

/// The same primitives three times, in the order of their centroids along x, y and z. Splitting a node
/// divides its range of each list in two and keeps the order, so nothing is sorted twice.
using SortedLists = std::array<std::vector<std::uint32_t>, 3>;

SortedLists sort_along_axes(std::span<const Aabb> boxes)
{
    SortedLists lists;
    std::vector<double> middle(boxes.size());
    for (int axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < boxes.size(); ++i) middle[i] = centroid(boxes[i])[axis];
        std::vector<std::uint32_t>& list = lists[static_cast<std::size_t>(axis)];
        list.resize(boxes.size());
        std::iota(list.begin(), list.end(), 0);
        std::stable_sort(list.begin(), list.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return middle[a] < middle[b]; });
    }
    return lists;
}

/// The first `left` primitives in the order of `axis` go to the left child. `cost` is A_left N_left +
/// A_right N_right: the expected number of primitives tested, times the area of the node.
struct Split {
    std::size_t axis;
    std::size_t left;
    double cost;
};

/// The difference between the sizes of the two children.
std::size_t imbalance(const Split& split, std::size_t count)
{
    return std::max(2 * split.left, count) - std::min(2 * split.left, count);
}

/// The best of all splits of `count` primitives from `first` on. Of several splits of equal cost it is
/// the most balanced one, so that coincident boxes do not give a long chain of nodes.
Split best_split(std::span<const Aabb> boxes, const SortedLists& lists, std::size_t first,
                 std::size_t count, std::vector<double>& right_cost)
{
    Split best{0, 0, std::numeric_limits<double>::infinity()};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::uint32_t* const list = lists[axis].data() + first;
        Aabb right;
        for (std::size_t i = count - 1; i > 0; --i) {
            right = unite(right, boxes[list[i]]);
            right_cost[i] = half_area(right) * static_cast<double>(count - i);
        }
        Aabb left;
        for (std::size_t i = 1; i < count; ++i) {
            left = unite(left, boxes[list[i - 1]]);
            // map: sah-split
            const Split split{axis, i, half_area(left) * static_cast<double>(i) + right_cost[i]};
            if (split.cost < best.cost || best.left == 0 ||
                (split.cost == best.cost && imbalance(split, count) < imbalance(best, count)))
                best = split;
        }
    }
    return best;
}

/// The range of each list, from `first` on, for which a node is still to be made.
struct Task {
    std::size_t first;
    std::size_t count;
    std::uint32_t parent;
    std::size_t side; // which child of the parent
    int depth;
};

/// Below this depth nodes are split in halves. This bounds the depth and the build time even for
/// inputs where the best split always separates a single primitive.
constexpr int max_sah_depth = 64;

/// Moves the primitives of the left child to the front of the task's range, in every list. `goes_left`
/// and `scratch` are reused memory.
void partition(SortedLists& lists, const Task& task, const Split& split,
               std::vector<std::uint8_t>& goes_left, std::vector<std::uint32_t>& scratch)
{
    const std::size_t end = task.first + task.count;
    for (std::size_t i = task.first; i < end; ++i)
        goes_left[lists[split.axis][i]] = i < task.first + split.left ? 1 : 0;
    for (std::vector<std::uint32_t>& list : lists) {
        const auto begin = list.begin() + static_cast<std::ptrdiff_t>(task.first);
        const auto list_end = list.begin() + static_cast<std::ptrdiff_t>(end);
        scratch.assign(begin, list_end);
        const auto middle = std::copy_if(scratch.begin(), scratch.end(), begin,
                                         [&](std::uint32_t p) { return goes_left[p] != 0; });
        std::copy_if(scratch.begin(), scratch.end(), middle,
                     [&](std::uint32_t p) { return goes_left[p] == 0; });
    }
}

/// Marks a child that is a leaf, until the number of internal nodes is known.
constexpr std::uint32_t leaf_mark = 0x8000'0000;

/// Appends the leaves to the internal nodes, and replaces marked children by their final numbers.
void append_leaves(std::vector<Node>& nodes, const std::vector<Node>& leaves)
{
    for (Node& node : nodes)
        for (std::uint32_t& child : node.children)
            if ((child & leaf_mark) != 0)
                child = static_cast<std::uint32_t>(nodes.size()) + (child & ~leaf_mark);
    nodes.insert(nodes.end(), leaves.begin(), leaves.end());
}

} // namespace

Tree build_sah(std::span<const Aabb> boxes, std::size_t max_leaf_size)
{
    Tree tree;
    if (boxes.empty()) return tree;
    SortedLists lists = sort_along_axes(boxes);
    std::vector<double> right_cost(boxes.size());
    std::vector<std::uint8_t> goes_left(boxes.size());
    std::vector<std::uint32_t> scratch;
    std::vector<Node> leaves;

    std::vector<Task> tasks{{0, boxes.size(), no_node, 0, 0}};
    while (!tasks.empty()) {
        const Task task = tasks.back();
        tasks.pop_back();
        const std::size_t end = task.first + task.count;

        Split split{0, task.count / 2, 0};
        bool is_leaf = task.count == 1;
        if (!is_leaf && task.depth < max_sah_depth) {
            split = best_split(boxes, lists, task.first, task.count, right_cost);
            Aabb bounds;
            for (std::size_t i = task.first; i < end; ++i) bounds = unite(bounds, boxes[lists[0][i]]);
            const double leaf_cost = C_isect * half_area(bounds) * static_cast<double>(task.count);
            is_leaf = task.count <= max_leaf_size &&
                      leaf_cost <= C_trav * half_area(bounds) + C_isect * split.cost;
        }

        const auto number = static_cast<std::uint32_t>(is_leaf ? leaves.size() : tree.nodes.size());
        if (task.parent != no_node)
            tree.nodes[task.parent].children[task.side] = is_leaf ? number | leaf_mark : number;
        Node node;
        node.parent = task.parent;
        if (is_leaf) {
            leaves.push_back(node);
            tree.leaf_begin.push_back(static_cast<std::uint32_t>(task.first));
            continue;
        }
        tree.nodes.push_back(node);

        partition(lists, task, split, goes_left, scratch);
        // The left child is pushed last and taken first, so leaves are numbered from left to right.
        tasks.push_back({task.first + split.left, task.count - split.left, number, 1, task.depth + 1});
        tasks.push_back({task.first, split.left, number, 0, task.depth + 1});
    }

    append_leaves(tree.nodes, leaves);
    tree.leaf_begin.push_back(static_cast<std::uint32_t>(boxes.size()));
    tree.primitives = std::move(lists[0]);
    refit(tree, boxes);
    return tree;
}

} // namespace ref
