#include "cli/trade_knobs.h"

#include "cli/trade_rules.h"
#include "images/whole_number.h"

#include <algorithm>
#include <stdexcept>

namespace cli {

namespace {

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
        for (const KnobRule& rule : all_knob_rules())
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
        const auto rule = std::ranges::find(all_knob_rules(), option, &KnobRule::name);
        const bool has_default = rule != all_knob_rules().end() && rule->default_value[0] != '\0';
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
    const auto edges = images::whole_number(value);
    return value == "unlimited" || (edges && *edges > static_cast<std::uint64_t>(max_edges));
}

} // namespace

std::string describe_knobs()
{
    std::string text;
    for (const KnobRule& rule : all_knob_rules()) {
        const Settings reference = {{"device", "host"}, {"max-edges", "6"}};
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
        base = turn(base, rule_of(text.substr(0, equals), "--base"), text.substr(equals + 1));
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

} // namespace cli
