#pragma once

// Drawings as SVG, one element per line, to be read by people, too.

#include <sstream>
#include <string>

namespace figures {

constexpr const char* svg_blue = "#1f5fa8";
constexpr const char* svg_red = "#c2410c";
constexpr const char* svg_grey = "#8a8f98";
constexpr const char* svg_pale_blue = "#cfe1f5";

/// A drawing. Lengths are in pixels, y points down. Colours are those of CSS. Text is drawn as it is: it
/// must not contain '<' or '&'.
class Svg {
public:
    void line(int x1, int y1, int x2, int y2, const char* color, int width = 1, const char* dashes = "")
    {
        text_ << "<line x1='" << x1 << "' y1='" << y1 << "' x2='" << x2 << "' y2='" << y2 << "' stroke='"
              << color << "' stroke-width='" << width << "'";
        if (*dashes != '\0') text_ << " stroke-dasharray='" << dashes << "'";
        text_ << "/>\n";
    }
    void circle(int x, int y, int radius, const char* fill, const char* border)
    {
        text_ << "<circle cx='" << x << "' cy='" << y << "' r='" << radius << "' fill='" << fill
              << "' stroke='" << border << "' stroke-width='2'/>\n";
    }
    void rectangle(int x, int y, int width, int height, const char* fill, const char* border,
                   int border_width = 1)
    {
        text_ << "<rect x='" << x << "' y='" << y << "' width='" << width << "' height='" << height
              << "' fill='" << fill << "' stroke='" << border << "' stroke-width='" << border_width
              << "'/>\n";
    }
    /// `anchor`: start, middle or end, where x is in the text; y is its base line.
    void label(int x, int y, const std::string& text, const char* color = "black", int size = 13,
               const char* anchor = "middle")
    {
        text_ << "<text x='" << x << "' y='" << y << "' fill='" << color << "' font-size='" << size
              << "' text-anchor='" << anchor << "'>" << text << "</text>\n";
    }
    /// A horizontal arrow from (x1, y) to (x2, y).
    void arrow(int x1, int x2, int y, const char* color)
    {
        const int back = x2 > x1 ? -7 : 7;
        line(x1, y, x2, y, color, 3);
        line(x2 + back, y - 6, x2, y, color, 3);
        line(x2 + back, y + 6, x2, y, color, 3);
    }
    /// The whole file, on white.
    [[nodiscard]] std::string document(int width, int height) const
    {
        std::ostringstream all;
        all << "<svg xmlns='http://www.w3.org/2000/svg' width='" << width << "' height='" << height
            << "' viewBox='0 0 " << width << ' ' << height << "' font-family='monospace'>\n"
            << "<rect width='100%' height='100%' fill='white'/>\n"
            << text_.str() << "</svg>\n";
        return all.str();
    }

private:
    std::ostringstream text_;
};

} // namespace figures
