// Where does it pay to trace from both ends? The error of path tracing, bidirectional path tracing and
// light tracing after one second of CPU time, on each scene; and where the time of a bidirectional
// sample goes.
//
// usage: figure_equal_time [SCENE.dae...] [--frame SCENE.dae...]
// Writes a table of docs/bdpt.md to stdout. 96 x 64 pixels, at most 6 edges, one thread; the camera of
// scenes after --frame is moved back to where it sees everything.

#include "docs/figures/measure.h"
#include "golden/image.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/connect.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/render.h"
#include "ref/transport/subpath.h"
#include "scenes/frame.h"
#include "scenes/read_scene.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace {

constexpr int width = 96;
constexpr int height = 64;
constexpr int max_edges = 6;
constexpr double seconds_each = 0.5;      // CPU time of every rendering that is judged
constexpr double seconds_reference = 6.0; // of the bidirectional one that they are judged against

struct Timed {
    golden::Image image;
    double samples;
    double seconds; // that they took
};

/// As many samples per pixel as fit into the time; what was begun and not finished does not count.
Timed render_for(const ref::World& world, ref::Integrator integrator, std::uint64_t seed, double seconds)
{
    golden::Film film(width, height);
    const double start = figures::cpu_seconds();
    double kept = 0.0;
    ref::render(world, integrator, {{.seed = seed, .max_edges = max_edges}, 1U << 20, 1, 1}, film,
                {{},
                 [&] { return kept > 0.0 && figures::cpu_seconds() - start > seconds; },
                 [&](const golden::Film&) { kept = figures::cpu_seconds() - start; }});
    return {film.mean(), static_cast<double>(film.batches()) * width * height, kept};
}

/// Shares of the time of bidirectional samples: walks, then the four families.
std::array<double, 5> shares_of_time(const ref::World& world)
{
    using Clock = std::chrono::steady_clock;
    std::array<double, 5> spent{};
    const ref::PathOptions options{.max_edges = max_edges};
    const auto timed = [&](std::size_t what, auto&& work) {
        const auto start = Clock::now();
        work();
        spent[what] += std::chrono::duration<double>(Clock::now() - start).count();
    };
    for (std::uint32_t pixel = 0; pixel < width * height; ++pixel)
        for (std::uint32_t sample = 0; sample < 8; ++sample) {
            const ref::SampleId id{0, pixel, sample};
            std::vector<ref::Vertex> z;
            std::vector<ref::Vertex> y;
            timed(0, [&] {
                z = eye_subpath(world, options, id, max_edges + 1);
                y = light_subpath(world, options, id, max_edges);
            });
            const auto eye_walk = [&](std::size_t t) {
                return std::span<const ref::Vertex>(z.data(), t);
            };
            const auto light_walk = [&](std::size_t s) {
                return std::span<const ref::Vertex>(y.data(), s);
            };
            timed(1, [&] {
                for (std::size_t t = 2; t <= z.size(); ++t)
                    emission_hit(world, options, id, eye_walk(t));
            });
            timed(2, [&] {
                for (std::size_t t = 2; t <= std::min<std::size_t>(z.size(), max_edges); ++t)
                    next_event(world, options, id, eye_walk(t));
            });
            timed(3, [&] {
                for (std::size_t s = 1; s <= y.size(); ++s)
                    light_image(world, options, light_walk(s), z[0]);
            });
            timed(4, [&] {
                for (std::size_t t = 2; t <= z.size(); ++t)
                    for (std::size_t s = 2; s <= y.size() && s + t - 1 <= max_edges; ++s)
                        inner_connection(world, options, id, light_walk(s), eye_walk(t));
            });
        }
    double total = 0.0;
    for (const double s : spent) total += s;
    for (double& s : spent) s /= total;
    return spent;
}

/// Light that reaches the eye by way of a mirror or glass is beyond light tracing: a pinhole is hit by
/// no walk, and a delta lobe joins nothing to it.
bool light_tracing_sees_everything(const scenes::Scene& scene)
{
    const auto is_smooth = [](const scenes::Material& m) {
        return std::holds_alternative<scenes::Mirror>(m) || std::holds_alternative<scenes::Glass>(m);
    };
    return std::ranges::none_of(scene.materials, is_smooth);
}

void judge(const char* file, bool framed)
{
    scenes::Scene scene = scenes::read_scene(file);
    if (framed) scenes::frame_camera(scene);
    const ref::World world(scene, width, height);
    const Timed reference = render_for(world, ref::trace_bidirectionally, 1, seconds_reference);
    std::printf("| %s%s |", scene.name.c_str(), framed ? " (framed)" : "");
    for (const ref::Integrator integrator :
         {ref::trace_path, ref::trace_bidirectionally, ref::trace_light}) {
        const Timed timed = render_for(world, integrator, 2, seconds_each);
        const bool blind = integrator == ref::trace_light && !light_tracing_sees_everything(scene);
        // The error of independent samples is inverse to the time: after one second of it.
        std::printf(" %.0fk | %.2g%s |", timed.samples / timed.seconds / 1000.0,
                    figures::relative_mean_square_error(timed.image, reference.image) * timed.seconds,
                    blind ? " *" : "");
    }
    for (const double share : shares_of_time(world)) std::printf(" %.0f%% |", 100.0 * share);
    std::printf("\n");
    std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv)
{
    try {
        if (argc < 2)
            throw std::invalid_argument(
                "usage: figure_equal_time [SCENE.dae...] [--frame SCENE.dae...]");
        std::printf("| scene | path: samples/s | relMSE | bdpt: samples/s | relMSE | light: samples/s | "
                    "relMSE | "
                    "walks | emission hit | next event | light image | inner |\n"
                    "|---|---|---|---|---|---|---|---|---|---|---|---|\n");
        bool framed = false;
        for (int i = 1; i < argc; ++i) {
            if (std::string_view(argv[i]) == "--frame")
                framed = true;
            else
                judge(argv[i], framed);
        }
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "figure_equal_time: %s\n", error.what());
        return 2;
    }
}
