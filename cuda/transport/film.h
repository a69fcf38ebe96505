#pragma once

// Where contributions go: sums of one batch, in the memory of the kernels.

#include "cuda/transport/exact_sum.h"
#include "cuda/transport/sampling.h"
#include "cuda/trees/aabb.h"

#include <span>

namespace fast {

/// The layers of strategies (s, t) of up to k edges come in the order of k, then of s.
HD constexpr std::uint32_t layer_of(int s, int t)
{
    const int k = s + t - 1;
    return static_cast<std::uint32_t>((k - 1) * (k + 2) / 2 + s);
}

/// Pictures that any sample can add to at any pixel: one that shows all splats, then one for each
/// strategy (s, 1). Either as floats, or exact.
struct SplatTarget {
    std::span<Rgb> sums;
    std::span<ExactSum> exact; // three for each of those; empty: floats
    HD void add(std::size_t i, const Rgb& value) const
    {
        for (int channel = 0; channel < 3; ++channel) {
            if (exact.empty())
                fast::add(sums[i][channel], value[channel]);
            else
                exact[3 * i + static_cast<std::size_t>(channel)].add(value[channel]);
        }
    }
};

/// What was left out because it is not finite: how many contributions, and the least of their keys.
struct DroppedCount {
    std::uint64_t count = 0;
    std::uint64_t least_key = ~std::uint64_t{0};
};

/// The place of a contribution in the order of (pixel, s, t); walks of more than 65,535 vertices share
/// one.
HD constexpr std::uint64_t dropped_key(std::uint32_t pixel, int s, int t)
{
    const auto part = [](int n) { return static_cast<std::uint64_t>(n < 0xffff ? n : 0xffff); };
    return std::uint64_t{pixel} << 32 | part(s) << 16 | part(t);
}

/// What a launch of samples writes to.
struct FilmTarget {
    std::span<Rgb> own; // by index of the launch: what the sample adds to its own pixel
    SplatTarget splats;
    std::span<Rgb> layers; // strategy after strategy, a picture each; none: they are not wanted
    std::span<DroppedCount> dropped; // one
    bool weighted;                   // layers
    std::uint32_t pixels;            // of the picture
};

/// Takes the contributions of one sample.
class FilmSink {
public:
    HD FilmSink(const FilmTarget& target, std::uint32_t pixel) : target_(target), pixel_(pixel) {}

    /// To the sample's own pixel.
    HD void add(int s, int t, const Rgb& value, float weight)
    {
        if (drop(pixel_, s, t, value, weight)) return;
        own_ += weight * value;
        // Only one sample of a pixel is under way when there are layers, so nobody else adds here.
        if (!target_.layers.empty())
            target_.layers[place(layer_of(s, t), pixel_)] += target_.weighted ? weight * value : value;
    }
    /// To any pixel, with t = 1.
    HD void splat(std::uint32_t pixel, int s, const Rgb& value, float weight)
    {
        if (drop(pixel, s, 1, value, weight)) return;
        target_.splats.add(pixel, weight * value);
        if (!target_.layers.empty())
            target_.splats.add(place(static_cast<std::uint32_t>(s), pixel),
                               target_.weighted ? weight * value : value);
    }
    [[nodiscard]] HD const Rgb& own() const { return own_; }

private:
    /// Whether it is not finite, and so must not reach the picture.
    HD bool drop(std::uint32_t pixel, int s, int t, const Rgb& value, float weight)
    {
        if (is_finite(value) && std::isfinite(weight)) return false;
        DroppedCount& dropped = target_.dropped[0];
        fast::add(dropped.count, std::uint64_t{1});
        take_least(dropped.least_key, dropped_key(pixel, s, t));
        return true;
    }
    [[nodiscard]] HD std::size_t place(std::uint32_t picture, std::uint32_t pixel) const
    {
        return static_cast<std::size_t>(picture) * target_.pixels + pixel;
    }

    const FilmTarget& target_;
    std::uint32_t pixel_;
    Rgb own_{0.0f};
};

/// Kernel over the pixels of a launch: adds its samples, in their order.
struct SumSamples {
    std::span<const Rgb> own;
    std::span<Rgb> sums; // the picture's
    std::uint32_t first_pixel, pixels, samples;

    HD void operator()(std::uint32_t index) const
    {
        for (std::uint32_t i = 0; i < samples; ++i) sums[first_pixel + index] += own[i * pixels + index];
    }
};

/// Kernel over elements: each gets its default value, which is 0 for numbers.
template <class T>
struct Clear {
    std::span<T> elements;
    HD void operator()(std::uint32_t index) const { elements[index] = T{}; }
};

} // namespace fast
