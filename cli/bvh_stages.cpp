#include "cli/bvh_stages.h"

#include "cuda/launch/device.h"
#include "cuda/launch/device_lbvh.h"
#include "cuda/parallel/threaded_executor.h"
#include "cuda/trees/bytes_moved.h"
#include "cuda/trees/hploc.h"
#include "cuda/trees/lbvh.h"
#include "cuda/trees/sah_cost.h"
#include "cuda/trees/scene_geometry.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace cli {

namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::array<double, fast::stage_names.size()>;

double ms_between(Clock::time_point start, Clock::time_point end)
{
    return std::chrono::duration<double, std::milli>(end - start).count();
}

/// Kernel over blocks of a mebibyte.
struct CopyBlock {
    static constexpr std::size_t size = 1 << 20;
    std::span<const char> from;
    std::span<char> to;
    void operator()(std::uint32_t i) const { std::memcpy(&to[i * size], &from[i * size], size); }
};

/// Bytes that the memory of the host moves per second, reading and writing: the best of some copies.
double host_bandwidth(fast::ThreadedExecutor& executor)
{
    constexpr std::uint32_t blocks = 192;
    const std::vector<char> from(blocks * CopyBlock::size, 1);
    std::vector<char> to(from.size());
    double best = 0;
    for (int i = 0; i < 5; ++i) {
        const auto start = Clock::now();
        executor(blocks, CopyBlock{from, to});
        const double bytes = 2 * static_cast<double>(from.size());
        best = std::max(best, bytes / (1e-3 * ms_between(start, Clock::now())));
    }
    return best;
}

std::size_t host_cache()
{
    const long bytes = sysconf(_SC_LEVEL3_CACHE_SIZE);
    return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

/// The times of all builds, and the SAH costs of the trees.
struct Timed {
    std::vector<Milliseconds> stages;
    double sah_cost = 0;
    std::vector<double> clustering; // ms, of cuda/trees/hploc.h
    double clustered_sah_cost = 0;
};

template <class Code>
Timed time_on_host(fast::ThreadedExecutor& executor, const std::vector<fast::Aabb>& boxes, int repeats)
{
    fast::HostMemory memory;
    fast::Lbvh<Code> tree(memory, executor, static_cast<std::uint32_t>(boxes.size()));
    tree.build(executor, boxes); // touches all memory once
    fast::throw_if_rejected(tree.first_rejected(), boxes);
    fast::Hploc clustered(memory, static_cast<std::uint32_t>(boxes.size()));
    clustered.build(executor, boxes, tree.order());
    Timed timed{std::vector<Milliseconds>(static_cast<std::size_t>(repeats)),
                fast::sah_cost(std::as_const(tree).nodes()),
                {},
                fast::sah_cost(clustered.nodes())};
    for (Milliseconds& stages : timed.stages) {
        auto start = Clock::now();
        tree.build(executor, boxes, [&](fast::Stage stage) {
            const auto end = Clock::now();
            stages[static_cast<std::size_t>(stage)] = ms_between(start, end);
            start = end;
        });
        clustered.build(executor, boxes, tree.order());
        timed.clustering.push_back(ms_between(start, Clock::now()));
    }
    return timed;
}

std::vector<Milliseconds> time_on_device(const std::vector<fast::Aabb>& boxes, int code_bits,
                                         int repeats)
{
    fast::DeviceLbvh tree(static_cast<std::uint32_t>(boxes.size()), code_bits);
    tree.build(boxes);
    static_cast<void>(tree.download()); // throws for an invalid box
    std::vector<Milliseconds> times(static_cast<std::size_t>(repeats));
    for (Milliseconds& stages : times) std::ranges::copy(tree.time_stages(), stages.begin());
    return times;
}

double median(std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The memory that a build reads and writes.
struct Memory {
    double bytes_per_second; // 0: not known
    std::size_t cache_bytes;
};

StagedBuild summarise_builds(const std::vector<Milliseconds>& times, std::uint32_t primitives,
                             int code_bits, const fast::SortPasses& passes, const Memory& memory)
{
    StagedBuild build{code_bits == 30 ? "morton30" : "morton63", {}};
    double total_bytes = 0;
    for (std::size_t i = 0; i < fast::stage_names.size(); ++i) {
        std::vector<double> ms;
        for (const Milliseconds& one : times) ms.push_back(one[i]);
        const double typical = median(ms);
        const double bytes =
            fast::bytes_moved(static_cast<fast::Stage>(i), primitives, code_bits, passes);
        const double per_second = typical > 0 ? bytes / (1e-3 * typical) : 0;
        const double bandwidth = memory.bytes_per_second;
        MeasuredStage stage{fast::stage_names[i], typical, bytes, std::nullopt};
        if (bandwidth > 0) stage.percent_of_bandwidth = 100 * per_second / bandwidth;
        if (bandwidth > 0 && per_second > bandwidth &&
            bytes > 2 * static_cast<double>(memory.cache_bytes))
            build.plausible = false;
        build.stages.push_back(stage);
        build.ms += typical;
        total_bytes += bytes;
    }
    build.bytes_per_primitive = primitives > 0 ? total_bytes / primitives : 0;
    return build;
}

void measure_on_device(MeasuredStages& report, const std::vector<fast::Aabb>& boxes, int repeats)
{
    const fast::Device found = fast::find_device();
    if (!found.usable) throw std::runtime_error("--device cuda: " + found.description);
    report.described = found.description;
    report.bytes_per_second = found.bytes_per_second;
    for (const int bits : {30, 63})
        report.builders.push_back(summarise_builds(time_on_device(boxes, bits, repeats),
                                                   report.primitives, bits, fast::passes_on_device(bits),
                                                   {found.bytes_per_second, found.cache_bytes}));
}

void measure_on_host(MeasuredStages& report, const std::vector<fast::Aabb>& boxes, unsigned threads,
                     int repeats)
{
    fast::ThreadedExecutor executor(threads);
    const Memory memory{host_bandwidth(executor), host_cache()};
    report.described = std::to_string(threads) + (threads == 1 ? " thread" : " threads");
    report.bytes_per_second = memory.bytes_per_second;
    for (const int bits : {30, 63}) {
        const Timed timed = bits == 30 ? time_on_host<std::uint32_t>(executor, boxes, repeats)
                                       : time_on_host<std::uint64_t>(executor, boxes, repeats);
        report.builders.push_back(
            summarise_builds(timed.stages, report.primitives, bits, fast::passes_on_host(bits), memory));
        report.builders.back().host_trees = {timed.sah_cost, median(timed.clustering),
                                             timed.clustered_sah_cost};
    }
}

} // namespace

MeasuredStages measure_stages(const scenes::Scene& scene, const std::string& device, unsigned threads,
                              int repeats)
{
    const std::vector<fast::Aabb> boxes = fast::boxes_of(scene);
    MeasuredStages report;
    report.scene = scene.name;
    report.primitives = static_cast<std::uint32_t>(boxes.size());
    report.device = device;
    if (device == "cuda")
        measure_on_device(report, boxes, repeats);
    else
        measure_on_host(report, boxes, threads, repeats);
    report.plausible = std::ranges::all_of(report.builders, &StagedBuild::plausible);
    return report;
}

} // namespace cli
