#pragma once

// Records the contributions of single samples of the fast path. For their walks as well see
// tests/cuda/path_judge/walk_recorder.h.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/transport/launch_samples.h"

#include <vector>

namespace cuda_test {

struct RecordedContribution {
    std::uint32_t pixel;
    int s, t;
    gpu::Rgb value;
    float weight;
    friend bool operator==(const RecordedContribution&, const RecordedContribution&) = default;
};

/// A sink that keeps all contributions, in their order.
class ContributionSink {
public:
    explicit ContributionSink(std::uint32_t pixel) : pixel_(pixel) {}
    void add(int s, int t, const gpu::Rgb& value, float weight)
    {
        all.push_back({pixel_, s, t, value, weight});
    }
    void splat(std::uint32_t pixel, int s, const gpu::Rgb& value, float weight)
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
        : arrays_(gpu::scene_arrays(scene, roulette)),
          scene_(memory_, executor_, arrays_, gpu::camera_of(scene, arrays_.place, width, height))
    {}
    [[nodiscard]] gpu::Needs needs() const { return gpu::needs_of(arrays_); }

    /// By the kernel that is compiled for `needs`, which must be no less than needs().
    [[nodiscard]] std::vector<RecordedContribution> sample(gpu::Needs needs, gpu::Integrator integrator,
                                                           const gpu::PathOptions& options,
                                                           const gpu::SampleId& id) const
    {
        const int capacity = gpu::most_light_vertices(arrays_, options.max_edges);
        std::vector<gpu::LightVertex> kept(static_cast<std::size_t>(capacity));
        ContributionSink sink(id.pixel);
        gpu::with_needs(needs, [&]<gpu::Needs known>() {
            const gpu::LightVertices vertices{kept.data(), 1, capacity};
            const auto view = scene_.view<known>();
            using enum gpu::Integrator;
            if (integrator == path) gpu::trace_sample<known, path>(view, options, id, vertices, sink);
            if (integrator == bdpt) gpu::trace_sample<known, bdpt>(view, options, id, vertices, sink);
            if (integrator == light) gpu::trace_sample<known, light>(view, options, id, vertices, sink);
        });
        return sink.all;
    }

private:
    gpu::HostMemory memory_;
    gpu::ThreadedExecutor executor_{1};
    gpu::SceneArrays arrays_;
    gpu::SceneInMemory scene_;
};

} // namespace cuda_test
