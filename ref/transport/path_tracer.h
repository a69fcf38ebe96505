#pragma once

#include "ref/transport/world.h"

namespace ref {

/// Unidirectional path tracing [Kajiya 1986]: one walk from the eye. Each of its vertices is joined to
/// a fresh point of an emitter (s = 1, next event), and the walk itself may hit an emitter (s = 0,
/// emission hit). The two are weighted by the balance heuristic [Veach 1997, sec. 9.2]. A family that
/// the options leave out is not computed. An Integrator.
void trace_path(const World& world, const PathOptions& options, const SampleId& id,
                std::vector<Contribution>& out);

} // namespace ref
