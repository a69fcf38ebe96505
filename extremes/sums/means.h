#pragma once

// Ways to compute the mean of samples: those of our own film, and the usual ones. Each has add(float)
// and mean(count).

#include "cuda/transport/exact_sum.h"
#include "images/film.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace extremes {

constexpr std::uint64_t samples_of_batch = 4; // RenderOptions::batch_size
constexpr std::uint64_t one_batch = std::numeric_limits<std::uint64_t>::max();

template <class F>
struct NaiveMean {
    F sum = 0;
    void add(float x) { sum += static_cast<F>(x); }
    [[nodiscard]] double mean(std::uint64_t count) const
    {
        return static_cast<double>(sum / static_cast<F>(count));
    }
};

struct KahanMean { // compensated summation [Kahan 1965]
    float sum = 0, lost = 0;
    void add(float x)
    {
        const float y = x - lost;
        const float t = sum + y;
        lost = (t - sum) - y;
        sum = t;
    }
    [[nodiscard]] double mean(std::uint64_t count) const { return sum / static_cast<float>(count); }
};

struct RunningMean { // in floats, as of a progressive preview
    float value = 0, count = 0;
    void add(float x)
    {
        count += 1.0f;
        value += (x - value) / count;
    }
    [[nodiscard]] double mean(std::uint64_t /*count*/) const { return value; }
};

/// A batch of a picture of one pixel.
inline images::Image batch_of(double value)
{
    images::Image batch{1, 1};
    batch.pixels[0] = images::Rgb(value);
    return batch;
}

/// The film of a picture of one pixel. Samples of a batch are summed in the format F: the reference sums
/// doubles, the fast path floats.
template <class F, std::uint64_t batch_size>
struct FilmMean {
    images::Film film{1, 1};
    images::Image batch{1, 1};
    F sum = 0;
    std::uint64_t in_batch = 0;
    void add(float x)
    {
        sum += static_cast<F>(x);
        if (++in_batch == batch_size) finish();
    }
    void finish()
    {
        batch.pixels[0] =
            images::Rgb(static_cast<double>(sum / static_cast<F>(std::min(batch_size, in_batch))));
        film.add_batch(batch);
        sum = 0;
        in_batch = 0;
    }
    [[nodiscard]] double mean(std::uint64_t /*count*/)
    {
        if (in_batch > 0) finish();
        return film.mean().pixels[0].r;
    }
};

struct DeterministicMean { // the splats of --deterministic
    fast::ExactSum sum{};
    void add(float x) { sum.add(x); }
    [[nodiscard]] double mean(std::uint64_t count) const
    {
        return sum.value() / static_cast<double>(count);
    }
};

} // namespace extremes
