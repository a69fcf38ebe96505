// `plumbline bvh`: builds the trees of a scene, measures them side by side, and draws them.

#include "cli/bvh.h"

#include "cli/bvh_picture.h"
#include "cli/bvh_svg.h"
#include "golden/atomic_file.h"
#include "golden/png.h"
#include "golden/write_image.h"
#include "ref/transport/camera.h"
#include "ref/transport/random.h"
#include "ref/transport/sampling.h"
#include "ref/trees/bvh.h"
#include "ref/trees/geometry.h"
#include "ref/trees/quality.h"
#include "ref/trees/sah.h"
#include "scenes/frame.h"
#include "scenes/read_scene.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <ctime>
#include <iomanip>
#include <iostream>
#include <memory>
#include <stdexcept>

namespace cli {

namespace {

struct Options {
    std::string scene;
    std::string builder;
    std::string picture;
    std::string figure;
    int level = 4;
    int repeats = 5;
    int width = 240;
    int height = 160;
    bool frame = false;
    bool json = false;
    bool quiet = false;
};

struct NamedBuilder {
    const char* name;
    ref::Builder builder;
};

constexpr std::array builders = {
    NamedBuilder{"morton30", ref::Builder::morton30}, NamedBuilder{"morton63", ref::Builder::morton63},
    NamedBuilder{"sah", ref::Builder::sah}, NamedBuilder{"sah-leaf", ref::Builder::sah_leaf}};

/// The builder that was named, or all.
std::vector<NamedBuilder> chosen(const Options& options)
{
    std::vector<NamedBuilder> result;
    for (const NamedBuilder& builder : builders)
        if (options.builder.empty() || options.builder == builder.name) result.push_back(builder);
    return result;
}

/// CPU time of `work` in seconds. Everything here runs on one thread, so on an idle machine this is the
/// time that passes; on a busy one it is what the work itself costs.
template <typename Function>
double cpu_seconds(Function work)
{
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// What rays of one kind cost, on average.
struct RayCost {
    double mrays_per_s = 0;
    double nodes_per_ray = 0;
    double primitives_per_ray = 0;
};

RayCost measure(const ref::Geometry& geometry, const std::vector<ref::Ray>& rays)
{
    if (rays.empty()) return {};
    ref::Work work;
    double seconds = 0;
    std::uint64_t traced = 0;
    std::uint64_t hits = 0;
    while (seconds < 0.3) { // clock() ticks in microseconds: 0.3 s make its error vanish
        work = {};
        seconds += cpu_seconds([&] {
            for (const ref::Ray& ray : rays) hits += intersect(geometry, ray, &work) ? 1 : 0;
        });
        traced += rays.size();
    }
    if (hits > traced)
        throw std::logic_error("more hits than rays"); // keeps the loop from being dropped
    const auto count = static_cast<double>(rays.size());
    return {static_cast<double>(traced) / seconds * 1e-6, static_cast<double>(work.nodes) / count,
            static_cast<double>(work.primitives) / count};
}

struct Rays {
    std::vector<ref::Ray> camera;
    std::vector<ref::Ray> diffuse;
};

/// A ray through the middle of every pixel, and from where it hits one in a cosine-distributed
/// direction.
Rays make_rays(const ref::Geometry& geometry, const Options& options)
{
    Rays rays;
    const ref::Camera camera(*geometry.scene().camera, options.width, options.height);
    std::uint32_t pixel = 0;
    for (int y = 0; y < options.height; ++y)
        for (int x = 0; x < options.width; ++x, ++pixel) {
            const ref::Ray ray = camera.ray({x + 0.5, y + 0.5});
            rays.camera.push_back(ray);
            const auto hit = intersect(geometry, ray);
            if (!hit) continue;
            const ref::SurfacePoint point = surface_point(geometry, ray, *hit);
            const bool front = glm::dot(ray.direction, point.normal) < 0;
            const ref::Uniforms u = ref::uniforms({0, pixel, 0}, ref::Event::eye_bounce);
            const ref::Vec3 local = ref::sample_cosine_hemisphere(u[0], u[1]);
            const ref::Vec3 direction = ref::Frame(front ? point.normal : -point.normal).to_world(local);
            rays.diffuse.push_back({leave_surface(point, direction), direction});
        }
    return rays;
}

double median_build_ms(const std::vector<ref::Aabb>& boxes, ref::Builder builder, int repeats)
{
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i)
        times.push_back(1e3 * cpu_seconds([&] { ref::build(boxes, builder); }));
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    return times[static_cast<std::size_t>(repeats) / 2];
}

nlohmann::json report_on(const scenes::Scene& scene, const NamedBuilder& named, const Options& options)
{
    const std::vector<ref::Aabb> boxes = ref::primitive_bounds(scene);
    const ref::Geometry geometry(scene, named.builder);
    const ref::Quality quality = ref::quality(geometry.tree());
    const Rays rays = make_rays(geometry, options);
    const RayCost camera = measure(geometry, rays.camera);
    const RayCost diffuse = measure(geometry, rays.diffuse);
    return {{"name", named.name},
            {"build_ms", median_build_ms(boxes, named.builder, options.repeats)},
            {"sah_cost", quality.sah_cost},
            {"depth", quality.depth},
            {"mean_leaf_depth", quality.mean_leaf_depth},
            {"overlap", quality.overlap},
            {"nodes", geometry.tree().nodes.size()},
            {"camera_mrays_per_s", camera.mrays_per_s},
            {"camera_nodes_per_ray", camera.nodes_per_ray},
            {"camera_primitives_per_ray", camera.primitives_per_ray},
            {"diffuse_mrays_per_s", diffuse.mrays_per_s},
            {"diffuse_nodes_per_ray", diffuse.nodes_per_ray},
            {"diffuse_primitives_per_ray", diffuse.primitives_per_ray}};
}

void print_table(const nlohmann::json& report)
{
    std::cout << report["scene"].get<std::string>() << ": " << report["primitives"]
              << " primitives; C_trav " << ref::C_trav << ", C_isect " << ref::C_isect
              << "; CPU time, one thread\n"
              << "builder    build ms  SAH cost  depth  |  camera: Mrays/s  nodes  prims  |  diffuse: "
                 "Mrays/s  nodes  "
                 "prims\n";
    for (const auto& b : report["builders"]) {
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
}

/// The figure of the radix tree over the scene's primitives. Throws std::invalid_argument.
std::string figure_of(const scenes::Scene& scene, const Options& options)
{
    const std::vector<ref::Aabb> boxes = ref::primitive_bounds(scene);
    const NamedBuilder named = chosen(options).front();
    if (named.builder != ref::Builder::morton30 && named.builder != ref::Builder::morton63)
        throw std::invalid_argument("--tree draws radix trees: not those of " + options.builder);
    if (boxes.empty() || boxes.size() > most_keys_in_figure)
        throw std::invalid_argument(options.scene + ": has " + std::to_string(boxes.size()) +
                                    " primitives: --tree draws from 1 to " +
                                    std::to_string(most_keys_in_figure));
    const int bits_per_axis = named.builder == ref::Builder::morton30 ? 10 : 21;
    const std::vector<std::uint64_t> codes = ref::morton_codes(boxes, bits_per_axis);
    const ref::Tree tree = ref::build(boxes, named.builder);
    std::vector<std::uint64_t> sorted;
    for (const std::uint32_t primitive : tree.primitives) sorted.push_back(codes[primitive]);
    return radix_tree_figure(sorted, tree.primitives, 3 * bits_per_axis);
}

ExitStatus bvh(const Options& options)
{
    if (!options.picture.empty()) {
        if (!options.picture.ends_with(".png"))
            throw std::invalid_argument("--picture " + options.picture + ": must end in .png");
        golden::check_writable(options.picture);
    }
    if (!options.figure.empty()) {
        if (!options.figure.ends_with(".svg"))
            throw std::invalid_argument("--tree " + options.figure + ": must end in .svg");
        golden::check_place(options.figure);
    }

    scenes::Scene scene = scenes::read_scene(options.scene);
    if (!options.quiet)
        for (const std::string& notice : scene.notices)
            std::cerr << options.scene << ": " << notice << '\n';
    if (options.frame) scenes::frame_camera(scene);
    if (!scene.camera)
        throw std::invalid_argument(options.scene + ": <COLLADA>: the scene has no camera");

    if (!options.figure.empty()) golden::write_atomically(options.figure, figure_of(scene, options));
    if (!options.picture.empty()) {
        const ref::Geometry geometry(scene, chosen(options).front().builder);
        golden::write_png(options.picture,
                          draw_boxes(geometry, options.level, options.width, options.height));
    }
    const bool only_drawn = !options.figure.empty() || !options.picture.empty();
    if (only_drawn && !options.json) return fine;

    nlohmann::json report = {{"scene", scene.name},
                             {"primitives", scenes::primitive_count(scene)},
                             {"C_trav", ref::C_trav},
                             {"C_isect", ref::C_isect},
                             {"builders", nlohmann::json::array()}};
    for (const NamedBuilder& named : chosen(options))
        report["builders"].push_back(report_on(scene, named, options));
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
    command->add_option("scene", options->scene, "COLLADA file")->required();
    command->add_option("--builder", options->builder, "morton30, morton63, sah or sah-leaf [all]")
        ->check(CLI::IsMember({"morton30", "morton63", "sah", "sah-leaf"}));
    command->add_option("--picture", options->picture, "Draw boxes over the scene: .png");
    command->add_option("--level", options->level, "Which boxes: those at this depth, root 0")
        ->check(CLI::Range(0, 1000))
        ->capture_default_str();
    command->add_option("--tree", options->figure,
                        "Draw keys, ranges and splits of few primitives: .svg");
    command->add_option("--width", options->width, "Pixels, and camera rays, per row")
        ->check(CLI::Range(1, 8192))
        ->capture_default_str();
    command->add_option("--height", options->height, "Rows")
        ->check(CLI::Range(1, 8192))
        ->capture_default_str();
    command->add_option("--repeats", options->repeats, "Builds, of which the median time counts")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    command->add_flag("--frame", options->frame,
                      "Move the camera back to where it sees the whole scene");
    command->add_flag("--json", options->json, "Print one JSON object");
    command->add_flag("-q,--quiet", options->quiet, "No notices");
    command->footer(
        "Example: plumbline bvh scenes/cornell_diffuse.dae --builder sah --picture boxes.png --level 3");
    command->callback([options, &work] { work = [options] { return bvh(*options); }; });
}

} // namespace cli
