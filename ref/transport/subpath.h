#pragma once

// The two walks of bidirectional path tracing [Veach 1997, sec. 10.2]: y_0 ... from an emitter, z_0 ...
// from the eye. They differ in how they start and in what they carry; the walking is one function.

#include "ref/transport/vertex.h"

#include <vector>

namespace ref {

/// z_0, z_1, ...: at most `max_vertices`. The last may be an emitter's surface, or the environment.
std::vector<Vertex> eye_subpath(const World& world, const PathOptions& options, const SampleId& id,
                                std::size_t max_vertices);

/// y_0, y_1, ...: at most `max_vertices`; none if no emitter has power. alpha of y_0 does not contain
/// what y_0 emits, which depends on the direction; that of the others does.
std::vector<Vertex> light_subpath(const World& world, const PathOptions& options, const SampleId& id,
                                  std::size_t max_vertices);

} // namespace ref
