// `plumbline bvh`: builds the trees of a scene, measures them side by side, and draws them.

#include "cli/bvh.h"

#include "cli/builders.h"
#include "cli/bvh_measure.h"
#include "cli/bvh_options.h"
#include "cli/bvh_picture.h"
#include "cli/bvh_stages.h"
#include "cli/bvh_svg.h"
#include "cli/idle_options.h"
#include "cli/output_files.h"
#include "cli/scene_input.h"
#include "images/atomic_file.h"
#include "images/png.h"
#include "images/write_image.h"
#include "ref/trees/bvh.h"
#include "ref/trees/geometry.h"
#include "ref/trees/sah.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace cli {

namespace {

using Options = BvhCommand;

/// The builder that was named, or all.
std::vector<NamedBuilder> chosen(const Options& options)
{
    std::vector<NamedBuilder> result;
    for (const NamedBuilder& builder : builders)
        if (options.builder.empty() || options.builder == builder.name) result.push_back(builder);
    return result;
}

void print_table(const nlohmann::json& report)
{
    std::cout << report["scene"].get<std::string>() << ": " << report["primitives"]
              << " primitives; C_trav " << ref::C_trav << ", C_isect " << ref::C_isect
              << "; CPU time, one thread\n"
              << "builder    build ms  SAH cost  depth  |  camera: Mrays/s  nodes  prims  |  diffuse: "
                 "Mrays/s  nodes  "
                 "prims\n";
    double error = 0; // the largest of all
    for (const auto& b : report["builders"]) {
        for (const char* key : {"camera_relative_standard_error", "diffuse_relative_standard_error"})
            if (b[key].is_number()) error = std::max(error, b[key].get<double>());
        const auto column = [&](const char* key, int width, int digits) {
            std::cout << std::fixed << std::setprecision(digits) << std::setw(width)
                      << b[key].get<double>();
        };
        std::cout << std::left << std::setw(10) << b["name"].get<std::string>() << std::right;
        column("build_ms", 9, 2);
        column("sah_cost", 10, 2);
        column("depth", 7, 0);
        std::cout << "  |";
        column("camera_mrays_per_s", 17, 3);
        column("camera_nodes_per_ray", 7, 1);
        column("camera_primitives_per_ray", 7, 1);
        std::cout << "  |";
        column("diffuse_mrays_per_s", 18, 3);
        column("diffuse_nodes_per_ray", 7, 1);
        column("diffuse_primitives_per_ray", 7, 1);
        std::cout << '\n';
    }
    std::cout << "Mrays/s: standard error up to " << std::setprecision(1) << 100 * error << "%\n";
}

/// The figure of the radix tree over the scene's primitives. Throws std::invalid_argument.
std::string figure_of(const scenes::Scene& scene, const Options& options)
{
    const std::vector<ref::Aabb> boxes = ref::primitive_bounds(scene);
    const NamedBuilder named = chosen(options).front();
    if (named.builder != ref::Builder::morton30 && named.builder != ref::Builder::morton63)
        throw std::invalid_argument("--tree draws radix trees: not those of " + options.builder);
    if (boxes.empty() || boxes.size() > most_keys_in_figure)
        throw std::invalid_argument(shown_name(options.scene) + ": has " + std::to_string(boxes.size()) +
                                    " primitives: --tree draws from 1 to " +
                                    std::to_string(most_keys_in_figure));
    const int bits_per_axis = named.builder == ref::Builder::morton30 ? 10 : 21;
    const std::vector<std::uint64_t> codes = ref::morton_codes(boxes, bits_per_axis);
    const ref::Tree tree = ref::build(boxes, named.builder);
    std::vector<std::uint64_t> sorted;
    for (const std::uint32_t primitive : tree.primitives) sorted.push_back(codes[primitive]);
    return radix_tree_figure(sorted, tree.primitives, 3 * bits_per_axis);
}

images::Image picture_of(const ref::Geometry& geometry, const Options& options, const Size& size)
{
    constexpr std::size_t pieces = 16;
    constexpr double most_visits = 64;
    if (options.show == "order") return draw_order(geometry, pieces, size.width, size.height);
    if (options.show == "visits") return draw_visits(geometry, most_visits, size.width, size.height);
    return draw_boxes(geometry, options.level, size.width, size.height);
}

ExitStatus bvh(const Options& options)
{
    const Size size = parse_size(options.size);
    expect_ending(options.picture, "--picture", ".png");
    expect_ending(options.figure, "--tree", ".svg");
    expect_different_files({{"--picture", options.picture}, {"--tree", options.figure}},
                           {{"the scene", options.scene}});
    for (const std::string& path : {options.picture, options.figure})
        if (!path.empty()) images::check_place(path);
    const scenes::Scene scene = load_triangles(options.scene, options.frame, options.quiet);

    if (!options.figure.empty()) images::write_atomically(options.figure, figure_of(scene, options));
    if (!options.picture.empty()) {
        const ref::Geometry geometry(scene, chosen(options).front().builder);
        images::write_png(options.picture, picture_of(geometry, options, size));
    }
    if (!options.device.empty()) {
        const nlohmann::json stages =
            measure_stages(scene, options.device, options.threads, options.repeats);
        if (options.json)
            std::cout << stages.dump() << std::endl;
        else
            print_stages(stages);
        return stages["plausible"].get<bool>() ? fine : check_failed;
    }
    if (!measures_builders(options)) return fine;

    nlohmann::json report = {{"scene", scene.name},
                             {"primitives", scenes::primitive_count(scene)},
                             {"C_trav", ref::C_trav},
                             {"C_isect", ref::C_isect},
                             {"builders", nlohmann::json::array()}};
    for (const NamedBuilder& named : chosen(options))
        report["builders"].push_back(measure_builder(scene, named, size, options.repeats));
    if (options.json)
        std::cout << report.dump() << std::endl;
    else
        print_table(report);
    return fine;
}

} // namespace

void add_bvh_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        program.add_subcommand("bvh", "Build, measure and draw the trees of a scene file");
    add_bvh_options(*command, *options);
    command->footer(
        "Example: plumbline bvh scenes/cornell_diffuse.dae --builder sah --picture boxes.png --level 3");
    command->callback([options, command, &work] {
        work = [options, command] {
            expect_no_idle_options(*command, *options);
            return bvh(*options);
        };
    });
}

} // namespace cli
