#include "trade/relative_error.h"

namespace trade {

images::Image relative_weights(const images::Image& truth)
{
    const double channels = 3.0 * static_cast<double>(truth.pixels.size());
    double m = 0.0;
    for (const images::Rgb& pixel : truth.pixels) m += (pixel.x + pixel.y + pixel.z) / channels;
    images::Image weights(truth.width, truth.height);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        weights.pixels[i] = 1.0 / (truth.pixels[i] * truth.pixels[i] + 1e-4 * m * m);
    return weights;
}

double weighted_square(const images::Image& weights, const images::Image& a, const images::Image& b)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const images::Rgb d = a.pixels[i] - b.pixels[i];
        const images::Rgb& w = weights.pixels[i];
        sum += w.x * d.x * d.x + w.y * d.y * d.y + w.z * d.z * d.z;
    }
    return sum / (3.0 * static_cast<double>(a.pixels.size()));
}

} // namespace trade
