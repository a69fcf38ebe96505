#include "cli/trade_needs.h"

#include "scenes/longest_path.h"
#include "scenes/requirements.h"
#include "trade/estimates.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

namespace cli {

namespace {

using trade::Json;

/// The names of enumerators, in order.
template <class Enumerators>
std::string listed_names(const Enumerators& enumerators)
{
    std::string text;
    for (const auto one : enumerators)
        text += (text.empty() ? "" : ", ") + std::string(scenes::name_of(one));
    return text.empty() ? "none" : text;
}

template <class Enumeration>
std::vector<Enumeration> missing_from(const std::set<Enumeration>& required)
{
    std::vector<Enumeration> missing;
    for (const Enumeration one : scenes::all_of<Enumeration>)
        if (!required.contains(one)) missing.push_back(one);
    return missing;
}

/// Families of strategies that can carry nothing, with the proof of each.
std::map<scenes::Strategy, std::string> proofs(const scenes::Scene& scene)
{
    const scenes::Requirements required = scenes::requirements(scene);
    const auto longest = scenes::longest_path(scene);
    std::map<scenes::Strategy, std::string> found;
    for (const scenes::Strategy family : missing_from(required.strategies))
        found[family] = required.emitters.empty() ? "there is no emitter"
                        : family == scenes::Strategy::emission_hit
                            ? "no ray hits an emitter: none has an area and there is no environment"
                            : "no surface can be joined: all are black, emit, or are mirrors or glass";
    // An inner connection has two vertices on each side, so 3 edges at least.
    if (longest && *longest < 3)
        found.try_emplace(scenes::Strategy::inner_connection,
                          "its paths have 3 edges at least, and there are none longer than " +
                              std::to_string(*longest));
    return found;
}

const trade::Knob* knob_of(const TradePlan& plan, const std::string& name)
{
    const auto found = std::ranges::find(plan.knobs, name, &trade::Knob::name);
    return found == plan.knobs.end() ? nullptr : &*found;
}

/// A value of a knob and the reference of the knob, if both were measured.
struct Pair {
    const trade::Measurements* value;
    const trade::Measurements* reference;
};

std::optional<Pair> pair_of(const TradePlan& plan, const std::vector<trade::Measurements>& measured,
                            const std::string& name, const std::string& value)
{
    const trade::Knob* knob = knob_of(plan, name);
    if (knob == nullptr) return std::nullopt;
    for (const trade::Knob::Value& one : knob->values)
        if (one.text == value) return Pair{&measured[one.configuration], &measured[knob->reference]};
    return std::nullopt;
}

/// How many times as fast `fewer` is as `more`, and the sentence that says so.
void add_gain(Json& row, const trade::Measurements& fewer, const trade::Measurements& more)
{
    const trade::Estimate gain = trade::speed(fewer.rounds, more.rounds);
    if (!gain.stated()) return;
    row["gain"] = trade::json_of(gain);
    row["sentence"] = gain.low > 1.0 ? "It is " + to_text(gain) + " times as fast without."
                      : gain.high < 1.0
                          ? "It is slower without: " + to_text(gain) + " times as fast."
                          : "No gain was measured: " + to_text(gain) + " times as fast without.";
}

Json row_of(const std::string& what, const std::string& has, const std::string& left_out)
{
    return {{"what", what},
            {"has", has},
            {"left_out", left_out},
            {"gain", nullptr},
            {"sentence", left_out == "nothing" ? "" : "Not measured; --needs does."}};
}

/// The kernels of the fast path, and their gain over those that can do everything.
Json kernel_row(const fast::Needs& needs, const TradePlan& plan,
                const std::vector<trade::Measurements>& measured)
{
    std::string has = "triangles, Lambertian";
    std::string left_out;
    const auto sort = [&](bool needed, const char* text) {
        std::string& list = needed ? has : left_out;
        list += (list.empty() ? "" : ", ") + std::string(text);
    };
    sort(needs.spheres, "spheres");
    sort(needs.specular, "mirrors and glass");
    sort(needs.other_lights, "emitters other than triangles");
    sort(needs.coincident, "surfaces that coincide");
    Json row = row_of("kernels", has, left_out.empty() ? "nothing" : left_out);
    if (left_out.empty()) return row;
    if (const auto pair = pair_of(plan, measured, "kernel-needs", "all"))
        add_gain(row, *pair->reference, *pair->value);
    return row;
}

double mean(const std::vector<double>& values)
{
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Peak memory with these kernels and with those that can do everything.
std::optional<Json> memory_row(const TradePlan& plan, const std::vector<trade::Measurements>& measured)
{
    const auto pair = pair_of(plan, measured, "kernel-needs", "all");
    if (!pair || pair->value->peak_bytes.empty() || pair->reference->peak_bytes.empty())
        return std::nullopt;
    const auto [low, high] = std::ranges::minmax(pair->value->peak_bytes);
    const auto [own_low, own_high] = std::ranges::minmax(pair->reference->peak_bytes);
    const trade::Estimate ratio{mean(pair->value->peak_bytes) / mean(pair->reference->peak_bytes),
                                low / own_high, high / own_low};
    Json row = row_of("memory", "that of the kernels above", "that of kernels for everything");
    row["gain"] = trade::json_of(ratio);
    row["sentence"] =
        (ratio.low > 1.0 ? "Kernels for everything take " + to_text(ratio) + " times the memory"
                         : "No gain was measured: kernels for everything take " + to_text(ratio) +
                               " times the memory") +
        " (range of the measurements).";
    return row;
}

} // namespace

std::vector<std::string> needs_knobs(const scenes::Scene& scene)
{
    std::vector<std::string> knobs = {"kernel-needs=scene,all", "ref-tree=sah-leaf,sah"};
    std::string families;
    for (const auto& [family, proof] : proofs(scene))
        families += (families.empty() ? "" : ",") + std::string(scenes::name_of(family));
    if (!families.empty()) knobs.push_back("without=" + families);
    if (const auto longest = scenes::longest_path(scene); longest && *longest > 0)
        knobs.push_back("max-edges=" + std::to_string(*longest));
    return knobs;
}

Json needs_rows(const scenes::Scene& scene, const fast::Needs& kernels, const TradePlan& plan,
                const std::vector<trade::Measurements>& measured)
{
    const scenes::Requirements required = scenes::requirements(scene);
    Json rows = Json::array();
    const auto add_kinds = [&](const char* what, const auto& has) {
        const std::string left_out = listed_names(missing_from(has));
        Json row = row_of(what, listed_names(has), left_out == "none" ? "nothing" : left_out);
        row["sentence"] = left_out == "none" ? "" : "See the kernels.";
        rows.push_back(row);
    };
    add_kinds("shapes", required.shapes);
    add_kinds("bsdfs", required.bsdfs);
    add_kinds("emitters", required.emitters);
    rows.push_back(kernel_row(kernels, plan, measured));
    if (const auto row = memory_row(plan, measured)) rows.push_back(*row);

    Json levels = row_of("tree levels", "leaves of up to 8 primitives where that costs less",
                         "levels down to one primitive in a leaf (tree of ref)");
    if (const auto pair = pair_of(plan, measured, "ref-tree", "sah"))
        add_gain(levels, *pair->reference, *pair->value);
    rows.push_back(levels);

    const auto impossible = proofs(scene);
    std::vector<scenes::Strategy> possible;
    for (const scenes::Strategy family : scenes::all_of<scenes::Strategy>)
        if (!impossible.contains(family)) possible.push_back(family);
    rows.push_back(row_of("strategies", listed_names(possible), "nothing"));
    for (const auto& [family, proof] : impossible) {
        const std::string name(scenes::name_of(family));
        Json row = row_of("strategy " + name, "never", name + ": " + proof);
        if (const auto pair = pair_of(plan, measured, "without", name))
            add_gain(row, *pair->value, *pair->reference);
        rows.push_back(row);
    }

    const auto longest = scenes::longest_path(scene);
    Json row = row_of("path length",
                      longest ? "at most " + std::to_string(*longest) + " edges" : "no bound is proven",
                      !longest        ? "nothing"
                      : *longest == 2 ? "longer paths: all surfaces that scatter lie in one plane"
                      : *longest == 1 ? "longer paths: no surface scatters"
                                      : "all paths: there is no emitter");
    if (longest)
        if (const auto pair = pair_of(plan, measured, "max-edges", std::to_string(*longest)))
            add_gain(row, *pair->value, *pair->reference);
    rows.push_back(row);
    return rows;
}

} // namespace cli
