#include "cli/render_metadata.h"

#include "cli/reference_options.h"
#include "images/families.h"

namespace cli {

namespace {

/// The entries that `describe` leaves out.
const images::Metadata defaults = {{"device", "ref"}, {"roulette_from", "5"}, {"without", "nothing"}};

/// The families that are left out, in the order of their names' list.
std::string names_of_left_out(const RenderCommand& options)
{
    const images::Families families = families_of(options);
    std::string names;
    for (const auto& [name, family] : images::named_families)
        if (!(families.*family)) names += (names.empty() ? "" : " ") + std::string(name);
    return names.empty() ? "nothing" : names;
}

} // namespace

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
    const auto add = [&](const char* key, const std::string& value) {
        if (value != defaults.at(key)) metadata[key] = value;
    };
    add("device", options.device + (options.instructions == "fastmath" ? ", fastmath" : ""));
    add("roulette_from", std::to_string(options.roulette_from));
    add("without", names_of_left_out(options));
    return metadata;
}

images::Metadata with_defaults(images::Metadata metadata)
{
    metadata.insert(defaults.begin(), defaults.end());
    return metadata;
}

} // namespace cli
