// How fast is the fast path? Samples per CPU second beside the reference, the error of path tracing and
// bidirectional path tracing after one second, what a second thread brings, and what kernels gain by
// leaving out what a scene does not have.
//
// usage: figure_fast_transport [SCENE.dae...] [--frame SCENE.dae...]
// Writes the tables of docs/cuda-bdpt.md to stdout. 240 x 160 pixels, at most 6 edges; the camera of
// scenes after --frame is moved back to where it sees everything. Best of three runs of 0.7 s each.

#include "cuda/transport/renderer.h"
#include "docs/figures/measure.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/render.h"
#include "scenes/frame.h"
#include "scenes/read_scene.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace {

constexpr int width = 240;
constexpr int height = 160;
constexpr int max_edges = 6;
constexpr double seconds_each = 0.7;
constexpr double seconds_reference = 8.0; // of the picture that errors are measured by
constexpr int runs = 3;

double wall_seconds()
{
    using Clock = std::chrono::steady_clock;
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

struct Rendered {
    golden::Image image;
    double samples_per_second;
    double seconds;
};

/// Batches for as long as `seconds` of `clock`; `render_batch` takes a number.
template <class RenderBatch>
Rendered render_for(double seconds, double (*clock)(), const RenderBatch& render_batch)
{
    golden::Film film(width, height);
    std::uint64_t number = 0;
    render_batch(number); // caches and launch sizes
    const double start = clock();
    while (clock() - start < seconds) film.add_batch(render_batch(++number));
    const double passed = clock() - start;
    return {film.mean(), static_cast<double>(film.batches()) * 4 * width * height / passed, passed};
}

Rendered fast(const scenes::Scene& scene, gpu::Integrator integrator, unsigned threads, double seconds,
              std::uint64_t seed, gpu::Needs at_least = {})
{
    gpu::RenderOptions options;
    options.integrator = integrator;
    options.max_edges = max_edges;
    options.seed = seed;
    options.at_least = at_least;
    const auto renderer = gpu::host_renderer(scene, width, height, options, threads);
    return render_for(seconds, threads == 1 ? figures::cpu_seconds : wall_seconds,
                      [&](std::uint64_t number) { return renderer->render_batch(number, {})->mean; });
}

Rendered by_reference(const scenes::Scene& scene, ref::Integrator integrator)
{
    const ref::World world(scene, width, height);
    const ref::RenderOptions options{{.seed = 2, .max_edges = max_edges}, 1U << 20, 4, 1};
    return render_for(seconds_each, figures::cpu_seconds, [&](std::uint64_t number) {
        return *ref::render_batch(world, integrator, options, number);
    });
}

double best(const std::vector<double>& values)
{
    return *std::ranges::max_element(values);
}

/// The best rate of several runs.
template <class Render>
double rate_of(const Render& render)
{
    std::vector<double> rates;
    for (int i = 0; i < runs; ++i) rates.push_back(render().samples_per_second);
    return best(rates);
}

void compare(const scenes::Scene& scene)
{
    using enum gpu::Integrator;
    const Rendered truth = fast(scene, bdpt, 1, seconds_reference, 1);
    std::printf("| %s |", scene.name.c_str());
    for (const bool both : {false, true}) {
        const gpu::Integrator integrator = both ? bdpt : path;
        const double rate = rate_of([&] { return fast(scene, integrator, 1, seconds_each, 2); });
        const double reference = rate_of(
            [&] { return by_reference(scene, both ? ref::trace_bidirectionally : ref::trace_path); });
        const double two = rate_of([&] { return fast(scene, integrator, 2, seconds_each, 2); });
        const Rendered judged = fast(scene, integrator, 1, seconds_each, 3);
        const double error =
            figures::relative_mean_square_error(judged.image, truth.image) * judged.seconds;
        std::printf(" %.0fk | %.0fk | %.1f | %.2f | %.3g |", rate / 1e3, reference / 1e3,
                    rate / reference, two / rate, 1.0 / error);
    }
    std::printf("\n");
    std::fflush(stdout);
}

void measure_needs(const scenes::Scene& scene)
{
    for (const bool both : {false, true}) {
        const gpu::Integrator integrator = both ? gpu::Integrator::bdpt : gpu::Integrator::path;
        const auto rate = [&](gpu::Needs at_least) {
            return rate_of([&] { return fast(scene, integrator, 1, seconds_each, 2, at_least); });
        };
        const double own = rate({});
        std::printf("| %s | %s | %.0fk |", scene.name.c_str(), both ? "bdpt" : "path", own / 1e3);
        for (const gpu::Needs more : {gpu::Needs{true, false, false}, gpu::Needs{false, true, false},
                                      gpu::Needs{false, false, true}, gpu::Needs{true, true, true}})
            std::printf(" %+.1f%% |", 100.0 * (rate(more) / own - 1.0));
        std::printf("\n");
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv)
{
    try {
        if (argc < 2)
            throw std::invalid_argument(
                "usage: figure_fast_transport [SCENE.dae...] [--frame SCENE.dae...]");
        std::vector<scenes::Scene> all;
        bool framed = false;
        for (int i = 1; i < argc; ++i) {
            if (std::string_view(argv[i]) == "--frame") {
                framed = true;
                continue;
            }
            all.push_back(scenes::read_scene(argv[i]));
            if (framed) scenes::frame_camera(all.back());
        }
        std::printf(
            "| scene | path: samples/s | ref | ratio | two threads | 1/(relMSE s) | bdpt: samples/s | "
            "ref | "
            "ratio | two threads | 1/(relMSE s) |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
        for (const scenes::Scene& scene : all) compare(scene);
        std::printf(
            "\n| scene | integrator | samples/s | with spheres | with mirrors and glass | with other "
            "lights | with all |\n|---|---|---|---|---|---|---|\n");
        for (const scenes::Scene& scene : all) measure_needs(scene);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "figure_fast_transport: %s\n", error.what());
        return 2;
    }
}
