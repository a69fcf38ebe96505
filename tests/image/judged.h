#pragma once

// A scene rendered in stages by an integrator, right or wrong, and judged by its golden.

#include "golden/compare.h"
#include "ref/transport/render.h"
#include "scenes/read_scene.h"

#include <cstdint>
#include <filesystem>
#include <random>
#include <string>

namespace image_test {

inline const std::filesystem::path source = PLUMBLINE_SOURCE_DIR;

inline std::filesystem::path golden_of(const std::string& name)
{
    return source / "golden/renders" / (name + ".exr");
}

inline std::filesystem::path scene_of(const std::string& name)
{
    return source / "scenes" / (name + ".dae");
}

struct Judged {
    golden::Golden golden;
    golden::Comparison comparison;
    golden::Image mean; // of the last stage
    golden::Metadata metadata;
};

/// Renders with the golden's own parameters and random numbers that nobody used before. `integrator`
/// calls itself `calls_itself` in the metadata.
inline Judged judged(const std::string& name, ref::Integrator integrator,
                     const std::string& calls_itself, golden::Method method,
                     const golden::CompareOptions& options)
{
    Judged result{golden::read_golden(golden_of(name)), {}, {}, {}};
    const scenes::Scene scene = scenes::read_scene(scene_of(name));
    const std::uint64_t seed = std::random_device()();
    result.metadata = result.golden.metadata;
    result.metadata["integrator"] = calls_itself;
    result.metadata["scene_hash"] = scene.hash;
    result.metadata["seed"] = std::to_string(seed);
    golden::check_comparable(result.golden, result.metadata, method);

    const ref::World world(scene, result.golden.mean.width, result.golden.mean.height);
    ref::RenderOptions plan;
    plan.threads = 2;
    plan.batch_size = static_cast<std::uint32_t>(std::stoul(result.metadata.at("batch_size")));
    plan.path.max_edges = std::stoi(result.metadata.at("max_edges"));
    const auto render = [&](std::size_t stage, std::uint64_t batches, golden::Candidate& candidate) {
        plan.path.seed = seed + stage;
        for (std::uint64_t i = 0; i < batches; ++i)
            candidate.add_batch(*ref::render_batch(world, integrator, plan, i));
        result.mean = candidate.film().mean();
    };
    result.comparison = golden::compare(result.golden, render, method, options);
    return result;
}

} // namespace image_test
