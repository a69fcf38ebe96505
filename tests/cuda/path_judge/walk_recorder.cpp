#include "tests/cuda/path_judge/walk_recorder.h"

namespace path_judge_test {

RecordedSample WalkRecorder::sample(fast::Integrator integrator, const fast::PathOptions& options,
                                    const fast::SampleId& id) const
{
    using enum fast::Integrator;
    RecordedSample result;
    const WalkRecordingSink sink{result, id.pixel};
    // The previous contents of the memory must not matter, so it is filled with values that no scene
    // has.
    const int capacity = integrator == bdpt ? fast::most_light_vertices(arrays_, options.max_edges) : 0;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const fast::LightVertex junk{fast::Vec3(nan), nan, fast::Vec3(nan), nan, fast::Rgb(nan), nan, {}};
    std::vector<fast::LightVertex> kept(static_cast<std::size_t>(capacity), junk);
    const fast::LightVertices vertices{kept.data(), 1, capacity};
    fast::with_needs(arrays_.needs, [&]<fast::Needs known>() {
        const auto view = scene_.view<known>();
        if (integrator == path) fast::trace_sample<known, path>(view, options, id, vertices, sink);
        if (integrator == bdpt) fast::trace_sample<known, bdpt>(view, options, id, vertices, sink);
        if (integrator == light) fast::trace_sample<known, light>(view, options, id, vertices, sink);
    });
    return result;
}

} // namespace path_judge_test
