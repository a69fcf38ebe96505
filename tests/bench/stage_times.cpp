// The time that each stage of the host takes per index, with the instructions that this file is compiled
// for: a profile by stage, and with the ratio to other instructions the vector width that a stage
// reaches.
//
//   stage_times SCENE.dae path|bdpt [SAMPLES]
//
// 240 x 160 pixels, at most 6 edges, on one thread; SAMPLES per pixel: 16. Prints a JSON object: by
// stage, the number of indices and the CPU seconds. stage_times.py runs it in rounds for all
// instructions.

#include "cuda/launch/batch_renderer.h"
#include "cuda/launch/host_stages.h"
#include "cuda/stages/run_stages.h"
#include "cuda/stages/trace_paths.h"
#include "cuda/stages/trace_walks.h"
#include "scenes/read_scene.h"
#include "tests/cuda/parallel/kernel_name.h"

#include <nlohmann/json.hpp>

#include <time.h>

#include <iostream>
#include <map>
#include <string>
#include <typeinfo>

namespace {

constexpr int width = 240;
constexpr int height = 160;
constexpr int max_edges = 6;

double cpu_seconds()
{
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Spent {
    std::uint64_t indices = 0;
    double seconds = 0;
};

/// By the name of the stage.
using SpentByStage = std::map<std::string, Spent>;

/// Runs stages as the renderer does, and adds up their times.
class TimedExecutor {
public:
    explicit TimedExecutor(SpentByStage& spent) : spent_(spent) {}

    template <class Stage>
    void operator()(std::uint32_t count, const Stage& stage) const
    {
        Spent& spent = spent_[parallel_test::kernel_name(typeid(Stage))];
        const double start = cpu_seconds();
        executor_(count, stage);
        spent.seconds += cpu_seconds() - start;
        spent.indices += count;
    }

private:
    SpentByStage& spent_;
    fast::StageExecutor executor_;
};

/// Traces all samples in blocks of `block`.
template <class Memory, class Trace>
SpentByStage in_blocks(std::uint32_t samples, std::uint32_t block, const Trace& trace)
{
    SpentByStage spent;
    const TimedExecutor executor(spent);
    fast::HostStages run(executor);
    std::vector<std::uint32_t> words(Memory::words_for(block));
    Memory memory(words, block);
    for (std::uint32_t first = 0; first < samples; first += block)
        trace(memory, run, first, std::min(block, samples - first));
    return spent;
}

SpentByStage profile(const scenes::Scene& scene, fast::Integrator integrator, std::uint32_t samples)
{
    fast::HostMemory memory;
    const fast::SerialExecutor serial;
    const fast::SceneArrays arrays = fast::scene_arrays(scene, false);
    const fast::SceneInMemory in_memory(memory, serial, arrays,
                                        fast::camera_of(scene, arrays.place, width, height));
    const fast::Launch launch{0, std::uint32_t{width} * height, 0, samples};
    const int capacity = fast::most_light_vertices(arrays, max_edges);
    std::vector<fast::Rgb> own(launch.count());
    std::vector<fast::Rgb> splats(launch.pixels);
    std::vector<fast::DroppedCount> dropped(1);
    const fast::FilmTarget film =
        fast::FilmTarget{own, {splats, {}}, {}, dropped, false, launch.pixels}.of_thread(0, 1);
    const fast::PathOptions options{0, max_edges, images::Heuristic::balance};
    SpentByStage spent;
    fast::with_needs(fast::compiled_for(arrays.needs), [&]<fast::Needs known>() {
        const fast::StageJob<known> job{in_memory.view<known>(), options, launch, film};
        if (integrator == fast::Integrator::path) {
            spent = in_blocks<fast::PathMemory>(
                launch.count(), 1024,
                [&](auto& paths, auto& run, std::uint32_t first, std::uint32_t count) {
                    paths.trace(run, job, first, count);
                });
            return;
        }
        const std::uint32_t block = 512;
        std::vector<fast::LightVertex> kept(static_cast<std::size_t>(capacity) * block);
        spent = in_blocks<fast::WalkMemory<fast::Integrator::bdpt>>(
            launch.count(), block,
            [&](auto& walks, auto& run, std::uint32_t first, std::uint32_t count) {
                walks.trace(run, job, first, count, kept, capacity);
            });
    });
    return spent;
}

} // namespace

int main(int argc, char** argv)
{
    const std::string integrator = argc > 2 ? argv[2] : "";
    if (argc < 3 || argc > 4 || (integrator != "path" && integrator != "bdpt")) {
        std::cerr << "usage: stage_times SCENE.dae path|bdpt [SAMPLES]\n";
        return 2;
    }
    try {
        const SpentByStage spent =
            profile(scenes::read_scene(argv[1]),
                    integrator == "path" ? fast::Integrator::path : fast::Integrator::bdpt,
                    argc > 3 ? static_cast<std::uint32_t>(std::stoul(argv[3])) : 16u);
        nlohmann::json report;
        for (const auto& [name, one] : spent)
            report[name] = {{"indices", one.indices}, {"seconds", one.seconds}};
        std::cout << report << '\n';
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}
