// Shows the defect of uniform weights on glass. The weights 1 / (i + j + 1) of a 2015 course report
// (Heuristic::uniform) share every path equally among all strategies, possible or not. They are compared
// with the right weights and with path tracing.
// Usage: figure_uniform_weights --help

#include "docs/figures/program.h"
#include "images/file_ending.h"
#include "images/label.h"
#include "images/png.h"
#include "images/write_image.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/renderer.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int width = 240;
constexpr int height = 160;
constexpr int runs = 12; // independent runs, for standard errors
constexpr int samples_per_run = 8;
constexpr int max_edges = 6;

enum Method { uniform_weights, right_weights, path_tracing, methods };
enum Region { diffuse, mirror, glass, regions };
constexpr std::array<const char*, regions> region_names = {"diffuse surfaces", "mirror sphere",
                                                           "glass sphere"};

/// The region that the ray through the centre of a pixel hits first.
Region region_of(const ref::World& world, int x, int y)
{
    const auto hit = intersect(world.geometry, world.camera.ray({x + 0.5, y + 0.5}));
    if (!hit) return diffuse;
    const auto& material = world.scene.materials[material_of(world.scene, hit->primitive)];
    if (std::holds_alternative<scenes::Glass>(material)) return glass;
    return std::holds_alternative<scenes::Mirror>(material) ? mirror : diffuse;
}

/// One run of each method. The two weightings have the same seed, so they use the same paths and differ
/// only in the weights.
std::array<images::Image, methods> rendered(const ref::World& world, std::uint64_t run)
{
    const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    const auto mean = [&](ref::Integrator integrator, const images::RenderOptions& options) {
        images::Film film(width, height);
        images::fill(film, samples_per_run / options.batch_size,
                     *ref::renderer(world, integrator, options, threads));
        return film.mean();
    };
    return {mean(ref::trace_bidirectionally,
                 {.heuristic = images::Heuristic::uniform, .seed = run, .max_edges = max_edges}),
            mean(ref::trace_bidirectionally, {.seed = run, .max_edges = max_edges}),
            mean(ref::trace_path, {.seed = run + 1000, .max_edges = max_edges})};
}

/// Mean over channels of a region's pixels.
std::array<double, regions> region_means(const images::Image& image, const std::vector<Region>& region)
{
    std::array<double, regions> sum{};
    std::array<int, regions> count{};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        sum[region[i]] += (image.pixels[i].x + image.pixels[i].y + image.pixels[i].z) / 3.0;
        ++count[region[i]];
    }
    for (std::size_t r = 0; r < regions; ++r) sum[r] /= count[r];
    return sum;
}

void draw(const scenes::Scene& scene, const std::string& out)
{
    const ref::World world(scene, width, height);
    std::vector<Region> region;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) region.push_back(region_of(world, x, y));

    constexpr int label = 14;
    images::Image side_by_side(methods * width, height + label);
    std::array<std::array<std::vector<double>, regions>, methods> means;
    for (int run = 0; run < runs; ++run) {
        const auto images = rendered(world, static_cast<std::uint64_t>(run));
        for (std::size_t method = 0; method < methods; ++method) {
            const auto by_region = region_means(images[method], region);
            for (std::size_t r = 0; r < regions; ++r) means[method][r].push_back(by_region[r]);
            for (int y = 0; y < height; ++y)
                for (int x = 0; x < width; ++x)
                    side_by_side.pixels[static_cast<std::size_t>(
                        (y + label) * side_by_side.width + static_cast<int>(method) * width + x)] +=
                        images[method].pixels[static_cast<std::size_t>(y * width + x)] /
                        static_cast<double>(runs);
        }
    }
    constexpr std::array names = {"1 / (i + j + 1)", "balance heuristic", "path tracing"};
    for (int method = 0; method < methods; ++method)
        images::draw_text(side_by_side, method * width + 4, 3, names[static_cast<std::size_t>(method)],
                          images::Rgb(0.8));
    images::write_png(out, side_by_side);

    const auto statistics = [](const std::vector<double>& values) {
        double mean = 0.0;
        double squares = 0.0;
        for (const double v : values) mean += v / runs;
        for (const double v : values) squares += (v - mean) * (v - mean);
        return std::pair(mean, std::sqrt(squares / (runs * (runs - 1.0))));
    };
    std::printf("| region | 1 / (i + j + 1) | balance heuristic | path tracing | first / last | second "
                "/ last |\n"
                "|---|---|---|---|---|---|\n");
    for (std::size_t r = 0; r < regions; ++r) {
        std::printf("| %s |", region_names[r]);
        for (const auto& method : means)
            std::printf(" %.5f +- %.5f |", statistics(method[r]).first, statistics(method[r]).second);
        const auto [truth, truth_error] = statistics(means[path_tracing][r]);
        for (const Method method : {uniform_weights, right_weights}) {
            const auto [mean, error] = statistics(means[method][r]);
            const double ratio = mean / truth;
            std::printf(" %.4f +- %.4f |", ratio, ratio * std::hypot(error / mean, truth_error / truth));
        }
        std::printf("\n");
    }
}

} // namespace

int main(int argc, char** argv)
{
    figures::Program program(
        "Draws pictures by uniform weights, by the balance heuristic and by path tracing side by side, "
        "and prints the table of docs/bdpt.md",
        "figure_uniform_weights");
    std::string scene;
    std::string out;
    program.add_file("scene", scene, "COLLADA file");
    program.add_file("picture", out, "Picture: .png");
    return program.run(argc, argv, [&] {
        if (!images::has_ending(out, ".png"))
            throw std::invalid_argument(out + ": the name of the picture must end in .png");
        images::check_writable(out);
        draw(figures::read_scene(scene), out);
    });
}
