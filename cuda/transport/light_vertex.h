#pragma once

// What a light walk keeps of its vertices, so that eye vertices can be joined to them later.

#include "cuda/transport/sampling.h"

namespace fast {

/// A y_{s-1}, s >= 2, that eye vertices can be joined to. It is on a Lambertian surface, whose BSDF and
/// densities are constants but for a cosine; so 64 bytes hold all of it.
struct alignas(16) LightVertex {
    Vec3 position;
    float clearance;     // negative where another surface is near (SurfaceContacts)
    Vec3 facing;         // unit normal on the side that the walk came from
    float pdf_projected; // with which the walk would go on, roulette included: per projected solid angle
    Rgb alpha;           // BSDF included; black where no vertex can be joined: all else is unset then
    float pdf_area;      // with which the walk made the vertex, > 0
    float brackets[4];   // WalkVertex::bracket for t = 2, 3, 4, and 5 or more, which are all the same

    /// B of docs/cuda-bdpt.md, equation (4), for a join to an eye walk of t >= 2 vertices.
    [[nodiscard]] HD float bracket(int t) const { return brackets[glm::min(t, 5) - 2]; }
};
static_assert(sizeof(LightVertex) == 64);

/// Where one sample keeps them: y_1, y_2, ..., each `stride` after the one before, so that neighbouring
/// samples write to neighbouring places.
struct LightVertices {
    LightVertex* first;
    std::uint32_t stride;
    int capacity;
    HD LightVertex& operator[](int i) const { return first[static_cast<std::size_t>(i) * stride]; }
};

} // namespace fast
