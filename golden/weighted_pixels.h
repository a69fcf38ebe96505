#pragma once

// The pixels of a linear functional.

#include "golden/functionals.h"

#include <cstddef>

namespace golden {

/// Calls visit(pixel, weight) for each pixel with a weight in this functional
/// (Functionals::pixel_weight), row by row. Only the box around the region is searched.
template <class Visit>
void for_each_pixel(const Functionals& functionals, std::size_t functional, std::size_t channel,
                    const Visit& visit)
{
    const Region& region = functionals.regions()[functionals.at(functional).region];
    for (int y = region.y0; y < region.y1; ++y)
        for (int x = region.x0; x < region.x1; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(functionals.width()) +
                           static_cast<std::size_t>(x);
            const double weight = functionals.pixel_weight(functional, channel, i);
            if (weight != 0.0) visit(i, weight);
        }
}

} // namespace golden
