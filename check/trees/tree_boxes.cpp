// Properties of the boxes.

#include "check/trees/tree_properties.h"

#include "check/trees/number_text.h"

#include <array>
#include <cmath>
#include <limits>

namespace check {

namespace {

constexpr std::array axis_names = {"x", "y", "z"};

/// Calls `visit(box, name, child, primitive)` for the box of every child or primitive of `node`; of
/// child and primitive one is `none`.
template <typename Visit>
void for_each_part(const NeutralTree& tree, std::span<const ref::Aabb> primitives, std::size_t node,
                   Visit visit)
{
    for (const std::int64_t child : tree.children(node))
        if (is_node(tree, child))
            visit(tree.boxes[static_cast<std::size_t>(child)], child, NeutralTree::none);
    for (const std::int64_t primitive : slots_of(tree, node))
        if (primitive >= 0 && static_cast<std::size_t>(primitive) < primitives.size())
            visit(primitives[static_cast<std::size_t>(primitive)], NeutralTree::none, primitive);
}

std::string part_text(std::int64_t child, std::int64_t primitive)
{
    return child != NeutralTree::none ? "its child, " + node_text(child) + ","
                                      : "its primitive " + std::to_string(primitive);
}

/// The largest float <= x, and the smallest one >= x.
double float_below(double x)
{
    const auto f = static_cast<float>(x);
    return f > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}

double float_above(double x)
{
    return -float_below(-x);
}

} // namespace

Property check_contain(const NeutralTree& tree, std::span<const ref::Aabb> primitives)
{
    Findings found("contain", "each box contains those of its children or primitives");
    for (std::size_t node = 0; node < tree.size(); ++node) {
        const ref::Aabb& box = tree.boxes[node];
        const auto number = static_cast<std::int64_t>(node);
        for_each_part(tree, primitives, node,
                      [&](const ref::Aabb& part, std::int64_t child, std::int64_t primitive) {
                          // Written so that NaN is a violation.
                          for (int axis = 0; axis < 3; ++axis) {
                              const bool lower = box.lower[axis] <= part.lower[axis];
                              const bool upper = box.upper[axis] >= part.upper[axis];
                              if (lower && upper) continue;
                              found.add(
                                  [&] {
                                      const ref::Vec3& outer = lower ? box.upper : box.lower;
                                      const ref::Vec3& inner = lower ? part.upper : part.lower;
                                      return std::string("the box of ") + node_text(number) +
                                             (lower ? " ends at " : " begins at ") +
                                             axis_names[static_cast<std::size_t>(axis)] + " = " +
                                             number_text(outer[axis]) + ", that of " +
                                             part_text(child, primitive) + " at " +
                                             number_text(inner[axis]);
                                  },
                                  number, primitive);
                              return;
                          }
                      });
    }
    return found.take();
}

Property check_tight(const NeutralTree& tree, std::span<const ref::Aabb> primitives)
{
    Findings found("tight", "no box is larger than its children or primitives need");
    for (std::size_t node = 0; node < tree.size(); ++node) {
        ref::Aabb needed;
        for_each_part(tree, primitives, node, [&](const ref::Aabb& part, std::int64_t, std::int64_t) {
            needed = unite(needed, part);
        });
        if (is_empty(needed)) continue;
        const ref::Aabb& box = tree.boxes[node];
        for (int axis = 0; axis < 3; ++axis) {
            double lower = needed.lower[axis];
            double upper = needed.upper[axis];
            if (tree.single_precision) {
                lower = float_below(lower);
                upper = float_above(upper);
            }
            const bool loose_below = box.lower[axis] < lower;
            if (!loose_below && !(box.upper[axis] > upper)) continue;
            found.add(
                [&] {
                    return "the box of " + node_text(static_cast<std::int64_t>(node)) +
                           (loose_below ? " begins at " : " ends at ") +
                           axis_names[static_cast<std::size_t>(axis)] + " = " +
                           number_text(loose_below ? box.lower[axis] : box.upper[axis]) + ", what it " +
                           "must contain at " + number_text(loose_below ? lower : upper);
                },
                static_cast<std::int64_t>(node));
            break;
        }
    }
    return found.take();
}

} // namespace check
