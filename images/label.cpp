#include "images/label.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <vector>

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb_easy_font.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

namespace images {

namespace {

/// A corner of one of the rectangles that letters are made of, as stb_easy_font lays it out.
struct Corner {
    float x, y, z;
    std::array<unsigned char, 4> color;
};

} // namespace

void draw_text(Image& image, int x, int y, const std::string& text, const Rgb& color, int scale)
{
    std::vector<char> letters(text.begin(), text.end()); // the library wants a string it may write to
    letters.push_back('\0');
    std::vector<Corner> corners(4 * 64 * (text.size() + 1));
    const int rectangles = stb_easy_font_print(0.0F, 0.0F, letters.data(), nullptr, corners.data(),
                                               static_cast<int>(corners.size() * sizeof(Corner)));
    for (int i = 0; i < rectangles; ++i) {
        const Corner& low = corners[static_cast<std::size_t>(4 * i)];
        const Corner& high = corners[static_cast<std::size_t>(4 * i + 2)];
        const int x1 = std::min(image.width, x + static_cast<int>(high.x) * scale);
        const int y1 = std::min(image.height, y + static_cast<int>(high.y) * scale);
        for (int py = std::max(0, y + static_cast<int>(low.y) * scale); py < y1; ++py)
            for (int px = std::max(0, x + static_cast<int>(low.x) * scale); px < x1; ++px)
                image.pixels[static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width) +
                             static_cast<std::size_t>(px)] = color;
    }
}

int text_width(const std::string& text, int scale)
{
    std::vector<char> letters(text.begin(), text.end());
    letters.push_back('\0');
    return stb_easy_font_width(letters.data()) * scale;
}

} // namespace images
