#include "explain/tree.h"

#include "ref/trees/bvh.h"
#include "ref/trees/radix_tree.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>

namespace explain {

namespace {

/// Asks delta(i, key) > bound, and records it.
bool probe(ref::Codes codes, std::int64_t i, std::int64_t step, std::int64_t key, int bound,
           std::vector<Probe>& probes)
{
    const int found = ref::delta(codes, i, key);
    probes.push_back({step, key, found, found > bound});
    return found > bound;
}

std::vector<Ancestor> way_to_root(const ref::Tree& tree, ref::Codes codes, std::uint32_t leaf)
{
    std::vector<std::uint32_t> from_left_to_right(tree.leaf_count());
    std::iota(from_left_to_right.begin(), from_left_to_right.end(), 0U);
    const std::vector<Arrivals> arrivals = refit_arrivals(tree, from_left_to_right);
    std::vector<Ancestor> way;
    for (std::uint32_t node = tree.nodes[leaf].parent; node != ref::no_node;
         node = tree.nodes[node].parent) {
        const auto [first, last, gamma] = ref::radix_node(codes, node);
        const auto& [leaves, children] = arrivals[node];
        way.push_back({node, first, last, gamma, leaves, children, tree.bounds[node]});
    }
    return way;
}

} // namespace

NodeSearch search_of_node(std::span<const std::uint64_t> codes, std::int64_t i)
{
    NodeSearch search{};
    search.i = i;
    search.delta_right = ref::delta(codes, i, i + 1);
    search.delta_left = ref::delta(codes, i, i - 1);
    search.d = search.delta_right > search.delta_left ? 1 : -1;
    search.delta_min = std::min(search.delta_right, search.delta_left);
    const int d = search.d;

    std::int64_t l_max = 2;
    while (probe(codes, i, l_max, i + l_max * d, search.delta_min, search.doubling)) l_max *= 2;
    for (std::int64_t t = l_max / 2; t >= 1; t /= 2)
        if (probe(codes, i, t, i + (search.l + t) * d, search.delta_min, search.length)) search.l += t;
    search.j = i + search.l * d;

    search.delta_node = ref::delta(codes, i, search.j);
    std::int64_t t = search.l;
    do {
        t = (t + 1) / 2;
        if (probe(codes, i, t, i + (search.s + t) * d, search.delta_node, search.split)) search.s += t;
    } while (t > 1);
    search.gamma = i + search.s * d + std::min(d, 0);
    return search;
}

std::vector<Arrivals> refit_arrivals(const ref::Tree& tree, std::span<const std::uint32_t> leaf_order)
{
    std::vector<Arrivals> arrivals(tree.internal_count());
    std::vector<std::size_t> count(tree.internal_count(), 0);
    for (const std::uint32_t leaf : leaf_order) {
        std::uint32_t node = tree.internal_count() + leaf;
        for (;;) {
            const std::uint32_t child = node;
            node = tree.nodes[node].parent;
            if (node == ref::no_node) break;
            arrivals[node].leaves[count[node]] = leaf;
            arrivals[node].children[count[node]] = child;
            if (count[node]++ == 0) break; // the other child has no box yet
        }
    }
    return arrivals;
}

TreeExplanation explain_tree(std::span<const ref::Aabb> boxes, int bits_per_axis,
                             std::uint32_t primitive)
{
    if (primitive >= boxes.size())
        throw std::invalid_argument("--primitive " + std::to_string(primitive) + ": there are " +
                                    std::to_string(boxes.size()) +
                                    " primitives, with numbers from 0 on");
    const ref::Tree tree =
        ref::build(boxes, bits_per_axis == 10 ? ref::Builder::morton30 : ref::Builder::morton63);
    const std::vector<std::uint64_t> by_primitive = ref::morton_codes(boxes, bits_per_axis);
    std::vector<std::uint64_t> codes;
    for (const std::uint32_t p : tree.primitives) codes.push_back(by_primitive[p]);

    const auto n = std::ssize(codes);
    const std::int64_t place = std::ranges::find(tree.primitives, primitive) - tree.primitives.begin();
    const auto key = [&](std::int64_t at) -> std::optional<Key> {
        if (at < 0 || at >= n) return std::nullopt;
        const auto index = static_cast<std::size_t>(at);
        return Key{at, tree.primitives[index], codes[index], ref::delta(codes, place, at)};
    };
    TreeExplanation result{};
    result.primitive = primitive;
    result.bits_per_axis = bits_per_axis;
    result.primitives = static_cast<std::uint32_t>(boxes.size());
    result.box = boxes[primitive];
    result.centroid = centroid(result.box);
    for (const ref::Aabb& box : boxes) result.grid = unite(result.grid, {centroid(box), centroid(box)});
    result.cell = ref::cell_of(result.centroid, result.grid, bits_per_axis);
    result.key = *key(place);
    result.left = key(place - 1);
    result.right = key(place + 1);
    if (place + 1 < n) result.search = search_of_node(codes, place);
    result.leaf = tree.internal_count() + static_cast<std::uint32_t>(place);
    result.way = way_to_root(tree, codes, result.leaf);
    return result;
}

} // namespace explain
