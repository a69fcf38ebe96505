#include "cli/trade_rules.h"

#include "cuda/launch/device.h"
#include "cuda/launch/instruction_set.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace cli {

namespace {

Values threads()
{
    Values values;
    for (unsigned n = 1; n < std::thread::hardware_concurrency(); n *= 2)
        values.push_back(std::to_string(n));
    values.push_back(std::to_string(std::max(1U, std::thread::hardware_concurrency())));
    return values;
}

Values instruction_sets()
{
    Values values;
    for (const fast::InstructionSet set : fast::instruction_sets()) values.emplace_back(name_of(set));
    if (fast::has_fast_math()) values.emplace_back("fastmath");
    return values;
}

bool is(const Settings& settings, const char* option, const char* value)
{
    const auto found = settings.find(option);
    return found != settings.end() && found->second == value;
}

const std::array knob_rules = {
    KnobRule{"integrator",
             "paths from the eye, from both ends, from the light",
             true,
             "path",
             {},
             [](const Settings&) {
                 return Values{"path", "bdpt", "light"};
             }},
    KnobRule{
        "device",
        "floats on this processor, or the reference in double; cuda: a GPU",
        true,
        "ref",
        {},
        [](const Settings&) {
            return fast::find_device().usable ? Values{"host", "ref", "cuda"} : Values{"host", "ref"};
        }},
    KnobRule{
        "threads", "threads of the processor", true, "", {}, [](const Settings&) { return threads(); }},
    KnobRule{"instructions",
             "vector instructions; fastmath changes bits",
             false,
             "best",
             {{"device", "host"}},
             [](const Settings&) { return instruction_sets(); }},
    KnobRule{"max-edges",
             "longest path; shorter ones lack light",
             true,
             "unlimited",
             {},
             [](const Settings&) { return Values{"2", "3", "4", "6", "10", "unlimited"}; }},
    KnobRule{"roulette",
             "first bounce that roulette may end",
             false,
             "5",
             {{"device", "ref"}},
             [](const Settings& reference) {
                 Values values = {"1", "2", "3", "5", "9"};
                 if (reference.contains("max-edges")) values.emplace_back("off");
                 return values;
             }},
    KnobRule{"tree",
             "tree of the fast path, with the bits of its codes",
             true,
             "hploc63",
             {{"device", "host"}},
             [](const Settings&) {
                 return Values{"hploc63", "hploc30", "morton63", "morton30"};
             }},
    KnobRule{"kernel-needs",
             "kernels for the scene, also for mirrors and glass, for all",
             true,
             "scene",
             {{"device", "host"}},
             [](const Settings&) {
                 return Values{"scene", "specular", "all"};
             }},
    KnobRule{"ref-tree",
             "tree of ref",
             false,
             "sah-leaf",
             {{"device", "ref"}},
             [](const Settings&) {
                 return Values{"sah-leaf", "sah-leaf4", "sah-leaf2", "sah", "morton63", "morton30"};
             }},
    KnobRule{"heuristic",
             "weights of bdpt; uniform is a mistake",
             false,
             "balance",
             {{"device", "ref"}, {"integrator", "bdpt"}},
             [](const Settings&) {
                 return Values{"balance", "power", "uniform"};
             }},
    KnobRule{
        "without",
        "left out of bdpt",
        false,
        "nothing",
        {{"device", "ref"}, {"integrator", "bdpt"}},
        [](const Settings&) {
            return Values{"nothing", "emission_hit", "next_event", "light_image", "inner_connection"};
        }},
};

} // namespace

std::span<const KnobRule> all_knob_rules()
{
    return knob_rules;
}

const KnobRule& rule_of(const std::string& name, const std::string& option)
{
    for (const KnobRule& rule : knob_rules)
        if (name == rule.name) return rule;
    std::string known;
    for (const KnobRule& rule : knob_rules)
        known += (known.empty() ? "" : ", ") + std::string(rule.name);
    throw std::invalid_argument(option + " " + name + ": no such knob; there are " + known);
}

namespace {

/// The option of `plumbline render` that a knob turns.
std::string option_of(const KnobRule& rule)
{
    const std::string name = rule.name;
    return name == "tree" || name == "ref-tree" ? "builder" : name;
}

/// The builder of the reference that has a choice of the leaf size: "sah-leaf4" is a size of 4.
constexpr std::string_view sah_leaf = "sah-leaf";

/// Removes settings that have no effect beside the others, as `plumbline render` would refuse them.
void drop_idle(Settings& settings)
{
    const auto drop = [&](std::initializer_list<const char*> options) {
        for (const char* option : options) settings.erase(option);
    };
    if (!is(settings, "device", "host")) drop({"instructions"});
    if (!settings.contains("device") || is(settings, "device", "ref")) drop({"kernel-needs"});
    if (settings.contains("device") && !is(settings, "device", "ref")) {
        drop({"without", "roulette-from"});
        if (is(settings, "heuristic", "uniform")) drop({"heuristic"});
    }
    if (settings.contains("builder") || is(settings, "device", "host") || is(settings, "device", "cuda"))
        drop({"leaf-size"});
    if (!is(settings, "integrator", "bdpt")) drop({"heuristic"});
    if (is(settings, "device", "cuda")) drop({"threads"});
}

void set(Settings& settings, const std::string& option, const std::string& value,
         const std::string& default_value)
{
    if (value == default_value)
        settings.erase(option);
    else
        settings[option] = value;
}

} // namespace

Settings turn(Settings settings, const KnobRule& rule, const std::string& value)
{
    if (std::string(rule.name) == "roulette") {
        settings.erase("no-roulette");
        if (value == "off") settings["no-roulette"] = "";
        set(settings, "roulette-from", value == "off" ? rule.default_value : value, rule.default_value);
    } else if (std::string(rule.name) == "ref-tree") {
        const bool sized = value.starts_with(sah_leaf) && value.size() > sah_leaf.size();
        set(settings, "builder", sized ? rule.default_value : value, rule.default_value);
        set(settings, "leaf-size", sized ? value.substr(sah_leaf.size()) : "8", "8");
    } else {
        if (std::string(rule.name) == "device" && !is(settings, "device", value.c_str()))
            settings.erase("builder"); // each device has trees of its own
        set(settings, option_of(rule), value, rule.default_value);
    }
    drop_idle(settings);
    return settings;
}

std::string value_of(const Settings& settings, const KnobRule& rule)
{
    if (std::string(rule.name) == "roulette") {
        if (settings.contains("no-roulette")) return "off";
        const auto from = settings.find("roulette-from");
        return from == settings.end() ? rule.default_value : from->second;
    }
    if (std::string(rule.name) == "ref-tree" && settings.contains("leaf-size"))
        return std::string(sah_leaf) + settings.at("leaf-size");
    const auto found = settings.find(option_of(rule));
    return found == settings.end() ? rule.default_value : found->second;
}

} // namespace cli
