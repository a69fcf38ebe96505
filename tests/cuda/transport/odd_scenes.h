#pragma once

// Small scenes that are legal and odd, made from a seed. Each has a truth that does not come from
// comparing two renderers.

#include "scenes/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace fast_transport_test {

enum class OddKind {
    white_under_sky,   // nothing absorbs: the radiance is that of the sky, everywhere
    white_among_lamps, // the same in a closed room whose walls are lamps
    plane,             // direct light on an open plane: a closed form
    room               // the light of a room is the sum of the lights of its lamps, each alone
};
inline constexpr int odd_kinds = 4;

/// Pictures are square, with that many pixels a side.
inline constexpr int odd_size = 8;

/// No limit: roulette ends walks.
inline constexpr int any_edges = 1 << 20;

struct OddScene {
    scenes::Scene scene;
    std::string description;
    int max_edges = any_edges;
    /// Whether the integrator finds all light that bidirectional path tracing finds, with a variance
    /// that is not much larger.
    bool path_sees = true, light_sees = true;
    /// The relative error that single precision may cause in the mean of the picture.
    double float_tolerance = 1e-4;

    // The truth is the mean of the picture over pixels and channels,
    std::optional<double> mean;
    // or scenes whose pictures add up to that of `scene`, by path tracing where that finds all light.
    // They have none of the additions of `scene` that change nothing.
    std::vector<scenes::Scene> parts;
};

/// The kind of scene for a seed.
inline OddKind odd_kind(std::uint32_t seed)
{
    return static_cast<OddKind>(seed % odd_kinds);
}

/// The scene of a seed, the same on every platform up to the last digits of sines and logarithms.
OddScene odd_scene(std::uint32_t seed);

std::string name_of(OddKind kind);

// One function per kind; seeds of different kinds give different scenes.
OddScene odd_furnace(std::uint32_t seed, bool sky);
OddScene odd_plane(std::uint32_t seed);
OddScene odd_room(std::uint32_t seed);

} // namespace fast_transport_test
