#include "tests/cuda/path_judge/walk_recorder.h"

namespace cuda_test {

RecordedSample WalkRecorder::sample(gpu::Integrator integrator, const gpu::PathOptions& options,
                                    const gpu::SampleId& id) const
{
    using enum gpu::Integrator;
    RecordedSample result;
    const WalkRecordingSink sink{result, id.pixel};
    // What is there before a sample must not matter: it is nothing that any scene has.
    const int capacity = integrator == bdpt ? gpu::most_light_vertices(arrays_, options.max_edges) : 0;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const gpu::LightVertex junk{gpu::Vec3(nan), nan, gpu::Vec3(nan), nan, gpu::Rgb(nan), nan, {}};
    std::vector<gpu::LightVertex> kept(static_cast<std::size_t>(capacity), junk);
    const gpu::LightVertices vertices{kept.data(), 1, capacity};
    gpu::with_needs(gpu::needs_of(arrays_), [&]<gpu::Needs known>() {
        const auto view = scene_.view<known>();
        if (integrator == path) gpu::trace_sample<known, path>(view, options, id, vertices, sink);
        if (integrator == bdpt) gpu::trace_sample<known, bdpt>(view, options, id, vertices, sink);
        if (integrator == light) gpu::trace_sample<known, light>(view, options, id, vertices, sink);
    });
    return result;
}

} // namespace cuda_test
