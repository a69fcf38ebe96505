#pragma once

// Contributions that were left out of a picture because they are not finite.

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>

namespace images {

/// Contributions with a channel that is NaN or infinite: how many, and the first of them in the order of
/// (pixel, s, t), which does not depend on threads.
struct Dropped {
    std::uint64_t count = 0;
    std::uint32_t pixel = 0; // that it would have been added to: y * width + x
    int s = 0, t = 0;        // its strategy [Veach 1997, sec. 10.2]

    Dropped& operator+=(const Dropped& other)
    {
        if (other.count == 0) return *this;
        const auto place = [](const Dropped& d) { return std::tuple(d.pixel, d.s, d.t); };
        const Dropped first = count == 0 || place(other) < place(*this) ? other : *this;
        const std::uint64_t sum = count + other.count;
        *this = first;
        count = sum;
        return *this;
    }
};

/// For people: "3 contributions are not finite and were left out, the first at pixel (4, 7) by strategy
/// s2t1". `width`: of the picture.
inline std::string describe(const Dropped& dropped, int width)
{
    const auto columns = static_cast<std::uint32_t>(std::max(width, 1));
    return std::to_string(dropped.count) +
           " contribution(s) are not finite and were left out, the first at pixel (" +
           std::to_string(dropped.pixel % columns) + ", " + std::to_string(dropped.pixel / columns) +
           ") by strategy s" + std::to_string(dropped.s) + "t" + std::to_string(dropped.t);
}

} // namespace images
