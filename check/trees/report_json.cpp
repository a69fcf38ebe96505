#include "check/trees/report.h"

#include <nlohmann/json.hpp>

namespace check {

namespace {

using OrderedJson = nlohmann::ordered_json;

const char* verdict_name(Property::Verdict verdict)
{
    switch (verdict) {
    case Property::Verdict::holds:
        return "holds";
    case Property::Verdict::fails:
        return "fails";
    case Property::Verdict::not_checked:
        return "not checked";
    }
    return "";
}

OrderedJson property_json(const Property& property)
{
    OrderedJson json = {{"name", property.name},
                        {"meaning", property.meaning},
                        {"verdict", verdict_name(property.verdict)}};
    if (property.verdict != Property::Verdict::fails) return json;
    json["violations"] = property.violations;
    json["example"] = property.example;
    if (property.node != NeutralTree::none) json["node"] = property.node;
    if (property.primitive != NeutralTree::none) json["primitive"] = property.primitive;
    return json;
}

OrderedJson problem_json(const Problem& problem)
{
    return {{"name", problem.name}, {"text", problem.text}};
}

} // namespace

std::string json(const TreeReport& report)
{
    OrderedJson json = {{"passes", report.passes()},
                        {"primitives", report.primitives},
                        {"nodes", report.nodes},
                        {"leaves", report.leaves},
                        {"properties", OrderedJson::array()}};
    for (const Property& property : report.properties)
        json["properties"].push_back(property_json(property));
    json["shape"] = nullptr;
    if (const auto& shape = report.shape)
        json["shape"] = {{"root", shape->root},
                         {"depth", shape->depth},
                         {"mean_leaf_depth", shape->mean_leaf_depth},
                         {"smallest_leaf", shape->smallest_leaf},
                         {"largest_leaf", shape->largest_leaf},
                         {"in_order_of_30_bits", shape->in_order_of_30_bits},
                         {"in_order_of_63_bits", shape->in_order_of_63_bits}};
    json["sah_cost"] = nullptr;
    if (const auto& costs = report.costs)
        json["sah_cost"] = {{"tree", costs->tree}, {"our_lbvh", costs->lbvh}, {"our_sah", costs->sah}};
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

std::string json(const BuilderReport& report)
{
    OrderedJson json = {{"passes", report.passes()},
                        {"planned", report.planned},
                        {"budget_spent", report.budget_spent},
                        {"interrupted", report.stopped},
                        {"slowest_seconds", report.slowest_seconds},
                        {"kinds", OrderedJson::array()},
                        {"smallest", nullptr}};
    for (const BuilderReport::Kind& kind : report.kinds) {
        OrderedJson entry = {
            {"kind", name(kind.kind)}, {"tried", kind.tried}, {"largest", kind.largest}};
        entry["problem"] = nullptr;
        if (kind.problem.any()) {
            entry["problem"] = problem_json(kind.problem);
            entry["problem"]["primitives"] = kind.failing;
        }
        json["kinds"].push_back(std::move(entry));
    }
    if (const auto& smallest = report.smallest)
        json["smallest"] = {{"primitives", smallest->boxes.size()},
                            {"problem", problem_json(smallest->problem)},
                            {"tries", smallest->tries},
                            {"failed_again", smallest->failed_again},
                            {"runs_again", smallest->runs_again}};
    return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

} // namespace check
