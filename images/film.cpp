// Mean and variance in one pass [Welford 1962]: batch number n moves the mean by 1/n of its distance and
// adds to the squares the product of its distances from the old and from the new mean.
// Only + - * / and sqrt are used, which IEEE 754 rounds alike on every machine.

#include "images/film.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace images {

namespace {

bool same_size(const Image& a, const Image& b)
{
    return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size();
}

} // namespace

Film::Film(Image mean, Image squares, std::uint64_t batches)
    : mean_(std::move(mean)), squares_(std::move(squares)), batches_(batches)
{
    if (!same_size(mean_, squares_))
        throw std::invalid_argument("film: mean and squares differ in size");
}

void Film::add_batch(const Image& batch)
{
    if (!same_size(batch, mean_)) throw std::invalid_argument("film: the batch differs in size");
    ++batches_;
    const auto count = static_cast<double>(batches_);
    for (std::size_t i = 0; i < batch.pixels.size(); ++i) {
        const Rgb from_old_mean = batch.pixels[i] - mean_.pixels[i];
        mean_.pixels[i] += from_old_mean / count;
        // map: welford [Welford 1962]
        squares_.pixels[i] += from_old_mean * (batch.pixels[i] - mean_.pixels[i]);
    }
}

Image Film::standard_error() const
{
    Image error(mean_.width, mean_.height);
    const auto count = static_cast<double>(batches_);
    for (std::size_t i = 0; i < error.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            error.pixels[i][channel] =
                batches_ < 2 ? std::numeric_limits<double>::infinity()
                             // map: standard-error
                             : std::sqrt(squares_.pixels[i][channel] / (count * (count - 1.0)));
    return error;
}

} // namespace images
