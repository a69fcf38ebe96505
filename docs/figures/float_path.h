#pragma once

// A path tracer in single precision whose rays leave surfaces by a rule of choice, right or wrong: for
// the pictures of docs/leaving-a-surface.md. Sampling, weights and materials are those of
// ref/transport/; only the queries of geometry, in which the rule matters, are made here.

#include "images/image.h"
#include "ref/transport/world.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace figures {

/// How a ray leaves the surface that it starts on.
struct Leave {
    /// Its origin is moved along the ray by this fixed distance (a mistake), in units of the scene. 0:
    /// by the bound of ref/trees/geometry.cpp along the normal, with the unit roundoff of floats.
    float epsilon = 0.0F;
};

/// Part of a picture: width x height pixels, the first at column left, row top.
struct Region {
    int left, top, width, height;
};

/// How often a ray met the surface that it had just left.
struct SelfHits {
    std::uint64_t rays = 0; // that left a surface
    std::uint64_t hits = 0; // that met it again, which no such ray should do
};

/// The part `region` of the picture of `world` by path tracing in floats, `samples` per pixel. All
/// surfaces are tested one after the other. Adds to `self`.
images::Image render_in_floats(const ref::World& world, const ref::PathOptions& options, Leave leave,
                               Region region, std::uint32_t samples, SelfHits& self);

/// The same part by ref::trace_path.
images::Image render_in_doubles(const ref::World& world, const ref::PathOptions& options, Region region,
                                std::uint32_t samples);

} // namespace figures
