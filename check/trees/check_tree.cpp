#include "check/trees/check_tree.h"

#include "check/trees/tree_properties.h"
#include "ref/trees/bvh.h"
#include "ref/trees/quality.h"
#include "ref/trees/sah.h"

#include <algorithm>

namespace check {

namespace {

/// The nodes from the root down, each before its children and the left one first, with their depths.
struct Visit {
    std::size_t node;
    std::size_t depth;
};

std::vector<Visit> depth_first(const NeutralTree& tree, std::int64_t root)
{
    std::vector<Visit> order;
    std::vector<Visit> open;
    if (root != NeutralTree::none) open.push_back({static_cast<std::size_t>(root), 0});
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        order.push_back(visit);
        const auto children = tree.children(visit.node);
        for (std::size_t i = children.size(); i-- > 0;)
            if (children[i] != NeutralTree::none)
                open.push_back({static_cast<std::size_t>(children[i]), visit.depth + 1});
    }
    return order;
}

/// Counts the neighbours of the list that are not in the order of their codes.
Property check_order(std::span<const std::int64_t> order, std::span<const ref::Aabb> primitives,
                     int bits)
{
    Findings found("morton-order",
                   "the leaves are in the order of Morton codes of " + std::to_string(bits) + " bits");
    const std::vector<std::uint64_t> codes = ref::morton_codes(primitives, bits / 3);
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
        const std::uint64_t code = codes[static_cast<std::size_t>(order[i])];
        const std::uint64_t next = codes[static_cast<std::size_t>(order[i + 1])];
        if (code > next)
            found.add(
                [&] {
                    return "primitive " + std::to_string(order[i]) + ", code " + std::to_string(code) +
                           ", comes before primitive " + std::to_string(order[i + 1]) + ", code " +
                           std::to_string(next);
                },
                NeutralTree::none, order[i]);
    }
    return found.take();
}

Property check_depth(std::span<const Visit> visits, std::size_t limit)
{
    Findings found("depth", "no leaf is deeper than " + std::to_string(limit));
    for (const Visit& visit : visits)
        if (visit.depth > limit)
            found.add(
                [&] {
                    const auto deepest = std::ranges::max_element(visits, {}, &Visit::depth);
                    return node_text(static_cast<std::int64_t>(deepest->node)) + " is at depth " +
                           std::to_string(deepest->depth);
                },
                static_cast<std::int64_t>(visit.node));
    return found.take();
}

double sah_cost(const NeutralTree& tree, std::span<const Visit> visits)
{
    if (visits.empty()) return 0.0;
    const double root_area = half_area(tree.boxes[visits.front().node]);
    double cost = 0.0;
    for (const Visit& visit : visits) {
        const double share = root_area > 0 ? half_area(tree.boxes[visit.node]) / root_area : 1.0;
        cost += share * (tree.is_leaf(visit.node)
                             ? ref::C_isect * static_cast<double>(tree.slot_count(visit.node))
                             : ref::C_trav);
    }
    return cost;
}

bool all_finite(std::span<const ref::Aabb> boxes)
{
    return std::ranges::all_of(boxes, [](const ref::Aabb& box) {
        return ref::is_finite(box.lower) && ref::is_finite(box.upper);
    });
}

/// What a tree is like, and the properties that need a sound structure.
void describe_shape(const NeutralTree& tree, std::span<const ref::Aabb> primitives,
                    const TreeChecks& checks, std::span<const Visit> visits, std::int64_t root,
                    TreeReport& report)
{
    TreeReport::Shape shape{root, 0, 0.0, visits.empty() ? 0 : primitives.size(), 0, true, true};
    std::vector<std::int64_t> order;
    for (const Visit& visit : visits) {
        shape.depth = std::max(shape.depth, visit.depth);
        if (!tree.is_leaf(visit.node)) continue;
        shape.mean_leaf_depth += static_cast<double>(visit.depth) / static_cast<double>(report.leaves);
        const auto slots = slots_of(tree, visit.node);
        shape.smallest_leaf = std::min(shape.smallest_leaf, slots.size());
        shape.largest_leaf = std::max(shape.largest_leaf, slots.size());
        order.insert(order.end(), slots.begin(), slots.end());
    }
    if (checks.max_depth) report.properties.push_back(check_depth(visits, *checks.max_depth));
    for (const int bits : {30, 63}) {
        if (!all_finite(primitives)) { // they have no place in a grid
            shape.in_order_of_30_bits = shape.in_order_of_63_bits = false;
            break;
        }
        Property property = check_order(order, primitives, bits);
        (bits == 30 ? shape.in_order_of_30_bits : shape.in_order_of_63_bits) = property.violations == 0;
        if (checks.morton_bits == bits) report.properties.push_back(std::move(property));
    }
    report.shape = shape;
}

Property not_checked(const char* name, const char* meaning)
{
    Property property = Findings(name, meaning).take();
    property.verdict = Property::Verdict::not_checked;
    return property;
}

} // namespace

bool TreeReport::passes() const
{
    return first_failure() == nullptr;
}

const Property* TreeReport::first_failure() const
{
    for (const Property& property : properties)
        if (property.verdict == Property::Verdict::fails) return &property;
    return nullptr;
}

TreeReport check_tree(const NeutralTree& tree, std::span<const ref::Aabb> primitives,
                      const TreeChecks& checks)
{
    TreeReport report;
    report.primitives = primitives.size();
    report.nodes = tree.size();
    report.properties.push_back(check_sizes(tree));
    if (!report.passes()) return report;
    for (std::size_t node = 0; node < tree.size(); ++node) report.leaves += tree.is_leaf(node) ? 1 : 0;

    report.properties.push_back(check_nodes(tree, primitives.size()));
    report.properties.push_back(check_indices(tree, primitives.size()));
    std::int64_t root = NeutralTree::none;
    for (Property& property : check_links(tree, primitives.size(), root))
        report.properties.push_back(std::move(property));
    report.properties.push_back(check_leaves(tree, primitives.size()));
    const bool sound = report.passes();
    report.properties.push_back(check_contain(tree, primitives));
    const bool usable = report.passes();
    if (checks.tight) report.properties.push_back(check_tight(tree, primitives));
    if (!sound) {
        if (checks.max_depth) report.properties.push_back(not_checked("depth", "the depth is limited"));
        if (checks.morton_bits != 0)
            report.properties.push_back(not_checked("morton-order", "the leaves are in Morton order"));
        return report;
    }
    const std::vector<Visit> visits = depth_first(tree, root);
    describe_shape(tree, primitives, checks, visits, root, report);
    if (checks.costs && usable)
        report.costs = SahCosts{sah_cost(tree, visits),
                                quality(ref::build(primitives, ref::Builder::morton63)).sah_cost,
                                quality(ref::build(primitives, ref::Builder::sah)).sah_cost};
    return report;
}

} // namespace check
