#pragma once

// The rungs of docs/ladder.md: five estimators of the same picture, each an Integrator. The first two
// are made from the path tracer of ref/transport/ by other weights.

#include "ref/transport/world.h"

#include <array>
#include <vector>

namespace figures {

/// Emission alone: light counts where the eye walk hits an emitter, with weight 1. No light from
/// emitters without area.
void trace_emission(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id,
                    std::vector<ref::Contribution>& out);

/// Next event alone, with weight 1. An emission hit counts only where next event cannot make the path:
/// where the walk comes from the eye or from a mirror or glass.
void trace_next_event(const ref::World& world, const ref::PathOptions& options, const ref::SampleId& id,
                      std::vector<ref::Contribution>& out);

struct Rung {
    const char* name; // also in the names of files
    const char* title;
    ref::Integrator integrator;
};

/// From the lowest rung to the highest; the highest is bidirectional path tracing.
const std::array<Rung, 5>& ladder();

} // namespace figures
