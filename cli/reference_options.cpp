#include "cli/reference_options.h"

#include "cli/one_of.h"
#include "images/families.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <stdexcept>

namespace cli {

namespace {

std::vector<std::string> family_names()
{
    std::vector<std::string> names;
    for (const auto& [name, family] : images::named_families) names.emplace_back(name);
    return names;
}

} // namespace

void add_reference_options(CLI::App& command, RenderCommand& options)
{
    command
        .add_option("--leaf-size", options.leaf_size,
                    "Most primitives in a leaf of sah-leaf, 1 to 64; changes no bit")
        ->check(CLI::Range(std::size_t{1}, std::size_t{64}).description(""))
        ->capture_default_str();
    add_experiment_options(command, options);
}

void add_experiment_options(CLI::App& command, RenderCommand& options)
{
    command
        .add_option("--roulette-from", options.roulette_from,
                    "For ref: the first bounce that roulette may end, at least 1")
        ->check(CLI::Range(1, 1 << 20).description(""))
        ->capture_default_str();
    command
        .add_option("--without", options.without,
                    "For ref: omit emission_hit, next_event, light_image, inner_connection")
        ->allow_extra_args(false)
        ->check(one_of(family_names()));
}

images::Families families_of(const RenderCommand& options)
{
    images::Families families;
    for (const auto& [name, family] : images::named_families)
        if (std::ranges::find(options.without, name) != options.without.end()) families.*family = false;
    return families;
}

void check_reference_options(const RenderCommand& options)
{
    try {
        images::expect_families(render_options(options).integrator, families_of(options));
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument("--without with --integrator " + options.integrator + ": " +
                                    error.what());
    }
}

} // namespace cli
