#include "images/strategy_sheet.h"

#include "images/label.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace images {

namespace {

constexpr int gap = 6;
constexpr int label_height = 14;
constexpr int margin = 84; // for the names of the rows

void paste(Image& sheet, const Image& cell, int x0, int y0, double brightness)
{
    for (int y = 0; y < cell.height; ++y)
        for (int x = 0; x < cell.width; ++x)
            sheet.pixels[static_cast<std::size_t>(y0 + y) * static_cast<std::size_t>(sheet.width) +
                         static_cast<std::size_t>(x0 + x)] =
                brightness *
                cell.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(cell.width) +
                            static_cast<std::size_t>(x)];
}

std::string label_of(int s, int t)
{
    return "s = " + std::to_string(s) + ", t = " + std::to_string(t);
}

} // namespace

Image strategy_sheet(const Strategies& strategies)
{
    if (strategies.empty())
        throw std::invalid_argument("no strategy found any light: there is no sheet to draw");
    const Image& first = strategies.begin()->second;
    int longest = 1;
    for (const auto& [strategy, image] : strategies) {
        longest = std::max(longest, strategy.first + strategy.second - 1);
        if (image.width != first.width || image.height != first.height)
            throw std::invalid_argument("the pictures of the strategies differ in size");
    }

    const int label_width = text_width(label_of(longest, longest + 1));
    const int column = std::max(first.width, label_width) + gap;
    const int row = first.height + label_height + gap;
    Image sheet(margin + (longest + 1) * column, gap + longest * row);
    std::fill(sheet.pixels.begin(), sheet.pixels.end(), Rgb(0.05));
    const Image black(first.width, first.height);
    for (int k = 1; k <= longest; ++k) {
        const int y = gap + (k - 1) * row;
        const int stops = std::max(0, k - 2);
        draw_text(sheet, gap, y + label_height, "k = " + std::to_string(k), Rgb(0.8));
        if (stops > 0)
            draw_text(sheet, gap, y + 2 * label_height, "+" + std::to_string(stops) + " stops",
                      Rgb(0.4));
        const int left = margin + (longest - k) * column / 2; // rows are centred: a triangle
        for (int s = 0; s <= k; ++s) {
            const int t = k + 1 - s;
            const int x = left + s * column;
            const auto found = strategies.find({s, t});
            draw_text(sheet, x, y + 2, label_of(s, t), found != strategies.end() ? Rgb(0.8) : Rgb(0.2));
            paste(sheet, found != strategies.end() ? found->second : black, x, y + label_height,
                  std::exp2(stops));
        }
    }
    return sheet;
}

} // namespace images
