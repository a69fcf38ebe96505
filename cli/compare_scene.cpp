#include "cli/compare_scene.h"

#include "cli/golden_render.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/render_metadata.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "golden/compare.h"

#include <cmath>
#include <optional>
#include <random>
#include <utility>

namespace cli {

bool same_estimator(const images::Metadata& a, const images::Metadata& b)
{
    const images::Metadata all_of_a = with_defaults(a);
    const images::Metadata all_of_b = with_defaults(b);
    for (const char* key :
         {"integrator", "heuristic", "batch_size", "max_edges", "roulette", "roulette_from", "without"})
        if (value_of(all_of_a, key).empty() || value_of(all_of_a, key) != value_of(all_of_b, key))
            return false;
    return true;
}

JudgedCandidate judge_scene(const golden::Golden& golden, const std::string& file,
                            const CompareCommand& options)
{
    RenderCommand command = render_of(golden, file);
    if (!options.integrator.empty()) command.integrator = options.integrator;
    command.threads = options.threads;
    command.device = options.device;
    const std::uint64_t seed = options.seed.value_or(std::random_device()());
    const scenes::Scene scene = load_scene(file, command.frame, options.quiet);
    command.seed = seed;
    images::Metadata metadata = describe(command, scene);
    const golden::Method method =
        same_estimator(metadata, golden.metadata) ? golden::Method::ranks : golden::Method::welch;
    golden::check_comparable(golden, metadata, method);
    images::Image mean;
    const auto render = [&](std::size_t stage, std::uint64_t batches, golden::Candidate& candidate) {
        command.seed = seed + stage;
        command.samples = batches * command.batch_size;
        Progress progress(scene.name + ", stage " + std::to_string(stage + 1), 0.0,
                          static_cast<double>(batches), options.quiet);
        const images::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        const auto renderer = renderer_for(command, scene);
        if (!render_batches(*renderer, 0, batches, monitor,
                            [&](const images::Batch& batch) { candidate.add_batch(batch.mean); }))
            throw Interrupted();
        mean = candidate.mean();
        metadata["samples"] = std::to_string(command.samples);
    };
    golden::CompareOptions stages;
    if (options.samples) {
        const double batches = std::ceil(*options.samples / command.batch_size);
        stages.stages = {static_cast<std::uint64_t>(batches), 4 * static_cast<std::uint64_t>(batches)};
    }
    golden::Comparison comparison = golden::compare(golden, render, method, stages);
    return {std::move(comparison), std::move(mean), std::move(metadata), {}};
}

} // namespace cli
