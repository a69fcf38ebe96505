#pragma once

// Records single samples of the fast path: every vertex of their walks, and the contribution of each
// strategy. tests/cuda/transport/contribution_recorder.h records the contributions alone.

#include "cuda/launch/launch_samples.h"
#include "cuda/parallel/executor.h"

#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace path_judge_test {

/// The contributions of one sample, and its walks.
struct RecordedSample {
    struct Found {
        std::uint32_t pixel;
        fast::Rgb value;
        float weight;
    };
    struct Walk {
        std::vector<fast::WalkVertex> vertices; // from v_1 on
        std::optional<fast::Leg> missed;        // the leg that hit nothing
    };
    std::optional<fast::SampledEmission> emission;
    Walk light, eye;
    std::map<std::pair<int, int>, Found> found; // by (s, t)
    bool found_twice = false;                   // the same (s, t)
};

/// A sink that writes a RecordedSample.
struct WalkRecordingSink {
    RecordedSample& sample;
    std::uint32_t pixel;

    void add(int s, int t, const fast::Rgb& value, float weight) const
    {
        keep(s, t, {pixel, value, weight});
    }
    void splat(std::uint32_t where, int s, const fast::Rgb& value, float weight) const
    {
        keep(s, 1, {where, value, weight});
    }
    void emits(const fast::SampledEmission& emission) const { sample.emission = emission; }
    void meets(fast::Transport carried, const fast::WalkVertex& vertex) const
    {
        walk(carried).vertices.push_back(vertex);
    }
    void misses(fast::Transport carried, const fast::Leg& leg) const { walk(carried).missed = leg; }

private:
    void keep(int s, int t, const RecordedSample::Found& found) const
    {
        const bool first = sample.found.emplace(std::pair(s, t), found).second;
        sample.found_twice = sample.found_twice || !first;
    }
    [[nodiscard]] RecordedSample::Walk& walk(fast::Transport carried) const
    {
        return carried == fast::Transport::power ? sample.light : sample.eye;
    }
};
static_assert(fast::WatchesWalks<WalkRecordingSink>);
static_assert(!fast::WatchesWalks<fast::FilmSink>);

/// A scene in the memory of the host, of which single samples are recorded.
class WalkRecorder {
public:
    WalkRecorder(const scenes::Scene& scene, int width, int height, bool roulette)
        : arrays_(fast::scene_arrays(scene, roulette)),
          scene_(memory_, executor_, arrays_, fast::camera_of(scene, arrays_.place, width, height))
    {}

    /// The largest number of vertices of a light walk.
    [[nodiscard]] int most_light_vertices(fast::Integrator integrator, int max_edges) const
    {
        return integrator == fast::Integrator::bdpt
                   ? std::min(max_edges, fast::most_light_vertices(arrays_, max_edges) + 1)
                   : max_edges;
    }
    [[nodiscard]] RecordedSample sample(fast::Integrator integrator, const fast::PathOptions& options,
                                        const fast::SampleId& id) const;

private:
    fast::HostMemory memory_;
    fast::SerialExecutor executor_;
    fast::SceneArrays arrays_;
    fast::SceneInMemory scene_;
};

} // namespace path_judge_test
