#pragma once

// One sample of a picture by the reference, with everything that its value comes from: random numbers,
// both walks, and every strategy (s, t) with its densities and weights, or with the reason why it
// contributes nothing. All numbers come from the functions of ref/ that render.

#include "ref/transport/mis_weight.h"
#include "ref/transport/random.h"
#include "ref/transport/vertex.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace explain {

using ref::Rgb;
using ref::Vec3;

/// The random numbers of one event (ref/transport/random.h) of which at least one has an effect.
struct Draw {
    ref::Event event;
    std::uint32_t vertex;           // 0 for events that have no vertex
    ref::Uniforms uniforms;         // all four
    std::array<const char*, 4> use; // what each decides; null: nothing
};

/// What a walk does at a vertex where it tries to go on.
struct Bounce {
    ref::BsdfSample sample;
    double survival; // the probability that roulette lets the walk go on
    bool survives;
    Vec3 wi; // unit direction in the world
};

/// A vertex y_j or z_j. The densities are those with which the walk sampled it, roulette included.
struct Step {
    ref::Vertex vertex;
    std::optional<double> pdf_solid_angle; // sr^-1, seen from the vertex before; none after a delta lobe
    std::optional<double> pdf_area;        // m^-2; none at infinity and after a delta lobe
    std::optional<double> probability = {}; // of what is certain once it is chosen: a lobe, a source
    std::optional<Bounce> bounce = {};      // none at the first vertex, and where the walk does not try
};

/// Why a walk has no further vertex.
enum class WalkEnd {
    longest_path, // no path may be longer, or no family needs a further vertex
    left_scene,   // the ray met nothing
    environment,  // the last vertex is the environment
    absorbed,     // the surface scatters nothing
    roulette,     // Russian roulette
    dark,         // light walk: y_0 emits nothing in the direction that was drawn
    no_emitter,   // no emitter has power: the light walk has no vertex
    covered,      // another emitter covers the point that the light walk starts at
    not_walked    // the integrator, or the families that are left, need no such walk
};

struct Walk {
    std::vector<Step> steps;
    WalkEnd end;
};

/// Why a strategy contributes nothing.
enum class Obstacle {
    none,
    no_eye_vertex,   // the eye walk has no z_{t-1}
    no_light_vertex, // the light walk has no y_{s-1}
    too_long,        // s + t - 1 is above max_edges
    left_out,        // the family is left out by an option
    not_an_emitter,  // s = 0: z_{t-1} is on a surface that does not emit
    dark_side,       // the emitter is met, or seen, from its back, or outside the cone of a spot light
    delta_vertex,    // mirror or glass: it sends light in single directions
    no_scattering,   // the surface of an emitter, which reflects nothing
    at_infinity,     // there is no surface to be joined
    delta_emitter,   // no ray meets it by chance, and a pinhole does not see it
    no_emitter,      // next event: no emitter has power
    edge_on,         // next event: the emitter has density 0 in this direction
    outside_picture, // light image: the camera does not see the point
    other_side,      // the two directions at a vertex are on different sides of its surface
    black,           // a colour of a surface is 0
    blocked,         // a primitive is between the two ends
    in_plane,        // one triangle contains both ends
    covered,         // another surface lies in the same place, and is seen first
    vanishes         // all factors are above 0, and their product is 0
};

/// The density of a path under one strategy.
struct Density {
    int s;
    long double value; // 0: impossible. Long paths leave the range of double
    double relative;   // to that of the strategy that made the path
};

struct Strategy {
    int s, t;
    Obstacle obstacle = Obstacle::none;
    std::string at = {};                        // the vertex where the obstacle is: "z_2"; or ""
    std::optional<std::uint32_t> blocker = {};  // the primitive between the ends
    std::optional<ref::Contribution> made = {}; // if there is no obstacle
    std::vector<ref::Vertex> path = {};         // x_0 ... x_k; empty if a vertex is missing
    std::optional<ref::VertexDensities> p = {}; // of the path, if bidirectional
    std::vector<Density> densities = {};        // of all strategies that may make the path
    double balance = 0.0, power = 0.0;          // the weight by either heuristic

    /// What it adds to its pixel.
    [[nodiscard]] Rgb contribution() const { return made ? made->weight * made->value : Rgb(0.0); }
    /// Not finite: left out of the picture.
    [[nodiscard]] bool is_dropped() const;
};

struct Sample {
    ref::SampleId id;
    images::Integrator integrator;
    ref::PathOptions options;
    std::vector<Draw> draws;
    Walk eye;
    Walk light;
    std::vector<Strategy> strategies; // in the order in which they are added up
    Rgb own{0.0};                     // what the sample adds to its own pixel, splats apart
};

/// The sample `id` of the picture of `world` by `integrator` with `options`. The picture adds
/// Sample::own to the pixel, and separately the contributions of the strategies with t = 1 to theirs.
Sample explain_sample(const ref::World& world, images::Integrator integrator,
                      const ref::PathOptions& options, const ref::SampleId& id);

} // namespace explain
