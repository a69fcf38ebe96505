#pragma once

// Records the contributions of single samples of the fast path. To record their walks, too, see
// tests/cuda/path_judge/walk_recorder.h.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/threaded_executor.h"

#include <vector>

namespace fast_transport_test {

struct RecordedContribution {
    std::uint32_t pixel;
    int s, t;
    fast::Rgb value;
    float weight;
    friend bool operator==(const RecordedContribution&, const RecordedContribution&) = default;
};

/// A sink that keeps all contributions, in their order.
class ContributionSink {
public:
    explicit ContributionSink(std::uint32_t pixel) : pixel_(pixel) {}
    void add(int s, int t, const fast::Rgb& value, float weight)
    {
        all.push_back({pixel_, s, t, value, weight});
    }
    void splat(std::uint32_t pixel, int s, const fast::Rgb& value, float weight)
    {
        all.push_back({pixel, s, 1, value, weight});
    }
    std::vector<RecordedContribution> all;

private:
    std::uint32_t pixel_;
};

/// A scene in the memory of the host, of which single samples are recorded.
class ContributionRecorder {
public:
    ContributionRecorder(const scenes::Scene& scene, int width, int height, bool roulette = true)
        : arrays_(fast::scene_arrays(scene, roulette)),
          scene_(memory_, executor_, arrays_, fast::camera_of(scene, arrays_.place, width, height))
    {}
    [[nodiscard]] fast::Needs needs() const { return arrays_.needs; }

    /// Computed by the kernel for compiled_for(needs), which must include needs().
    [[nodiscard]] std::vector<RecordedContribution> sample(fast::Needs needs,
                                                           fast::Integrator integrator,
                                                           const fast::PathOptions& options,
                                                           const fast::SampleId& id) const
    {
        const int capacity = fast::most_light_vertices(arrays_, options.max_edges);
        std::vector<fast::LightVertex> kept(static_cast<std::size_t>(capacity));
        ContributionSink sink(id.pixel);
        fast::with_needs(needs, [&]<fast::Needs known>() {
            const fast::LightVertices vertices{kept.data(), 1, capacity};
            const auto view = scene_.view<known>();
            using enum fast::Integrator;
            if (integrator == path) fast::trace_sample<known, path>(view, options, id, vertices, sink);
            if (integrator == bdpt) fast::trace_sample<known, bdpt>(view, options, id, vertices, sink);
            if (integrator == light) fast::trace_sample<known, light>(view, options, id, vertices, sink);
        });
        return sink.all;
    }

private:
    fast::HostMemory memory_;
    fast::ThreadedExecutor executor_{1};
    fast::SceneArrays arrays_;
    fast::SceneInMemory scene_;
};

} // namespace fast_transport_test
