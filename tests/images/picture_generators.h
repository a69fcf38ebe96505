#pragma once

// Random pictures for RapidCheck: small, of odd sizes, with all kinds of floats.

#include "images/film.h"

#include <rapidcheck.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace images_test {

/// Every bit pattern: normal, denormal, zeros of both signs, infinite, NaN. RapidCheck's own numbers
/// grow with the size parameter and are mostly small as integers, which as bits are denormals.
inline rc::Gen<float> any_float()
{
    return rc::gen::map(rc::gen::resize(100, rc::gen::arbitrary<std::uint32_t>()),
                        [](std::uint32_t bits) { return std::bit_cast<float>(bits); });
}

inline rc::Gen<double> any_double()
{
    return rc::gen::map(rc::gen::resize(100, rc::gen::arbitrary<std::uint64_t>()),
                        [](std::uint64_t bits) { return std::bit_cast<double>(bits); });
}

/// A picture of 1x1 to 19x19 pixels, or of the given size, from a generator of values.
template <class Value>
images::Image any_image(const rc::Gen<Value>& value, int width = 0, int height = 0)
{
    if (width == 0)
        std::tie(width, height) = *rc::gen::pair(rc::gen::inRange(1, 20), rc::gen::inRange(1, 20));
    images::Image image(width, height);
    const auto values = *rc::gen::container<std::vector<Value>>(image.pixels.size() * 3, value);
    for (std::size_t i = 0; i < values.size(); ++i)
        image.pixels[i / 3][static_cast<int>(i % 3)] = static_cast<double>(values[i]);
    return image;
}

/// Whether the bits are the same, or both are NaN: conversions between float and double may change a
/// NaN.
inline bool same_value(double a, double b)
{
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool same_values(const images::Image& a, const images::Image& b)
{
    if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size()) return false;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            if (!same_value(a.pixels[i][channel], b.pixels[i][channel])) return false;
    return true;
}

/// Whether every bit is the same, also in NaNs.
inline bool same_bits(const images::Image& a, const images::Image& b)
{
    if (a.width != b.width || a.height != b.height || a.pixels.size() != b.pixels.size()) return false;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            if (std::bit_cast<std::uint64_t>(a.pixels[i][channel]) !=
                std::bit_cast<std::uint64_t>(b.pixels[i][channel]))
                return false;
    return true;
}

/// `image` after its values were stored as floats in a file.
inline images::Image rounded_to_float(images::Image image)
{
    for (images::Rgb& pixel : image.pixels)
        for (int channel = 0; channel < 3; ++channel)
            pixel[channel] = static_cast<double>(static_cast<float>(pixel[channel]));
    return image;
}

/// A film that holds `image` as its mean, for pictures that were never rendered.
inline images::Film film_of(const images::Image& image)
{
    return {image.width, image.height, {0, 1}, {{image, images::Image(image.width, image.height)}}};
}

} // namespace images_test
