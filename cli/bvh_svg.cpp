#include "cli/bvh_svg.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace cli {

namespace {

constexpr int column = 46;     // pixels per key
constexpr int row_height = 40; // pixels per level of the tree
constexpr int bit_row = 15;    // pixels per bit of a key
constexpr int margin = 30;
constexpr const char* blue = "#1f5fa8";
constexpr const char* red = "#c2410c";
constexpr const char* grey = "#8a8f98";

int x_of(std::int64_t key)
{
    return margin + column / 2 + static_cast<int>(key) * column;
}

int y_of(int depth)
{
    return margin + row_height / 2 + depth * row_height;
}

class Svg {
public:
    void line(int x1, int y1, int x2, int y2, const char* color, int width)
    {
        text_ << "<line x1='" << x1 << "' y1='" << y1 << "' x2='" << x2 << "' y2='" << y2 << "' stroke='"
              << color << "' stroke-width='" << width << "'/>\n";
    }
    void circle(int x, int y, int radius, const char* color)
    {
        text_ << "<circle cx='" << x << "' cy='" << y << "' r='" << radius << "' fill='white' stroke='"
              << color << "' stroke-width='2'/>\n";
    }
    template <typename Content>
    void label(int x, int y, const Content& content, const char* color)
    {
        text_ << "<text x='" << x << "' y='" << y << "' fill='" << color << "'>" << content
              << "</text>\n";
    }
    [[nodiscard]] std::string document(int width, int height) const
    {
        std::ostringstream all;
        all << "<svg xmlns='http://www.w3.org/2000/svg' width='" << width << "' height='" << height
            << "' viewBox='0 0 " << width << ' ' << height
            << "' font-family='monospace' font-size='13' text-anchor='middle'>\n"
            << "<rect width='100%' height='100%' fill='white'/>\n"
            << text_.str() << "</svg>\n";
        return all.str();
    }

private:
    std::ostringstream text_;
};

/// The number of leading bits that distinguish all different codes, at least one.
int telling_bits(ref::Codes codes, int code_bits)
{
    int longest = 0;
    for (std::size_t i = 1; i < codes.size(); ++i)
        if (codes[i - 1] != codes[i])
            longest = std::max(longest, std::countl_zero(codes[i - 1] ^ codes[i]) - (64 - code_bits));
    return std::min(longest + 1, code_bits);
}

/// Depth of every node of a valid tree.
std::vector<int> depths(const std::vector<ref::Node>& nodes)
{
    std::vector<int> depth(nodes.size(), 0);
    for (std::uint32_t node = 0; node < nodes.size(); ++node)
        for (std::uint32_t at = node; nodes[at].parent != ref::no_node; at = nodes[at].parent)
            ++depth[node];
    return depth;
}

} // namespace

std::string radix_tree_figure(ref::Codes codes, std::span<const std::uint32_t> primitives, int code_bits)
{
    const auto n = static_cast<std::int64_t>(codes.size());
    const std::vector<ref::Node> nodes = ref::radix_tree(codes);
    const std::vector<int> depth = depths(nodes);
    const int deepest = depth.empty() ? 0 : *std::max_element(depth.begin(), depth.end());
    const int keys_top = y_of(deepest) + row_height / 2;
    const int bits = telling_bits(codes, code_bits);
    Svg svg;

    // Internal node i is drawn above key i, one end of its range; leaves above their keys.
    const auto x_of_node = [&](std::uint32_t node) {
        return x_of(node < n - 1 ? node : node - (n - 1));
    };
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
        const auto [first, last, gamma] = ref::radix_node(codes, i);
        const int y = y_of(depth[i]);
        svg.line(x_of(first), y, x_of(last), y, blue, 4);
        const int split = (x_of(gamma) + x_of(gamma + 1)) / 2;
        svg.line(split, y - 9, split, y + 9, red, 3);
        for (const std::uint32_t child : nodes[i].children) {
            const bool leaf = child >= n - 1;
            svg.line(x_of_node(child), y, x_of_node(child), leaf ? keys_top : y_of(depth[child]), grey,
                     1);
        }
    }
    for (std::uint32_t i = 0; i + 1 < n; ++i) {
        svg.circle(x_of(i), y_of(depth[i]), 11, blue);
        svg.label(x_of(i), y_of(depth[i]) + 5, i, blue);
    }
    for (std::int64_t key = 0; key < n; ++key) {
        const auto at = static_cast<std::size_t>(key);
        svg.label(x_of(key), keys_top + 14, key, "black");
        for (int bit = 0; bit < bits; ++bit)
            svg.label(x_of(key), keys_top + 34 + bit * bit_row, codes[at] >> (code_bits - 1 - bit) & 1,
                      blue);
        svg.label(x_of(key), keys_top + 44 + bits * bit_row, "#" + std::to_string(primitives[at]), grey);
    }
    return svg.document(2 * margin + static_cast<int>(n) * column,
                        keys_top + 44 + bits * bit_row + margin);
}

} // namespace cli
