#pragma once

#include "ref/transport/world.h"

namespace ref {

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
