#pragma once

// The stored data of a light walk's vertices, so that eye vertices can be joined to them later.

#include "cuda/transport/sampling.h"

namespace fast {

/// A vertex y_{s-1}, s >= 2, to which eye vertices can be joined. It is on a Lambertian surface, whose
/// BSDF and densities are constant up to a cosine, so 64 bytes are enough.
template <class F>
struct alignas(4 * sizeof(F)) LightVertexOf {
    Vec3Of<F> position;
    F clearance;      // negative where another surface is near (SurfaceContacts)
    Vec3Of<F> facing; // unit normal on the side that the walk came from
    F pdf_projected;  // density per projected solid angle of going on, with roulette
    Vec3Of<F> alpha;  // BSDF included; if black: cannot be joined, and the rest is not set
    F pdf_area;       // of the vertex in its walk, > 0
    F brackets[4];    // WalkVertex::bracket for t = 2, 3, 4, and 5 or more, which are all equal

    /// B of docs/cuda-bdpt.md, equation (4), for a join to an eye walk of t >= 2 vertices.
    [[nodiscard]] HD const F& bracket(int t) const { return brackets[glm::min(t, 5) - 2]; }
};
using LightVertex = LightVertexOf<float>;
static_assert(sizeof(LightVertex) == 64);

/// The storage of one sample's light vertices: y_1, y_2, ..., each `stride` after the one before, so
/// that neighbouring samples write to neighbouring places.
struct LightVertices {
    LightVertex* first;
    std::uint32_t stride;
    int capacity;
    HD LightVertex& operator[](int i) const { return first[static_cast<std::size_t>(i) * stride]; }
};

} // namespace fast
