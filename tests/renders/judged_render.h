#pragma once

// Renders a scene in stages, with a right or wrong renderer, and compares it with its golden.

#include "golden/compare.h"
#include "golden/report.h"
#include "ref/transport/renderer.h"
#include "scenes/read_scene.h"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace renders_test {

inline const std::filesystem::path source = PLUMBLINE_SOURCE_DIR;

inline std::filesystem::path golden_of(const std::string& name)
{
    return source / "golden/renders" / (name + ".exr");
}

inline std::filesystem::path scene_of(const std::string& name)
{
    return source / "scenes" / (name + ".dae");
}

struct JudgedRender {
    golden::Golden golden;
    golden::Comparison comparison;
    images::Image mean; // of the last stage
    images::Metadata metadata;
};

/// The parameters of a renderer: those of the golden.
struct Plan {
    const scenes::Scene& scene;
    int width, height;
    std::uint32_t batch_size;
    int max_edges;
};

inline Plan plan_of(const golden::Golden& golden, const scenes::Scene& scene)
{
    return {scene, golden.mean.width, golden.mean.height,
            static_cast<std::uint32_t>(std::stoul(golden.metadata.at("batch_size"))),
            std::stoi(golden.metadata.at("max_edges"))};
}

/// Renders the batch of this number of the picture with this seed.
using RenderBatch = std::function<images::Image(std::uint64_t seed, std::uint64_t number)>;

/// Renders with a new random seed, with the renderer that `make_renderer` makes for the plan, and
/// compares the result with the golden. `calls_itself` is the name of the integrator in the metadata.
inline JudgedRender judge_render(const std::string& name,
                                 const std::function<RenderBatch(const Plan&)>& make_renderer,
                                 const std::string& calls_itself, golden::Method method,
                                 const golden::CompareOptions& options)
{
    JudgedRender result{golden::read_golden(golden_of(name)), {}, {}, {}};
    const scenes::Scene scene = scenes::read_scene(scene_of(name));
    const std::uint64_t seed = std::random_device()();
    result.metadata = result.golden.metadata;
    result.metadata["integrator"] = calls_itself;
    result.metadata["scene_hash"] = scene.hash;
    result.metadata["seed"] = std::to_string(seed);
    golden::check_comparable(result.golden, result.metadata, method);

    const RenderBatch render_batch = make_renderer(plan_of(result.golden, scene));
    const auto render = [&](std::size_t stage, std::uint64_t batches, golden::Candidate& candidate) {
        for (std::uint64_t i = 0; i < batches; ++i) candidate.add_batch(render_batch(seed + stage, i));
        result.mean = candidate.mean();
    };
    result.comparison = golden::compare(result.golden, render, method, options);
    return result;
}

/// Renders with an integrator of the reference.
inline RenderBatch by_reference(const Plan& plan, ref::Integrator integrator)
{
    const auto world = std::make_shared<ref::World>(plan.scene, plan.width, plan.height);
    images::RenderOptions options;
    options.batch_size = plan.batch_size;
    options.max_edges = plan.max_edges;
    return [=](std::uint64_t seed, std::uint64_t number) mutable {
        options.seed = seed;
        return ref::renderer(*world, integrator, options, 2)->render_batch(number)->mean;
    };
}

/// The same for an integrator of the reference.
inline JudgedRender judge_render(const std::string& name, ref::Integrator integrator,
                                 const std::string& calls_itself, golden::Method method,
                                 const golden::CompareOptions& options)
{
    return judge_render(
        name, [=](const Plan& plan) { return by_reference(plan, integrator); }, calls_itself, method,
        options);
}

/// Renders `count` batches of the scene's golden again, from its own random numbers, and compares the
/// functionals of each with those in its file: whether the integrator makes the same pictures as the one
/// that made the golden, bit for bit. Which of its batches after the pilot is drawn anew in each run.
inline bool makes_it_again(const std::string& name, ref::Integrator integrator, std::size_t count)
{
    const golden::Golden golden = golden::read_golden(golden_of(name));
    const scenes::Scene scene = scenes::read_scene(scene_of(name));
    const RenderBatch render_batch = by_reference(plan_of(golden, scene), integrator);
    std::vector<std::size_t> numbers(golden.reference.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    std::vector<std::size_t> drawn;
    std::ranges::sample(numbers, std::back_inserter(drawn), static_cast<std::ptrdiff_t>(count),
                        std::mt19937_64(std::random_device()()));
    const std::uint64_t seed = std::stoull(golden.metadata.at("seed"));
    const std::uint64_t pilot = golden.functionals.pilot().batches;
    return std::ranges::all_of(drawn, [&](std::size_t i) {
        return golden.functionals.evaluate(render_batch(seed, pilot + i)) == golden.reference[i];
    });
}

inline bool is_long()
{
    const char* value = std::getenv("PLUMBLINE_LONG");
    return value != nullptr && std::string(value) == "1";
}

/// Every run renders the first stage; the second is rendered only to confirm a suspicion. The ranks of
/// fewer than some 20 batches cannot reach the confirmation level. With 24, golden::detectable_error is
/// at most 0.8%, and 3.6% for door_ajar. PLUMBLINE_LONG=1 uses enough batches to detect half a percent.
inline golden::CompareOptions short_options()
{
    golden::CompareOptions options;
    if (is_long()) return options;
    options.stages = {24, 128};
    // A second stage takes five times as long as the first: for one comparison in 20, not in 5.
    options.screening_level = options.suspicion_level;
    options.specification = 0.04;
    return options;
}

/// For a picture that must fail, all of whose light is missing or wrong: the first stage is certain of
/// it.
inline golden::CompareOptions one_stage()
{
    golden::CompareOptions options = short_options();
    options.stages.resize(1);
    return options;
}

inline std::vector<std::string> scenes_with_goldens()
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(source / "golden/renders"))
        if (entry.path().extension() == ".exr") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

/// Prints the verdict and its reason to stdout.
inline void print(const std::string& name, const std::string& estimator, const JudgedRender& judged)
{
    std::cout << name << ", " << estimator << ", seed " << judged.metadata.at("seed") << ": "
              << describe(judged.comparison.verdict) << ". " << judged.comparison.reason
              << " Conclusive: " << 100.0 * judged.comparison.coverage << "% of the tests.\n";
}

/// Writes the report of a failure. Returns the reason and the path of the report.
inline std::string with_report(const std::string& name, const std::string& estimator,
                               const JudgedRender& judged)
{
    const std::filesystem::path report =
        std::filesystem::path(PLUMBLINE_REPORTS) / (name + "_" + estimator + ".html");
    std::filesystem::create_directories(report.parent_path());
    golden::write_report(report, {name + " by " + estimator + " against its golden", judged.comparison,
                                  judged.golden, judged.mean, judged.metadata});
    return judged.comparison.reason + "\nThe report: " + report.string();
}

} // namespace renders_test
