// Your own tree builder, in C++, under all that Plumbline knows about trees: nasty inputs, every
// property, and the smallest input that fails. Yours is between the two lines.

#include "check/trees/check_builder.h"
#include "check/trees/report.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <numeric>
#include <stdexcept>

// ---- yours: a tree that splits the longest axis of its box at the median ----
std::int64_t split(check::NeutralTree& tree, std::span<const ref::Aabb> boxes, std::size_t begin,
                   std::size_t end)
{
    const auto node = static_cast<std::int64_t>(tree.boxes.size());
    ref::Aabb box = boxes[tree.primitives[begin]];
    for (std::size_t i = begin; i < end; ++i) box = unite(box, boxes[tree.primitives[i]]);
    tree.boxes.push_back(box);
    tree.nodes.insert(tree.nodes.end(), {-1, -1, static_cast<std::int64_t>(begin),
                                         static_cast<std::int64_t>(end - begin)});
    if (end - begin <= 2) return node;
    int axis = 0;
    for (int a = 1; a < 3; ++a)
        if (box.upper[a] - box.lower[a] > box.upper[axis] - box.lower[axis]) axis = a;
    const auto first = tree.primitives.begin();
    const std::size_t middle = (begin + end) / 2;
    std::nth_element(first + begin, first + middle, first + end,
                     [&](auto a, auto b) { return boxes[a].lower[axis] < boxes[b].lower[axis]; });
    const std::int64_t children[] = {split(tree, boxes, begin, middle), split(tree, boxes, middle, end)};
    std::ranges::copy(children, tree.nodes.begin() + 4 * node);
    tree.nodes[4 * node + 2] = tree.nodes[4 * node + 3] = 0; // slots belong to leaves
    return node;
}
// ------------------------------------------------------------------------------

check::NeutralTree build(std::span<const ref::Aabb> boxes)
{
    for (const ref::Aabb& box : boxes)
        for (int a = 0; a < 3; ++a)
            if (!(box.lower[a] <= box.upper[a])) throw std::invalid_argument("a box is empty or NaN");
    check::NeutralTree tree;
    tree.primitives.resize(boxes.size());
    std::iota(tree.primitives.begin(), tree.primitives.end(), 0);
    if (!boxes.empty()) split(tree, boxes, 0, boxes.size());
    return tree;
}

int main()
{
    check::BuilderOptions options;
    options.largest = 10'000;
    const check::BuilderReport report = check::check_builder(build, options);
    std::cout << describe(report);
    return report.passes() ? 0 : 1;
}
