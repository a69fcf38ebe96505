#pragma once

#include "ref/transport/world.h"

namespace ref {

/// The most vertices of the eye walk that can be needed. A path has s + t - 1 edges, at most max_edges.
/// So an emission hit (s = 0) needs max_edges + 1 of them, a next event (s = 1) one less, an inner
/// connection (s >= 2) two less, and the light image z_0 alone.
std::size_t most_eye_vertices(const PathOptions& options);

/// The most vertices of the light walk that can be needed: by the light image (t = 1), or by an inner
/// connection (t >= 2).
std::size_t most_light_vertices(const PathOptions& options);

/// Bidirectional path tracing [Lafortune & Willems 1993; Veach 1997, ch. 10]: one eye walk and one
/// light walk are joined in every possible way (connect.h). Each path is weighted against all other
/// strategies that can produce it (mis_weight.h). Families that the options leave out are not computed.
/// An Integrator.
void trace_bidirectionally(const World& world, const PathOptions& options, const SampleId& id,
                           std::vector<Contribution>& out);

/// Light tracing [Arvo 1986; Dutre et al. 1993]: only the light image, with weight 1. It misses
/// everything that the camera sees only through mirrors and glass. An Integrator.
void trace_light(const World& world, const PathOptions& options, const SampleId& id,
                 std::vector<Contribution>& out);

} // namespace ref
