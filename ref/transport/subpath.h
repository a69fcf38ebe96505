#pragma once

// The two walks of bidirectional path tracing [Veach 1997, sec. 10.2]: y_0 ... from an emitter, z_0
// ... from the eye. They differ in how they start and in their weights; the bounces are one function.

#include "ref/transport/vertex.h"

#include <vector>

namespace ref {

/// z_0, z_1, ...: at most `max_vertices`. The last one may lie on an emitter, or be the environment.
std::vector<Vertex> eye_subpath(const World& world, const PathOptions& options, const SampleId& id,
                                std::size_t max_vertices);

/// y_0, y_1, ...: at most `max_vertices`; empty if no emitter has power. The alpha of y_0 does not
/// contain the emission of y_0, which depends on the direction; the alpha of the other vertices does.
std::vector<Vertex> light_subpath(const World& world, const PathOptions& options, const SampleId& id,
                                  std::size_t max_vertices);

} // namespace ref
