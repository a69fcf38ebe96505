// `plumbline bvh`: builds the trees of a scene, measures them side by side, and draws them.

#include "cli/bvh_command.h"

#include "cli/builders.h"
#include "cli/bvh_measure.h"
#include "cli/bvh_picture.h"
#include "cli/bvh_report.h"
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

#include <CLI/CLI.hpp>

#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace cli {

namespace {

/// The builder of --builder, or all.
std::vector<NamedBuilder> chosen(const BvhCommand& options)
{
    std::vector<NamedBuilder> result;
    for (const NamedBuilder& builder : builders)
        if (options.builder.empty() || options.builder == builder.name) result.push_back(builder);
    return result;
}

/// The figure of the radix tree over the scene's primitives. Throws std::invalid_argument.
std::string figure_of(const scenes::Scene& scene, const BvhCommand& options)
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

images::Image picture_of(const ref::Geometry& geometry, const BvhCommand& options, const Size& size)
{
    constexpr std::size_t pieces = 16;
    constexpr double most_visits = 64;
    if (options.show == "order") return draw_order(geometry, pieces, size.width, size.height);
    if (options.show == "visits") return draw_visits(geometry, most_visits, size.width, size.height);
    return draw_boxes(geometry, options.level, size.width, size.height);
}

void draw(const scenes::Scene& scene, const BvhCommand& options, const Size& size)
{
    if (!options.figure.empty()) images::write_atomically(options.figure, figure_of(scene, options));
    if (options.picture.empty()) return;
    const ref::Geometry geometry(scene, chosen(options).front().builder);
    images::write_png(options.picture, picture_of(geometry, options, size));
}

ExitStatus time_stages(const scenes::Scene& scene, const BvhCommand& options)
{
    const MeasuredStages measured =
        measure_stages(scene, options.device, options.threads, options.repeats);
    if (options.json)
        std::cout << stages_json(measured) << std::endl;
    else
        print_stages(std::cout, measured);
    return measured.plausible ? fine : check_failed;
}

ExitStatus compare_builders(const scenes::Scene& scene, const BvhCommand& options, const Size& size)
{
    MeasuredBuilders measured{scene.name, scenes::primitive_count(scene), {}};
    for (const NamedBuilder& named : chosen(options))
        measured.builders.push_back(measure_builder(scene, named, size, options.repeats));
    if (options.json)
        std::cout << builders_json(measured) << std::endl;
    else
        print_builders(std::cout, measured);
    return fine;
}

ExitStatus bvh(const BvhCommand& options)
{
    const Size size = parse_size(options.size);
    expect_ending(options.picture, "--picture", ".png");
    expect_ending(options.figure, "--tree", ".svg");
    expect_different_files({{"--picture", options.picture}, {"--tree", options.figure}},
                           {{"the scene", options.scene}});
    for (const std::string& path : {options.picture, options.figure})
        if (!path.empty()) images::check_place(path);
    const scenes::Scene scene = load_triangles(options.scene, options.frame, options.quiet);

    draw(scene, options, size);
    if (!options.device.empty()) return time_stages(scene, options);
    return measures_builders(options) ? compare_builders(scene, options, size) : fine;
}

} // namespace

void add_bvh_command(CLI::App& program, Work& work)
{
    const auto options = std::make_shared<BvhCommand>();
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
