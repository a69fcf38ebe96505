#pragma once

// Small scenes that are legal and odd, drawn from a seed, each with a truth that does not come from
// comparing two renderers.

#include "scenes/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cuda_test {

enum class OddKind {
    white_under_sky,   // nothing absorbs: the radiance is that of the sky, everywhere
    white_among_lamps, // the same in a closed room whose walls are lamps
    plane,             // direct light on an open plane: a closed form
    room               // a room's light is the sum of the lights of its lamps, each alone
};
inline constexpr int odd_kinds = 4;

/// Pictures are square, of that many pixels a side.
inline constexpr int odd_size = 8;

/// No bound: roulette ends walks.
inline constexpr int any_edges = 1 << 20;

struct OddScene {
    scenes::Scene scene;
    std::string description;
    int max_edges = any_edges;
    /// Whether the integrator finds all light that bidirectional path tracing finds, and that with a
    /// variance that is not much larger.
    bool path_sees = true, light_sees = true;
    /// What single precision may change in the mean of the picture, relative to it.
    double float_tolerance = 1e-4;

    // The truth: the mean of the picture over pixels and channels,
    std::optional<double> mean;
    // or scenes whose pictures add up to that of `scene`, by path tracing where that sees everything.
    // They have none of the additions to it that change nothing.
    std::vector<scenes::Scene> parts;
};

/// The kind that a seed makes.
inline OddKind odd_kind(std::uint32_t seed)
{
    return static_cast<OddKind>(seed % odd_kinds);
}

/// The scene of a seed, the same on every platform but for the last digits of sines and logarithms.
OddScene odd_scene(std::uint32_t seed);

std::string name_of(OddKind kind);

// One for each kind; seeds that differ by kind are other scenes.
OddScene odd_furnace(std::uint32_t seed, bool sky);
OddScene odd_plane(std::uint32_t seed);
OddScene odd_room(std::uint32_t seed);

} // namespace cuda_test
