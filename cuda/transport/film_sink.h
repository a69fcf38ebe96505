#pragma once

// The sums of one batch, to which contributions are added, in the memory of the kernels.

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

/// Pictures that any sample can add to at any pixel: one with all splats, then one for each strategy
/// (s, 1). The sums are either floats or exact.
struct SplatTarget {
    std::span<Rgb> sums;
    std::span<ExactSum> exact; // three for each of the pixels above; empty: sums are floats
    std::size_t copies = 1;    // of the pictures, one after the other in `sums`
    bool alone = false;        // no other thread adds to `sums`, so that nothing need be atomic

    /// The copy of one of `threads` threads; all that there is if there is not one for each.
    [[nodiscard]] SplatTarget of_thread(std::size_t thread, std::size_t threads) const
    {
        if (copies != threads) return *this;
        const std::size_t each = sums.size() / copies;
        return {sums.subspan(thread * each, each), exact, 1, true};
    }
    HD void add(std::size_t i, const Rgb& value) const
    {
        if (alone && exact.empty()) {
            sums[i] += value;
            return;
        }
        for (int channel = 0; channel < 3; ++channel) {
            if (exact.empty())
                fast::add(sums[i][channel], value[channel]);
            else
                exact[3 * i + static_cast<std::size_t>(channel)].add(value[channel]);
        }
    }
};

/// The contributions that were left out because they are not finite: their number, and the smallest of
/// their keys.
struct DroppedCount {
    std::uint64_t count = 0;
    std::uint64_t least_key = ~std::uint64_t{0};
};

/// The position of a contribution in the order of (pixel, s, t). Walks of more than 65,535 vertices
/// share a key.
HD constexpr std::uint64_t dropped_key(std::uint32_t pixel, int s, int t)
{
    const auto part = [](int n) { return static_cast<std::uint64_t>(n < 0xffff ? n : 0xffff); };
    return std::uint64_t{pixel} << 32 | part(s) << 16 | part(t);
}

/// The memory that a launch of samples writes to.
struct FilmTarget {
    std::span<Rgb> own; // by index of the launch: the sum of the sample for its own pixel
    SplatTarget splats;
    std::span<Rgb> layers;           // one picture per strategy; empty: no layers
    std::span<DroppedCount> dropped; // one
    bool weighted;                   // of the layers: whether they are weighted
    std::uint32_t pixels;            // pixels of the picture

    /// With splats as SplatTarget::of_thread.
    [[nodiscard]] FilmTarget of_thread(std::size_t thread, std::size_t threads) const
    {
        FilmTarget result = *this;
        result.splats = splats.of_thread(thread, threads);
        return result;
    }
};

/// Takes the contributions of one sample.
class FilmSink {
public:
    HD FilmSink(const FilmTarget& target, std::uint32_t pixel) : target_(target), pixel_(pixel) {}

    /// Adds to the sample's own pixel.
    HD void add(int s, int t, const Rgb& value, float weight)
    {
        if (drop(pixel_, s, t, value, weight)) return;
        own_ += weight * value;
        // With layers, only one sample of a pixel runs at a time, so no other thread adds here.
        if (!target_.layers.empty())
            target_.layers[place(layer_of(s, t), pixel_)] += target_.weighted ? weight * value : value;
    }
    /// Adds to any pixel, with t = 1.
    HD void splat(std::uint32_t pixel, int s, const Rgb& value, float weight)
    {
        if (drop(pixel, s, 1, value, weight)) return;
        target_.splats.add(pixel, weight * value); // map: splat
        if (!target_.layers.empty())
            target_.splats.add(place(static_cast<std::uint32_t>(s), pixel),
                               target_.weighted ? weight * value : value);
    }
    [[nodiscard]] HD const Rgb& own() const { return own_; }

private:
    /// Whether the contribution is not finite, and must not be added to the picture. If so, counts it.
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

/// Kernel over the pixels of a launch: adds the samples of each pixel, in their order.
struct SumSamples {
    std::span<const Rgb> own;
    std::span<Rgb> sums; // of the picture
    std::uint32_t first_pixel, pixels, samples;

    HD void operator()(std::uint32_t index) const
    {
        for (std::uint32_t i = 0; i < samples; ++i) sums[first_pixel + index] += own[i * pixels + index];
    }
};

/// Kernel over the pixels of all pictures of a SplatTarget with floats: adds the other copies to the
/// first, in their order.
struct AddCopies {
    std::span<Rgb> sums;
    std::size_t copies;

    HD void operator()(std::uint32_t index) const
    {
        const std::size_t each = sums.size() / copies;
        for (std::size_t copy = 1; copy < copies; ++copy) sums[index] += sums[copy * each + index];
    }
};

/// Kernel over elements: each gets its default value, which is 0 for numbers.
template <class T>
struct Clear {
    std::span<T> elements;
    HD void operator()(std::uint32_t index) const { elements[index] = T{}; }
};

} // namespace fast
