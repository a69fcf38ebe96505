#include "cli/bvh_report.h"

#include "ref/trees/sah.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace cli {

namespace {

nlohmann::json json_of(const std::optional<double>& number)
{
    return number ? nlohmann::json(*number) : nlohmann::json();
}

nlohmann::json json_of(const MeasuredBuilder& builder)
{
    return {{"name", builder.name},
            {"build_ms", builder.build_ms},
            {"sah_cost", builder.quality.sah_cost},
            {"depth", builder.quality.depth},
            {"mean_leaf_depth", builder.quality.mean_leaf_depth},
            {"overlap", builder.quality.overlap},
            {"nodes", builder.nodes},
            {"camera_mrays_per_s", builder.camera.mrays_per_s},
            {"camera_relative_standard_error", json_of(builder.camera.relative_standard_error)},
            {"camera_nodes_per_ray", builder.camera.nodes_per_ray},
            {"camera_primitives_per_ray", builder.camera.primitives_per_ray},
            {"diffuse_mrays_per_s", builder.diffuse.mrays_per_s},
            {"diffuse_relative_standard_error", json_of(builder.diffuse.relative_standard_error)},
            {"diffuse_nodes_per_ray", builder.diffuse.nodes_per_ray},
            {"diffuse_primitives_per_ray", builder.diffuse.primitives_per_ray}};
}

nlohmann::json json_of(const StagedBuild& build)
{
    nlohmann::json stages = nlohmann::json::array();
    for (const MeasuredStage& measured : build.stages) {
        nlohmann::json stage = {{"name", measured.name}, {"ms", measured.ms}, {"bytes", measured.bytes}};
        if (measured.percent_of_bandwidth)
            stage["percent_of_bandwidth"] = *measured.percent_of_bandwidth;
        stages.push_back(std::move(stage));
    }
    nlohmann::json json = {{"name", build.name},
                           {"stages", std::move(stages)},
                           {"ms", build.ms},
                           {"bytes_per_primitive", build.bytes_per_primitive},
                           {"plausible", build.plausible}};
    if (build.host_trees) {
        json["sah_cost"] = build.host_trees->sah_cost;
        json["hploc_ms"] = build.host_trees->hploc_ms;
        json["hploc_sah_cost"] = build.host_trees->hploc_sah_cost;
    }
    return json;
}

/// Right-aligned, in fixed notation.
void print_number(std::ostream& out, double number, int width, int decimals)
{
    out << std::fixed << std::setprecision(decimals) << std::setw(width) << number;
}

void print_rays(std::ostream& out, const RayCost& cost, int width)
{
    out << "  |";
    print_number(out, cost.mrays_per_s, width, 3);
    print_number(out, cost.nodes_per_ray, 7, 1);
    print_number(out, cost.primitives_per_ray, 7, 1);
}

void print_build(std::ostream& out, const StagedBuild& build)
{
    for (const MeasuredStage& stage : build.stages) {
        out << std::left << std::setw(10) << build.name << std::setw(7) << stage.name << std::right;
        print_number(out, stage.ms, 9, 3);
        print_number(out, stage.bytes * 1e-6, 11, 2);
        if (stage.percent_of_bandwidth) print_number(out, *stage.percent_of_bandwidth, 16, 1);
        out << '\n';
    }
    out << std::left << std::setw(10) << build.name << "all    " << std::right;
    print_number(out, build.ms, 9, 3);
    out << ", " << std::setprecision(0) << build.bytes_per_primitive << " bytes per primitive\n";
    if (!build.host_trees) return;
    out << std::setprecision(2) << "          SAH cost " << build.host_trees->sah_cost
        << "; by clustering (hploc), " << build.host_trees->hploc_ms
        << " ms in place of tree and refit: " << build.host_trees->hploc_sah_cost << '\n';
}

} // namespace

void print_builders(std::ostream& out, const MeasuredBuilders& measured)
{
    out << measured.scene << ": " << measured.primitives << " primitives; C_trav " << ref::C_trav
        << ", C_isect " << ref::C_isect << "; CPU time, one thread\n"
        << "builder    build ms  SAH cost  depth  |  camera: Mrays/s  nodes  prims  |  diffuse: "
           "Mrays/s  nodes  prims\n";
    double largest_error = 0;
    for (const MeasuredBuilder& builder : measured.builders) {
        for (const RayCost& cost : {builder.camera, builder.diffuse})
            largest_error = std::max(largest_error, cost.relative_standard_error.value_or(0));
        out << std::left << std::setw(10) << builder.name << std::right;
        print_number(out, builder.build_ms, 9, 2);
        print_number(out, builder.quality.sah_cost, 10, 2);
        print_number(out, builder.quality.depth, 7, 0);
        print_rays(out, builder.camera, 17);
        print_rays(out, builder.diffuse, 18);
        out << '\n';
    }
    out << "Mrays/s: standard error up to " << std::setprecision(1) << 100 * largest_error << "%\n";
}

void print_stages(std::ostream& out, const MeasuredStages& measured)
{
    out << std::fixed << measured.scene << ": " << measured.primitives << " primitives; "
        << measured.device << ", " << measured.described << ", " << std::setprecision(1)
        << measured.bytes_per_second * 1e-9
        << " GB/s\nbuilder   stage         ms   MB moved  % of bandwidth\n";
    for (const StagedBuild& build : measured.builders) print_build(out, build);
    if (!measured.plausible)
        out << "A stage claims to move more than the memory can: some figure is wrong.\n";
}

std::string builders_json(const MeasuredBuilders& measured)
{
    nlohmann::json json = {{"scene", measured.scene},
                           {"primitives", measured.primitives},
                           {"C_trav", ref::C_trav},
                           {"C_isect", ref::C_isect},
                           {"builders", nlohmann::json::array()}};
    for (const MeasuredBuilder& builder : measured.builders)
        json["builders"].push_back(json_of(builder));
    return json.dump();
}

std::string stages_json(const MeasuredStages& measured)
{
    nlohmann::json json = {{"scene", measured.scene},
                           {"primitives", measured.primitives},
                           {"device", measured.device},
                           {"described", measured.described},
                           {"plausible", measured.plausible},
                           {"bytes_per_second", measured.bytes_per_second},
                           {"builders", nlohmann::json::array()}};
    for (const StagedBuild& build : measured.builders) json["builders"].push_back(json_of(build));
    return json.dump();
}

} // namespace cli
