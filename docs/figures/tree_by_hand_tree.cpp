#include "docs/figures/svg.h"
#include "docs/figures/tree_by_hand_pictures.h"

#include <cmath>

namespace figures {

namespace {

constexpr int tree_column = 100;
constexpr int tree_row = 62;
constexpr int tree_margin = 20;

/// Where the nodes are drawn: leaves in a row, an internal node above the gap of its split.
struct Places {
    const EightKeys* keys;
    int top;

    [[nodiscard]] int x(std::uint32_t node) const
    {
        if (keys->tree.is_leaf(node)) return key_x(keys->tree.leaf(node));
        const auto gamma = static_cast<std::uint32_t>(keys->searches[node].gamma);
        return (key_x(gamma) + key_x(gamma + 1)) / 2;
    }
    [[nodiscard]] int y(std::uint32_t node) const
    {
        return top + tree_row * (keys->tree.is_leaf(node) ? keys->deepest() : keys->depth[node]);
    }
    [[nodiscard]] static int key_x(std::uint32_t key)
    {
        return tree_margin + tree_column / 2 + static_cast<int>(key) * tree_column;
    }
    [[nodiscard]] int width() const
    {
        return 2 * tree_margin + static_cast<int>(keys->size()) * tree_column;
    }
    [[nodiscard]] int bottom() const { return top + tree_row * keys->deepest(); }
};

void draw_nodes(Svg& svg, const Places& places)
{
    const ref::Tree& tree = places.keys->tree;
    for (std::uint32_t node = 0; node < tree.nodes.size(); ++node) {
        const int x = places.x(node);
        const int y = places.y(node);
        if (tree.is_leaf(node)) {
            svg.rectangle(x - 14, y - 11, 28, 22, "white", "black");
            svg.label(x, y + 5, std::to_string(tree.leaf(node)));
        } else {
            svg.circle(x, y, 14, "white", svg_blue);
            svg.label(x, y + 5, std::to_string(node), svg_blue);
        }
    }
}

/// The unit cube seen obliquely: x points right, z up, and y back.
struct Oblique {
    int left, bottom; // of the picture

