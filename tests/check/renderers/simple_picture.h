#pragma once

// The truth that the simulated goldens and the fake renderer share.

#include "images/image.h"

namespace renderers_test {

/// Not symmetric in any way, with values above 1.
inline images::Image simple_picture(int size)
{
    images::Image image(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (x + 0.5) / size;
            const double v = (y + 0.5) / size;
            image.at(x, y) = {0.2 + 0.9 * u, 0.3 + 1.2 * v * v, 0.25 + 0.4 * u * v};
        }
    return image;
}

} // namespace renderers_test
