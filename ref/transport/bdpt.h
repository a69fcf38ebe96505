#pragma once

#include "ref/transport/world.h"

namespace ref {

/// Bidirectional path tracing [Lafortune & Willems 1993; Veach 1997, ch. 10]: one eye walk and one light
/// walk, joined in every possible way (connect.h), each path weighted against all other ways to make it
/// (mis_weight.h). An Integrator.
void trace_bidirectionally(const World& world, const PathOptions& options, const SampleId& id,
                           std::vector<Contribution>& out);

/// Light tracing [Arvo 1986; Dutre et al. 1993]: the light image alone, with weight 1. It cannot see
/// what the camera sees by way of mirrors and glass alone. An Integrator.
void trace_light(const World& world, const PathOptions& options, const SampleId& id,
                 std::vector<Contribution>& out);

} // namespace ref
