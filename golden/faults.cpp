#include "golden/faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace golden {

namespace {

using images::Image;
using images::Rgb;

/// The picture whose pixel (x, y) is the one of `picture` at from(x, y).
template <class From>
Image rearranged(const Image& picture, const From& from)
{
    Image result(picture.width, picture.height);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto [column, row] = from(x, y);
            result.at(x, y) = picture.at(column, row);
        }
    return result;
}

template <class From> // from(x, y, last column, last row)
Fault moved(std::string is, bool square_only, From from)
{
    return {std::move(is), [square_only, from](const Image& picture, const Image& /*golden*/) {
                if (square_only && picture.width != picture.height) return std::optional<Image>();
                return std::optional(rearranged(picture, [&](int x, int y) {
                    return from(x, y, picture.width - 1, picture.height - 1);
                }));
            }};
}

using Place = std::array<int, 2>;

/// `picture` was shifted by (dx, dy) pixels. The golden's pixels stand where the shift lost some.
Fault shifted(std::string is, int dx, int dy)
{
    return {std::move(is), [dx, dy](const Image& picture, const Image& golden) {
                Image result = golden;
                for (int y = 0; y < picture.height; ++y)
                    for (int x = 0; x < picture.width; ++x) {
                        const int column = x + dx;
                        const int row = y + dy;
                        if (column >= 0 && column < picture.width && row >= 0 && row < picture.height)
                            result.at(x, y) = picture.at(column, row);
                    }
                return std::optional(result);
            }};
}

template <class Decode>
std::optional<Image> decoded(const Image& picture, const Decode& decode)
{
    Image result = picture;
    for (Rgb& pixel : result.pixels)
        for (int c = 0; c < 3; ++c) {
            if (pixel[c] < 0.0) return std::nullopt;
            pixel[c] = decode(pixel[c]);
        }
    return result;
}

double decode_srgb(double value) // IEC 61966-2-1
{
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

/// All values are at most 1, and those that the golden has above 1 were cut: the golden's own stand for
/// them.
std::optional<Image> without_clamped(const Image& picture, const Image& golden)
{
    Image result = picture;
    bool any = false;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            if (picture.pixels[i][c] > 1.0) return std::nullopt;
            // Noise below 1 that was above it in other samples: a margin in which both may be.
            if (golden.pixels[i][c] < 0.5) continue;
            any = any || golden.pixels[i][c] > 1.0;
            result.pixels[i][c] = golden.pixels[i][c];
        }
    return any ? std::optional(result) : std::nullopt;
}

} // namespace

std::vector<Fault> usual_faults()
{
    std::vector<Fault> faults = {
        moved("upside down", false,
              [](int x, int y, int, int bottom) {
                  return Place{x, bottom - y};
              }),
        moved("mirrored, left for right", false,
              [](int x, int y, int right, int) {
                  return Place{right - x, y};
              }),
        moved("rotated by 180 degrees", false,
              [](int x, int y, int right, int bottom) {
                  return Place{right - x, bottom - y};
              }),
        moved("transposed, rows for columns", true,
              [](int x, int y, int, int) {
                  return Place{y, x};
              }),
        moved("rotated by 90 degrees", true,
              [](int x, int y, int right, int) {
                  return Place{right - y, x};
              }),
        moved("rotated by 270 degrees", true,
              [](int x, int y, int, int bottom) {
                  return Place{y, bottom - x};
              }),
        shifted("shifted by one pixel to the right", 1, 0),
        shifted("shifted by one pixel to the left", -1, 0),
        shifted("shifted by one pixel downwards", 0, 1),
        shifted("shifted by one pixel upwards", 0, -1),
    };
    for (const auto& [order, is] : {std::pair(std::array{2, 1, 0}, "in the order blue, green, red"),
                                    std::pair(std::array{1, 0, 2}, "with red and green exchanged"),
                                    std::pair(std::array{0, 2, 1}, "with green and blue exchanged"),
                                    std::pair(std::array{1, 2, 0}, "in the order blue, red, green"),
                                    std::pair(std::array{2, 0, 1}, "in the order green, blue, red")})
        faults.push_back({is, [order = order](const Image& picture, const Image&) {
                              Image result = picture;
                              for (Rgb& pixel : result.pixels)
                                  pixel = {pixel[order[0]], pixel[order[1]], pixel[order[2]]};
                              return std::optional(result);
                          }});
    faults.push_back({"encoded as sRGB",
                      [](const Image& picture, const Image&) { return decoded(picture, decode_srgb); }});
    faults.push_back({"encoded with a gamma of 2.2", [](const Image& picture, const Image&) {
                          return decoded(picture, [](double value) { return std::pow(value, 2.2); });
                      }});
    faults.push_back({"clamped at 1", without_clamped});
    return faults;
}

std::vector<KnownFactor> known_factors(double samples)
{
    constexpr double pi = std::numbers::pi;
    std::vector<KnownFactor> factors = {
        {"1/2", 0.5},
        {"2", 2.0},
        {"pi", pi},
        {"1/pi", 1.0 / pi},
        {"2 pi", 2.0 * pi},
        {"4 pi", 4.0 * pi},
        {"1/(2 pi)", 0.5 / pi},
        {"1/(4 pi)", 0.25 / pi},
    };
    if (samples > 1.0) {
        factors.push_back({"the number of samples per pixel", samples});
        factors.push_back({"1 / samples per pixel", 1.0 / samples});
    }
    return factors;
}

} // namespace golden
