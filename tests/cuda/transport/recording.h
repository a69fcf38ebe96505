#pragma once

// A sample of the fast path, contribution by contribution.

#include "cuda/parallel/threaded_executor.h"
#include "cuda/transport/launch_samples.h"

#include <vector>

namespace cuda_test {

struct Recorded {
    std::uint32_t pixel;
    int s, t;
    gpu::Rgb value;
    float weight;
    friend bool operator==(const Recorded&, const Recorded&) = default;
};

/// A sink that keeps everything.
class RecordingSink {
public:
    explicit RecordingSink(std::uint32_t pixel) : pixel_(pixel) {}
    void add(int s, int t, const gpu::Rgb& value, float weight)
    {
        all.push_back({pixel_, s, t, value, weight});
    }
    void splat(std::uint32_t pixel, int s, const gpu::Rgb& value, float weight)
    {
        all.push_back({pixel, s, 1, value, weight});
    }
    std::vector<Recorded> all;

private:
    std::uint32_t pixel_;
};

/// A scene in the memory of the host, for single samples.
class Recorder {
public:
    Recorder(const scenes::Scene& scene, int width, int height, bool roulette = true)
        : arrays_(gpu::scene_arrays(scene, roulette)),
          scene_(memory_, executor_, arrays_, gpu::camera_of(scene, arrays_.place, width, height))
    {}
    [[nodiscard]] gpu::Needs needs() const { return gpu::needs_of(arrays_); }

    /// By the kernel that is compiled for `needs`, which must be no less than needs().
    [[nodiscard]] std::vector<Recorded> sample(gpu::Needs needs, gpu::Integrator integrator,
                                               const gpu::PathOptions& options,
                                               const gpu::SampleId& id) const
    {
        const int capacity = gpu::most_light_vertices(arrays_, options.max_edges);
        std::vector<gpu::LightVertex> kept(static_cast<std::size_t>(capacity));
        RecordingSink sink(id.pixel);
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
