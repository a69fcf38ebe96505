#include "golden/pilot.h"

#include "golden/rounded.h"

#include <cmath>
#include <stdexcept>

namespace golden {

Pilot make_pilot(const images::Film& film)
{
    if (film.batches() < 2) throw std::invalid_argument("a pilot needs two batches at least");
    const images::BatchMoments moments = film.moments();
    Pilot pilot{moments.mean, images::Image(film.width(), film.height()), film.batches()};
    for (std::size_t i = 0; i < pilot.mean.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel) {
            double& mean = pilot.mean.pixels[i][channel];
            mean = static_cast<double>(to_float(mean));
            const double variance =
                moments.squares.pixels[i][channel] / static_cast<double>(film.batches() - 1);
            if (mean > 0.0) pilot.noise.pixels[i][channel] = rounded_to_half(std::sqrt(variance) / mean);
        }
    return pilot;
}

} // namespace golden
