#pragma once

// Records single samples of the fast path with their walks: every vertex, and what each strategy
// contributed. tests/cuda/transport/contribution_recorder.h records the contributions alone.

#include "cuda/parallel/executor.h"
#include "cuda/transport/launch_samples.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace cuda_test {

/// What one sample contributed and how its walks went.
struct RecordedSample {
    struct Found {
        std::uint32_t pixel;
        gpu::Rgb value;
        float weight;
    };
    struct Walk {
        std::vector<gpu::WalkVertex> vertices; // from v_1 on
        std::optional<gpu::Leg> missed;        // the leg that met nothing
    };
    std::optional<gpu::SampledEmission> emission;
    Walk light, eye;
    std::map<std::pair<int, int>, Found> found; // by (s, t)
    bool found_twice = false;                   // the same (s, t)
};

/// A sink that writes a RecordedSample.
struct WalkRecordingSink {
    RecordedSample& sample;
    std::uint32_t pixel;

    void add(int s, int t, const gpu::Rgb& value, float weight) const
    {
        keep(s, t, {pixel, value, weight});
    }
    void splat(std::uint32_t where, int s, const gpu::Rgb& value, float weight) const
    {
        keep(s, 1, {where, value, weight});
    }
    void emits(const gpu::SampledEmission& emission) const { sample.emission = emission; }
    void meets(gpu::Transport carried, const gpu::WalkVertex& vertex) const
    {
        walk(carried).vertices.push_back(vertex);
    }
    void misses(gpu::Transport carried, const gpu::Leg& leg) const { walk(carried).missed = leg; }

private:
    void keep(int s, int t, const RecordedSample::Found& found) const
    {
        const bool first = sample.found.emplace(std::pair(s, t), found).second;
        sample.found_twice = sample.found_twice || !first;
    }
    [[nodiscard]] RecordedSample::Walk& walk(gpu::Transport carried) const
    {
        return carried == gpu::Transport::power ? sample.light : sample.eye;
    }
};
static_assert(gpu::WatchesWalks<WalkRecordingSink>);
static_assert(!gpu::WatchesWalks<gpu::FilmSink>);

/// A scene in the memory of the host, of which single samples are recorded.
class WalkRecorder {
public:
    WalkRecorder(const scenes::Scene& scene, int width, int height, bool roulette)
        : arrays_(gpu::scene_arrays(scene, roulette)),
          scene_(memory_, executor_, arrays_, gpu::camera_of(scene, arrays_.place, width, height))
    {}

    /// How many vertices a light walk may have.
    [[nodiscard]] int most_light_vertices(gpu::Integrator integrator, int max_edges) const
    {
        return integrator == gpu::Integrator::bdpt
                   ? std::min(max_edges, gpu::most_light_vertices(arrays_, max_edges) + 1)
                   : max_edges;
    }
    [[nodiscard]] RecordedSample sample(gpu::Integrator integrator, const gpu::PathOptions& options,
                                        const gpu::SampleId& id) const;

private:
    gpu::HostMemory memory_;
    gpu::SerialExecutor executor_;
    gpu::SceneArrays arrays_;
    gpu::SceneInMemory scene_;
};

} // namespace cuda_test
