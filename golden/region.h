#pragma once

// The regions of a picture over which pixels are added up, and the weights of these sums.

#include <array>
#include <cstddef>
#include <string>

namespace golden {

inline constexpr std::size_t channel_count = 3;
inline constexpr std::array<const char*, channel_count> channel_names = {"red", "green", "blue"};

enum class RegionKind {
    whole,
    coarse_tile, // a square of a quarter of the longer side
    fine_tile,   // a square of an eighth of the longer side: 16x16 pixels of 128x128
    luminance,   // a stratum: a sixteenth of the pixels, from the darkest to the brightest
    noise        // a stratum: a sixteenth of the pixels, by relative variance v / m^2
};

struct Region {
    RegionKind kind;
    int index;          // within its kind: row by row, or from the lowest stratum
    int x0, y0, x1, y1; // x0 <= x < x1, y0 <= y < y1; for a stratum those of the whole picture
    std::size_t pixels;
};

/// In words: "the whole picture", "tile 32..47, 0..15", "luminance stratum 3 of 16".
std::string describe(const Region& region);

/// The weights of the pixels of a region, with m and v the pilot's mean and variance of a batch.
enum class Weight {
    matched, // m / v: least variance for a relative error that is the same in all of the region
    plain,   // 1: the mean, to which few bright noisy pixels contribute as well
    bounded  // the mean of c / (c + m): a single sample, however bright, changes it little
};
inline constexpr std::array weights = {Weight::matched, Weight::plain, Weight::bounded};

std::string describe(Weight weight);

constexpr bool is_linear(Weight weight)
{
    return weight != Weight::bounded;
}

} // namespace golden
