#include "cli/idle_options.h"

#include "cli/builders.h"
#include "images/file_ending.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace cli {

namespace {

struct Rule {
    const char* option;
    bool idle;          // whether it has no effect, if it was given
    std::string beside; // the option that is the cause, and the reason
};

bool is_one_of(const std::string& word, const std::vector<std::string>& words)
{
    return std::ranges::find(words, word) != words.end();
}

std::string listed(const std::vector<std::string>& words)
{
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::vector<Rule> rules_for(const RenderCommand& options)
{
    const auto writes = [&](const char* ending) {
        return std::ranges::any_of(
            options.outputs, [&](const std::string& path) { return images::has_ending(path, ending); });
    };
    const bool sheet = !options.strategies_picture.empty();
    const bool layers = sheet || !options.strategies.empty();
    const std::string with_integrator = "with --integrator " + options.integrator + ": ";
    const std::string with_device = "with --device " + options.device + ": ";
    return {
        {"--heuristic", options.integrator != "bdpt", with_integrator + "it is for bdpt"},
        {"--heuristic", options.heuristic == "uniform" && options.device != "ref",
         with_device + "it is for the reference"},
        {"--builder", !is_one_of(options.builder, builder_names(options.device)),
         with_device + "its trees are " + listed(builder_names(options.device))},
        {"--roulette-from", options.no_roulette, "with --no-roulette"},
        {"--roulette-from", options.device != "ref", with_device + "it is for the reference"},
        {"--without", options.device != "ref", with_device + "it is for the reference"},
        {"--leaf-size", options.device != "ref", with_device + "the fast path has a tree of its own"},
        {"--leaf-size", !options.builder.empty() && options.builder != "sah-leaf",
         "with --builder " + options.builder + ": it is for sah-leaf"},
        {"--threads", options.device == "cuda", with_device + "it is for the host's processor"},
        {"--instructions", options.device != "host", with_device + "it is for the host's fast path"},
        {"--kernels", options.device != "cuda", with_device + "it is for the GPU"},
        {"--kernel-needs", options.device == "ref", with_device + "it is for the fast path"},
        {"--exposure", !writes(".png") && !sheet,
         "without a .png: neither --output nor --strategies-picture names one"},
        {"--unweighted", !layers, "without --strategies or --strategies-picture: it is for them"},
        {"--unweighted", options.integrator == "light", with_integrator + "all its weights are 1"},
        {"--keep-batches", !writes(".exr"), "without an .exr: --output names none"},
    };
}

std::vector<Rule> rules_for(const BvhCommand& options)
{
    const bool picture = !options.picture.empty();
    const bool draws = picture || !options.figure.empty();
    const bool rays = picture || measures_builders(options);
    const bool times = !options.device.empty() || measures_builders(options);
    const std::string with_device = "with --device " + options.device + ": ";
    // The reason why no rays are traced.
    const std::string without_rays = options.device.empty()
                                         ? "with --tree: no picture is drawn and no ray is sent"
                                         : with_device + "no picture is drawn and no ray is sent";
    return {
        {"--builder", !options.device.empty() && !draws,
         with_device + "the fast path has trees of its own"},
        {"--show", !picture, "without --picture: it is for that picture"},
        {"--level", !picture, "without --picture: it is for that picture"},
        {"--level", options.show != "boxes", "with --show " + options.show + ": it is for boxes"},
        {"--size", !rays, without_rays},
        {"--frame", !rays, without_rays},
        {"--repeats", !times,
         std::string("with --") + (picture ? "picture" : "tree") + ": no build is timed without --json"},
        {"--threads", options.device.empty(), "without --device host: the reference has one"},
        {"--threads", options.device == "cuda", with_device + "it is for the host's processor"},
    };
}

void expect_not_idle(const CLI::App& command, const std::vector<Rule>& rules)
{
    for (const Rule& rule : rules) {
        const CLI::Option* found = command.get_option_no_throw(rule.option);
        if (!rule.idle || found == nullptr || found->count() == 0) continue;
        const CLI::Option& option = *found;
        const bool flag = option.get_expected_max() == 0;
        throw std::invalid_argument(rule.option + (flag ? "" : " " + option.results().front()) +
                                    " has no effect " + rule.beside);
    }
}

} // namespace

void expect_no_idle_options(const CLI::App& command, const RenderCommand& options)
{
    expect_not_idle(command, rules_for(options));
}

void expect_no_idle_options(const CLI::App& command, const BvhCommand& options)
{
    expect_not_idle(command, rules_for(options));
}

} // namespace cli
