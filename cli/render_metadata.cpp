#include "cli/render_metadata.h"

namespace cli {

images::Metadata describe(const RenderCommand& options, const scenes::Scene& scene)
{
    images::Metadata metadata = {{"scene", scene.name},
                                 {"scene_hash", scene.hash},
                                 {"integrator", options.integrator},
                                 {"heuristic", options.heuristic},
                                 {"batch_size", std::to_string(options.batch_size)},
                                 {"max_edges", options.max_edges == images::unlimited_edges
                                                   ? "unlimited"
                                                   : std::to_string(options.max_edges)},
                                 {"roulette", options.no_roulette ? "off" : "on"},
                                 {"seed", std::to_string(options.seed)},
                                 {"camera", options.frame ? "framed" : "of the scene"},
                                 {"version", PLUMBLINE_VERSION}};
    // No entry for the reference, so that its files do not change.
    if (options.device != "ref")
        metadata["device"] = options.device + (options.instructions == "fastmath" ? ", fastmath" : "");
    return metadata;
}

std::string value_of(const images::Metadata& metadata, const std::string& key)
{
    const auto found = metadata.find(key);
    return found == metadata.end() ? "" : found->second;
}

} // namespace cli
