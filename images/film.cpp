// Mean and variance of two sets of batches together, from those of each [Chan, Golub, LeVeque 1979,
// eq. 2.1]. Only + - * / and sqrt are used, which IEEE 754 rounds alike on every machine.

#include "images/film.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace images {

namespace {

bool has_size(const Image& image, int width, int height)
{
    return image.width == width && image.height == height &&
           image.pixels.size() == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

} // namespace

void BatchMoments::join(const BatchMoments& other, std::uint64_t own, std::uint64_t others)
{
    const auto m = static_cast<double>(own);
    const auto n = static_cast<double>(others);
    const double share = n / (m + n);
    for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
        // map: moments [Chan, Golub, LeVeque 1979, eq. 2.1]
        const Rgb distance = other.mean.pixels[i] - mean.pixels[i];
        mean.pixels[i] += distance * share;
        squares.pixels[i] += other.squares.pixels[i] + distance * distance * (m * share);
    }
}

Film::Film(int width, int height, const BatchRange& range, std::vector<BatchMoments> blocks)
    : width_(width), height_(height), fold_(range, std::move(blocks))
{
    for (const BatchMoments& block : fold_.blocks())
        if (!has_size(block.mean, width, height) || !has_size(block.squares, width, height))
            throw std::invalid_argument("film: mean and squares differ in size");
}

void Film::add_batch(const Image& batch)
{
    if (!has_size(batch, width_, height_))
        throw std::invalid_argument("film: the batch differs in size");
    fold_.add({batch, Image(width_, height_)});
}

void Film::append(Film next)
{
    if (next.width_ != width_ || next.height_ != height_)
        throw std::invalid_argument("film: the other film differs in size");
    fold_.append(std::move(next.fold_));
}

BatchMoments Film::moments() const
{
    return fold_.total({Image(width_, height_), Image(width_, height_)});
}

Image Film::standard_error() const
{
    return images::standard_error(moments(), batches());
}

Image standard_error(const BatchMoments& moments, std::uint64_t batches)
{
    Image error(moments.mean.width, moments.mean.height);
    const auto count = static_cast<double>(batches);
    for (std::size_t i = 0; i < error.pixels.size(); ++i)
        for (int channel = 0; channel < 3; ++channel)
            error.pixels[i][channel] =
                batches < 2 ? std::numeric_limits<double>::infinity()
                            // map: standard-error
                            : std::sqrt(moments.squares.pixels[i][channel] / (count * (count - 1.0)));
    return error;
}

} // namespace images
