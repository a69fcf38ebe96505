#include "images/png.h"
#include "images/atomic_file.h"
#include "images/picture_size.h"

#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace images {

namespace {

/// The curve of sRGB from linear light in [0, 1] to the stored value in [0, 1]. [IEC 61966-2-1]
double encode_srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

} // namespace

Srgb8 to_srgb8(const Rgb& linear, double exposure)
{
    if (std::isnan(linear.r) || std::isnan(linear.g) || std::isnan(linear.b)) return nan_color;
    Srgb8 bytes{};
    for (int channel = 0; channel < 3; ++channel) {
        // exp2 may overflow to infinity, and 0 times infinity is NaN: black stays black.
        const double exposed = linear[channel] > 0.0 ? linear[channel] * std::exp2(exposure) : 0.0;
        bytes[static_cast<std::size_t>(channel)] =
            static_cast<std::uint8_t>(std::lround(255.0 * encode_srgb(std::min(exposed, 1.0))));
    }
    return bytes;
}

std::string encode_png(const Image& image, double exposure)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const Rgb& pixel : image.pixels) {
        const Srgb8 color = to_srgb8(pixel, exposure);
        bytes.insert(bytes.end(), color.begin(), color.end());
    }
    std::string png;
    const auto append = [](void* context, void* data, int size) {
        static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                                   static_cast<std::size_t>(size));
    };
    if (stbi_write_png_to_func(append, &png, image.width, image.height, 3, bytes.data(),
                               3 * image.width) == 0)
        throw std::invalid_argument("the PNG encoder failed");
    return png;
}

void write_png(const std::filesystem::path& path, const Image& image, double exposure)
{
    check_size(path, image);
    write_atomically(path, encode_png(image, exposure));
}

} // namespace images
