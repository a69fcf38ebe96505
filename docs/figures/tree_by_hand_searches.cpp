#include "docs/figures/svg.h"
#include "docs/figures/tree_by_hand_pictures.h"

#include <initializer_list>

namespace figures {

namespace {

constexpr int column = 48;
constexpr int sub_row = 34;
constexpr int left_margin = 150;
constexpr int top_margin = 56;

using Probes = std::vector<explain::Probe>;

/// The columns of a picture of searches: all keys, and those beyond the ends that are asked.
struct Columns {
    std::int64_t first = 0;
    std::int64_t last;

    Columns(const EightKeys& keys, std::initializer_list<Probes explain::NodeSearch::*> searches)
        : last(std::ssize(keys.codes) - 1)
    {
        for (const explain::NodeSearch& node : keys.searches)
            for (const auto search : searches)
                for (const explain::Probe& probe : node.*search) {
                    first = std::min(first, probe.key);
                    last = std::max(last, probe.key);
                }
    }
    [[nodiscard]] int x(std::int64_t key) const
    {
        return left_margin + static_cast<int>(key - first) * column + column / 2;
    }
    [[nodiscard]] int width() const { return x(last) + column; }
};

/// The heads of the columns, and a band behind those that are keys.
void draw_columns(Svg& svg, const EightKeys& keys, const Columns& columns, int height)
{
    const std::int64_t n = std::ssize(keys.codes);
    svg.rectangle(columns.x(0) - column / 2, top_margin - 8, static_cast<int>(n) * column,
                  height - top_margin, "#f5f7fa", "none");
    for (std::int64_t key = columns.first; key <= columns.last; ++key) {
        const bool exists = key >= 0 && key < n;
        svg.label(columns.x(key), 24, std::to_string(key), exists ? "black" : svg_grey);
        svg.label(columns.x(key), 40, exists ? keys.bits(static_cast<std::size_t>(key)) : "no key",
                  exists ? svg_blue : svg_grey, 11);
    }
}

/// A disc for each key that is asked, with its delta: filled if it is above the bound. Above it the
/// step.
void draw_probes(Svg& svg, const Columns& columns, const Probes& probes, int y)
{
    for (const explain::Probe& probe : probes) {
        const int x = columns.x(probe.key);
        svg.circle(x, y, 10, probe.longer ? svg_pale_blue : "white", probe.longer ? svg_blue : svg_red);
        svg.label(x, y + 4, std::to_string(of_code(probe.delta)), "black", 11);
        svg.label(x + 17, y - 4, std::to_string(probe.step), svg_grey, 10);
    }
}

void draw_range(Svg& svg, const Columns& columns, const explain::NodeSearch& node, int y)
{
    svg.line(columns.x(node.i), y, columns.x(node.j), y, svg_blue, 4);
    svg.circle(columns.x(node.i), y, 10, "white", svg_blue);
    svg.label(columns.x(node.i), y + 4, std::to_string(node.i), svg_blue, 12);
}

/// The line above the row of a node and its name, with the delta that its search exceeds. Returns the
/// row's y.
int begin_row(Svg& svg, const Columns& columns, const explain::NodeSearch& node, int height,
              int exceeded)
{
    const int y = top_margin + static_cast<int>(node.i) * height + 16;
    svg.line(8, y - 22, columns.width() - 8, y - 22, "#d5d9df");
    svg.label(8, y + 4, "node " + std::to_string(node.i) + ", > " + std::to_string(of_code(exceeded)),
              "black", 12, "start");
    return y;
}

} // namespace

std::string draw_ranges(const EightKeys& keys)
{
    const Columns columns(keys, {&explain::NodeSearch::doubling, &explain::NodeSearch::length});
    const int row = 3 * sub_row + 12;
    const int height = top_margin + static_cast<int>(keys.searches.size()) * row + 8;
    Svg svg;
    draw_columns(svg, keys, columns, height);
    for (const explain::NodeSearch& node : keys.searches) {
        const int y = begin_row(svg, columns, node, row, node.delta_min);
        svg.label(left_margin - 10, y + 4, "l_max", svg_grey, 11, "end");
        svg.label(left_margin - 10, y + sub_row + 4, "t", svg_grey, 11, "end");
        svg.label(left_margin - 10, y + 2 * sub_row + 4, "range", svg_grey, 11, "end");
        draw_probes(svg, columns, node.doubling, y);
        draw_probes(svg, columns, node.length, y + sub_row);
        draw_range(svg, columns, node, y + 2 * sub_row);
    }
    return svg.document(columns.width(), height);
}

std::string draw_splits(const EightKeys& keys)
{
    const Columns columns(keys, {&explain::NodeSearch::split});
    const int row = 2 * sub_row + 12;
    const int height = top_margin + static_cast<int>(keys.searches.size()) * row + 8;
    Svg svg;
    draw_columns(svg, keys, columns, height);
    for (const explain::NodeSearch& node : keys.searches) {
        const int y = begin_row(svg, columns, node, row, node.delta_node);
        svg.label(left_margin - 10, y + 4, "t", svg_grey, 11, "end");
        svg.label(left_margin - 10, y + sub_row + 4, "split", svg_grey, 11, "end");
        draw_probes(svg, columns, node.split, y);
        draw_range(svg, columns, node, y + sub_row);
        const int split = (columns.x(node.gamma) + columns.x(node.gamma + 1)) / 2;
        svg.line(split, y + sub_row - 12, split, y + sub_row + 12, svg_red, 3);
    }
    return svg.document(columns.width(), height);
}

} // namespace figures
