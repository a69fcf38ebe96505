#pragma once

// Measures the stages of a build on the fast path, on the host or on a GPU.

#include "scenes/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cli {

/// One stage of a build.
struct MeasuredStage {
    std::string name;
    double ms;                                  // median of the time that passed
    double bytes;                               // that it must move (cuda/trees/bytes_moved.h)
    std::optional<double> percent_of_bandwidth; // of the memory; none where that is not known
};

/// The trees of one builder on the host.
struct MeasuredHostTrees {
    double sah_cost;
    double hploc_ms; // median of the time of clustering (cuda/trees/hploc.h), without the sort
    double hploc_sah_cost;
};

/// One builder, stage by stage.
struct StagedBuild {
    std::string name;
    std::vector<MeasuredStage> stages;
    double ms = 0; // of all stages
    double bytes_per_primitive = 0;
    /// False if the bytes and the time of a stage exceed the bandwidth of the memory although its data
    /// are too large for the caches: then some number is wrong.
    bool plausible = true;
    std::optional<MeasuredHostTrees> host_trees{};
};

/// All builders, on one device.
struct MeasuredStages {
    std::string scene;
    std::uint32_t primitives = 0;
    std::string device;          // "host" or "cuda"
    std::string described;       // "2 threads", or the GPU
    double bytes_per_second = 0; // bandwidth of the memory; 0 if not known
    std::vector<StagedBuild> builders;
    bool plausible = true; // all builders
};

/// Builds trees over 30 and 63 bits `repeats` times on `device`, "host" (with `threads` threads) or
/// "cuda". Throws std::runtime_error if there is no GPU, and std::invalid_argument for a primitive
/// with an invalid box.
MeasuredStages measure_stages(const scenes::Scene& scene, const std::string& device, unsigned threads,
                              int repeats);

} // namespace cli
