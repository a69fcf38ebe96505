#include "cli/trade_knobs.h"

#include "cli/builders.h"
#include "cli/idle_options.h"
#include "cuda/launch/instruction_set.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>
#include <thread>

namespace cli {

namespace {

using Values = std::vector<std::string>;

/// A knob: its values are settings of one option, except of `roulette` (see turn).
struct KnobRule {
    const char* name;
    const char* what;
    bool usual;                // turned if none is named
    const char* default_value; // of an option that is not set
    Settings home;             // settings without which it has no effect
    Values (*values)(const Settings& reference);
};

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
    KnobRule{"device",
             "floats on this processor, or the reference in double; cuda: a GPU",
             true,
             "ref",
             {},
             [](const Settings&) {
                 return Values{"host", "ref"};
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
    KnobRule{"epsilon",
             "distance of rays from surfaces; fixed is a mistake",
             false,
             "bound",
             {{"device", "ref"}},
             [](const Settings&) { return Values{"bound", "1e-2", "1e-3", "1e-4", "1e-5", "1e-6"}; }},
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

const KnobRule& rule_of(const std::string& name)
{
    for (const KnobRule& rule : knob_rules)
        if (name == rule.name) return rule;
    std::string known;
    for (const KnobRule& rule : knob_rules)
        known += (known.empty() ? "" : ", ") + std::string(rule.name);
    throw std::invalid_argument("--knobs " + name + ": no such knob; there are " + known);
}

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
        drop({"without", "roulette-from", "epsilon"});
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

/// `settings` with this value of the knob.
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

/// A text such as "max-edges=2,4": the name and the values.
struct Request {
    std::string name;
    Values values; // empty: the usual ones
};

Request request_of(const std::string& text)
{
    const std::size_t equals = text.find('=');
    Request request{text.substr(0, equals), {}};
    if (equals == std::string::npos) return request;
    std::string rest = text.substr(equals + 1) + ",";
    for (std::size_t comma = 0; (comma = rest.find(',')) != std::string::npos; rest.erase(0, comma + 1))
        request.values.push_back(rest.substr(0, comma));
    if (std::ranges::find(request.values, "") != request.values.end())
        throw std::invalid_argument("--knobs " + text + ": an empty value");
    return request;
}

std::vector<Request> requests_of(const std::vector<std::string>& knobs)
{
    std::vector<Request> requests;
    const bool all = std::ranges::find(knobs, "all") != knobs.end();
    if (all || knobs.empty())
        for (const KnobRule& rule : knob_rules)
            if (all || rule.usual) requests.push_back({rule.name, {}});
    for (const std::string& knob : knobs) {
        if (knob == "all") continue;
        Request request = request_of(knob);
        const auto same = std::ranges::find(requests, request.name, &Request::name);
        if (same == requests.end())
            requests.push_back(std::move(request));
        else if (!all)
            throw std::invalid_argument("--knobs " + knob + ": this knob is named twice");
        else
            *same = std::move(request);
    }
    return requests;
}

/// What differs from the base: "device=ref threads=2"; "base" for nothing.
std::string difference(const Settings& settings, const Settings& base)
{
    std::string text;
    const auto add = [&](const std::string& part) { text += (text.empty() ? "" : " ") + part; };
    for (const auto& [option, value] : settings) {
        const auto found = base.find(option);
        if (found == base.end() || found->second != value)
            add(value.empty() ? option : option + "=" + value);
    }
    for (const auto& [option, value] : base) {
        if (settings.contains(option)) continue;
        const auto rule = std::ranges::find(knob_rules, option, &KnobRule::name);
        const bool has_default = rule != knob_rules.end() && rule->default_value[0] != '\0';
        add(has_default ? option + "=" + rule->default_value : "no " + option);
    }
    return text.empty() ? "base" : text;
}

/// Collects configurations, each once.
class Collected {
public:
    explicit Collected(const Settings& base) { add(base); }

    std::size_t add(const Settings& settings)
    {
        const auto found = std::ranges::find(plan.settings, settings);
        if (found != plan.settings.end()) return static_cast<std::size_t>(found - plan.settings.begin());
        plan.settings.push_back(settings);
        plan.names.push_back(difference(settings, plan.settings.front()));
        return plan.settings.size() - 1;
    }

    TradePlan plan;
};

/// Whether paths of this value of max-edges are longer than those of the truth.
bool is_longer(const std::string& value, int max_edges)
{
    if (max_edges == images::unlimited_edges) return false;
    return value == "unlimited" || std::atoi(value.c_str()) > max_edges;
}

} // namespace

std::string describe_knobs()
{
    std::string text;
    for (const KnobRule& rule : knob_rules) {
        Settings reference = {{"device", "host"}, {"max-edges", "6"}};
        text += std::string(rule.usual ? "* " : "  ") + rule.name + " ";
        std::string values;
        for (const std::string& value : rule.values(reference))
            values += (values.empty() ? "" : ",") + value;
        text += values + ": " + rule.what + "\n";
    }
    return text;
}

Settings base_of(const std::vector<std::string>& settings)
{
    Settings base = {{"device", "host"}, {"threads", "1"}};
    for (const std::string& text : settings) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
            throw std::invalid_argument("--base " + text + ": expected OPTION=VALUE");
        base = turn(base, rule_of(text.substr(0, equals)), text.substr(equals + 1));
    }
    return base;
}

TradePlan plan_of(const Settings& base, const std::vector<std::string>& knobs, int max_edges)
{
    Collected collected(base);
    for (const Request& request : requests_of(knobs)) {
        const KnobRule& rule = rule_of(request.name);
        Settings reference = base;
        for (const auto& [option, value] : rule.home)
            reference = turn(reference, rule_of(option), value);
        const std::string own = value_of(reference, rule);
        Values values = request.values.empty() ? rule.values(reference) : request.values;
        if (std::ranges::find(values, own) == values.end()) values.insert(values.begin(), own);
        trade::Knob knob{rule.name, rule.what, collected.add(reference), {}};
        for (const std::string& value : values) {
            if (request.name == "max-edges" && is_longer(value, max_edges)) continue;
            knob.values.push_back({value, collected.add(turn(reference, rule, value))});
        }
        collected.plan.knobs.push_back(std::move(knob));
    }
    return collected.plan;
}

std::vector<std::string> arguments_of(const Settings& settings, const TradeView& view)
{
    std::vector<std::string> arguments = {"render", view.scene, "--size", view.size};
    if (view.frame) arguments.emplace_back("--frame");
    for (const auto& [option, value] : settings) {
        arguments.push_back("--" + option);
        if (!value.empty()) arguments.push_back(value);
    }
    return arguments;
}

std::string command_line(const Settings& settings, const TradeView& view)
{
    std::string line = "plumbline";
    for (const std::string& argument : arguments_of(settings, view)) {
        const bool plain = argument.find_first_of(" '\"\\$&;()<>|*?") == std::string::npos;
        line += plain ? " " + argument : " '" + argument + "'";
        if (argument == view.scene) line += " -o picture.exr";
    }
    return line;
}

RenderCommand render_of(const Settings& settings, const TradeView& view)
{
    CLI::App command;
    RenderCommand options;
    add_render_options(command, options);
    std::vector<std::string> arguments = arguments_of(settings, view);
    arguments.erase(arguments.begin());             // "render"
    arguments.emplace_back("--output=picture.exr"); // required; nothing is written
    std::ranges::reverse(arguments);                // CLI11 takes them from the back
    try {
        command.parse(arguments);
    } catch (const CLI::ParseError& error) {
        throw std::invalid_argument(error.what());
    }
    settle_batch_size(options, false);
    expect_no_idle_options(command, options);
    if (options.no_roulette && options.max_edges == images::unlimited_edges)
        throw std::invalid_argument("roulette=off needs max-edges: paths would never end");
    return options;
}

} // namespace cli
