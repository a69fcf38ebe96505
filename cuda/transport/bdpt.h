#pragma once

// One sample of any integrator: a light walk, then an eye walk. Path tracing is bidirectional path
// tracing without the light walk; light tracing is bidirectional path tracing without the eye walk
// (needs.h).

#include "cuda/transport/eye_subpath.h"
#include "cuda/transport/light_subpath.h"

namespace fast {

/// Sends all contributions of sample `id`, to any pixel, to `sink`. `kept` is memory for the light
/// walk of this sample; only Integrator::bdpt uses it.
template <Needs needs, Integrator integrator, class Sink>
HD void trace_sample(const SceneView<needs>& scene, const PathOptions& options, const SampleId& id,
                     const LightVertices& kept, Sink& sink)
{
    int count = 0;
    if constexpr (integrator != Integrator::path)
        count = light_subpath<needs, integrator>(scene, options, id, kept, sink);
    if constexpr (integrator != Integrator::light)
        eye_subpath<needs, integrator>(scene, options, id, kept, count, sink);
}

} // namespace fast
