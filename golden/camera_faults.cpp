#include "golden/camera_faults.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace golden {

namespace {

using images::Image;
using images::Rgb;

/// Gives blocks of this size that have a negative value their mean, unless that is negative. Returns
/// whether any value is still negative.
bool spread(Image& image, int channel, int size)
{
    bool left = false;
    for (int top = 0; top < image.height; top += size)
        for (int start = 0; start < image.width; start += size) {
            const int bottom = std::min(top + size, image.height);
            const int end = std::min(start + size, image.width);
            double sum = 0.0;
            bool negative = false;
            for (int y = top; y < bottom; ++y)
                for (int x = start; x < end; ++x) {
                    sum += image.at(x, y)[channel];
                    negative = negative || image.at(x, y)[channel] < 0.0;
                }
            left = left || (negative && sum < 0.0);
            if (!negative || sum < 0.0) continue;
            for (int y = top; y < bottom; ++y)
                for (int x = start; x < end; ++x)
                    image.at(x, y)[channel] = sum / ((bottom - top) * (end - start));
        }
    return left;
}

/// Spreads negative light as rendered_fault says. False if the whole picture is negative.
bool spread_negative(Image& image)
{
    for (int channel = 0; channel < 3; ++channel)
        for (int size = 1; spread(image, channel, size); size *= 2)
            if (size > std::max(image.width, image.height)) return false;
    return true;
}

/// The mean of 2x2 pixels of `fine` for each pixel, from (2x + dx, 2y + dy) on; NaN where they are
/// outside.
Image halved(const Image& fine, int dx, int dy)
{
    Image result(fine.width / 2, fine.height / 2);
    for (int y = 0; y < result.height; ++y)
        for (int x = 0; x < result.width; ++x) {
            const int column = 2 * x + dx;
            const int row = 2 * y + dy;
            const bool inside =
                column >= 0 && row >= 0 && column + 1 < fine.width && row + 1 < fine.height;
            result.at(x, y) = inside ? 0.25 * (fine.at(column, row) + fine.at(column + 1, row) +
                                               fine.at(column, row + 1) + fine.at(column + 1, row + 1))
                                     : Rgb(std::numeric_limits<double>::quiet_NaN());
        }
    return result;
}

} // namespace

Fault rendered_fault(std::string is, Image wrong, Image right)
{
    return {std::move(is), [wrong = std::move(wrong), right = std::move(right)](const Image& picture,
                                                                                const Image& golden) {
                if (wrong.pixels.size() != picture.pixels.size() || wrong == right)
                    return std::optional<Image>();
                Image result = picture;
                for (std::size_t i = 0; i < result.pixels.size(); ++i) {
                    const Rgb& from = wrong.pixels[i];
                    if (std::isnan(from.r) || std::isnan(from.g) || std::isnan(from.b))
                        result.pixels[i] = golden.pixels[i];
                    else if (from != right.pixels[i])
                        result.pixels[i] += right.pixels[i] - from;
                }
                return spread_negative(result) ? std::optional(std::move(result)) : std::nullopt;
            }};
}

Fault ratio_fault(std::string is, Image wrong)
{
    return {std::move(is), [wrong = std::move(wrong)](const Image& picture, const Image& golden) {
                if (wrong.pixels.size() != picture.pixels.size()) return std::optional<Image>();
                Image result = golden;
                for (std::size_t i = 0; i < result.pixels.size(); ++i)
                    for (int c = 0; c < 3; ++c) {
                        const double from = wrong.pixels[i][c];
                        if (from > 0.0) result.pixels[i][c] *= picture.pixels[i][c] / from;
                        if (from == 0.0) result.pixels[i][c] += picture.pixels[i][c];
                    }
                return std::optional(std::move(result));
            }};
}

std::vector<Fault> half_pixel_faults(const Image& fine)
{
    const Image right = halved(fine, 0, 0);
    std::vector<Fault> faults;
    std::vector<Fault> ratios;
    for (const auto& [dx, across] : {std::pair(0, ""), {1, "to the right"}, {-1, "to the left"}})
        for (const auto& [dy, along] : {std::pair(0, ""), {1, "downwards"}, {-1, "upwards"}}) {
            if (dx == 0 && dy == 0) continue;
            const std::string both = dx != 0 && dy != 0 ? " and " : "";
            const std::string is = std::string("shifted by half a pixel ") + across + both + along;
            const Image wrong = halved(fine, -dx, -dy); // what moves to the right is taken from the left
            faults.push_back(rendered_fault(is, wrong, right));
            ratios.push_back(ratio_fault(is, wrong));
        }
    faults.insert(faults.end(), ratios.begin(), ratios.end());
    return faults;
}

} // namespace golden