    [[nodiscard]] int x(const ref::Vec3& p) const
    {
        return left + 15 + static_cast<int>(std::lround(150 * p.x + 55 * p.y));
    }
    [[nodiscard]] int y(const ref::Vec3& p) const
    {
        return bottom - 15 - static_cast<int>(std::lround(150 * p.z + 45 * p.y));
    }
};

/// The twelve edges of a box.
void draw_box(Svg& svg, const Oblique& view, const ref::Aabb& box)
{
    const auto corner = [&](unsigned number) {
        return ref::Vec3((number & 1) != 0 ? box.upper.x : box.lower.x,
                         (number & 2) != 0 ? box.upper.y : box.lower.y,
                         (number & 4) != 0 ? box.upper.z : box.lower.z);
    };
    for (unsigned from = 0; from < 8; ++from)
        for (const unsigned axis : {1U, 2U, 4U}) {
            if ((from & axis) != 0) continue;
            const ref::Vec3 a = corner(from);
            const ref::Vec3 b = corner(from | axis);
            svg.line(view.x(a), view.y(a), view.x(b), view.y(b), svg_blue, 2);
        }
}

/// The sorted keys below the leaves, with `with_index` the bits of the index after the code.
void draw_sorted_keys(Svg& svg, const EightKeys& keys, int y, bool with_index)
{
    for (std::uint32_t key = 0; key < keys.size(); ++key) {
        const int x = Places::key_x(key);
        svg.label(x, y, keys.bits(key) + (with_index ? " " + EightKeys::index_bits(key) : ""), svg_blue);
        svg.label(x, y + 18, "#" + std::to_string(keys.tree.primitives[key]), svg_grey, 12);
        if (key + 1 < keys.size())
            svg.label(x + tree_column / 2, y + 40, std::to_string(keys.common(key, key + 1)), svg_red);
    }
}

} // namespace

std::string draw_refit(const EightKeys& keys, std::span<const std::uint32_t> leaf_order)
{
    const ref::Tree& tree = keys.tree;
    const auto arrivals = explain::refit_arrivals(tree, leaf_order);
    const Places places{&keys, 30};
    Svg svg;
    // The edge of the second arrival is thick: that walk goes on. The other ends in a bar.
    for (std::uint32_t node = 0; node < tree.internal_count(); ++node)
        for (const std::size_t order : {0U, 1U}) {
            const std::uint32_t child = arrivals[node].children[order];
            svg.line(places.x(child), places.y(child), places.x(node), places.y(node),
                     order == 0 ? svg_red : svg_blue, order == 0 ? 1 : 4, order == 0 ? "5 4" : "");
        }
    draw_nodes(svg, places);
    for (std::uint32_t node = 0; node < tree.internal_count(); ++node)
        for (const std::size_t order : {0U, 1U}) {
            const bool is_left = arrivals[node].children[order] == tree.nodes[node].children[0];
            svg.label(places.x(node) + (is_left ? -18 : 18), places.y(node) + 4,
                      "w" + std::to_string(arrivals[node].leaves[order]) + (order == 0 ? ":0" : ":1"),
                      order == 0 ? svg_red : svg_blue, 12, is_left ? "end" : "start");
        }
    return svg.document(places.width(), places.bottom() + 30);
}

std::string draw_duplicates(const EightKeys& keys)
{
    const ref::Tree& tree = keys.tree;
    const Places places{&keys, 30};
    Svg svg;
    for (std::uint32_t node = 1; node < tree.nodes.size(); ++node) {
        const std::uint32_t parent = tree.nodes[node].parent;
        svg.line(places.x(node), places.y(node), places.x(parent), places.y(parent), svg_grey);
    }
    draw_nodes(svg, places);
    draw_sorted_keys(svg, keys, places.bottom() + 34, true);
    return svg.document(places.width(), places.bottom() + 90);
}

std::string draw_keys(const EightKeys& keys)
{
    Svg svg;
    const int top = 20;
    const auto count = static_cast<std::uint32_t>(keys.size());
    for (std::uint32_t key = 0; key < count; ++key) {
        svg.label(Places::key_x(key), top, "key " + std::to_string(key));
        if (key + 1 == count) continue; // as many internal nodes as gaps
        const bool right = keys.searches[key].d > 0;
        const int x = Places::key_x(key);
        svg.arrow(x, x + (right ? 40 : -40), top + 84, svg_blue);
        svg.circle(x, top + 84, 12, "white", svg_blue);
        svg.label(x, top + 89, std::to_string(key), svg_blue);
    }
    draw_sorted_keys(svg, keys, top + 20, false);
    const Places places{&keys, 0};
    return svg.document(places.width(), top + 110);
}

std::string draw_boxes(const EightKeys& keys)
{
    constexpr int panel = 250; // wide and high
    const ref::Tree& tree = keys.tree;
    Svg svg;
    for (int depth = 0; depth < keys.deepest(); ++depth) {
        const Oblique view{15 + depth * panel, panel};
        svg.label(view.left + panel / 2 - 15, 18,
                  depth == 0 ? "the root" : "depth " + std::to_string(depth));
        for (std::uint32_t node = 0; node < tree.internal_count(); ++node) {
            if (keys.depth[node] != depth) continue;
            draw_box(svg, view, tree.bounds[node]);
            const ref::Vec3 corner(tree.bounds[node].lower.x, tree.bounds[node].lower.y,
                                   tree.bounds[node].upper.z);
            svg.label(view.x(corner) + 8, view.y(corner) - 5, std::to_string(node), svg_blue, 14);
        }
        for (std::uint32_t key = 0; key < keys.size(); ++key) {
            const ref::Vec3 c = centroid(keys.boxes[tree.primitives[key]]);
            svg.circle(view.x(c), view.y(c), 3, "black", "black");
            svg.label(view.x(c) + 8, view.y(c) + 14, std::to_string(key), "black", 11);
        }
    }
    return svg.document(keys.deepest() * panel + 15, panel + 10);
}

} // namespace figures
