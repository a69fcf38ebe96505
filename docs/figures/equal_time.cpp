// Where does bidirectional path tracing pay? Measures, on each scene, the error of path tracing,
// bidirectional path tracing and light tracing after one second of CPU time, and how the time of a
// bidirectional sample is shared. Measured in rounds, with intervals (rounds.h).
//
// Usage: figure_equal_time --help. 96 x 64 pixels, at most 6 edges, one thread.

#include "docs/figures/measure.h"
#include "docs/figures/program.h"
#include "images/film.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/connect.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/renderer.h"
#include "ref/transport/subpath.h"
#include "trade/rounds.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr int width = 96;
constexpr int height = 64;
constexpr int max_edges = 6;

struct Method {
    const char* name;
    ref::Integrator integrator;
};
constexpr std::array methods = {Method{"path", ref::trace_path},
                                Method{"bdpt", ref::trace_bidirectionally},
                                Method{"light", ref::trace_light}};

struct Timed {
    images::Image image;
    double samples;
    double seconds; // time for these samples
};

/// As many samples per pixel as fit into the time; unfinished batches do not count.
Timed render_for(const ref::World& world, ref::Integrator integrator, std::uint64_t seed, double seconds)
{
    images::Film film(width, height);
    const double start = figures::cpu_seconds();
    double kept = 0.0;
    const auto renderer =
        ref::renderer(world, integrator, {.seed = seed, .max_edges = max_edges, .batch_size = 1});
    images::fill(film, 1U << 20, *renderer,
                 {{}, [&] { return kept > 0.0 && figures::cpu_seconds() - start > seconds; }},
                 [&](const images::Batch& /*batch*/) { kept = figures::cpu_seconds() - start; });
    return {film.mean(), static_cast<double>(film.batches()) * width * height, kept};
}

constexpr std::array part_names = {"walks", "emission hit", "next event", "light image", "inner"};
using Shares = std::array<double, part_names.size()>;

/// Shares of the time of bidirectional samples: walks, then the four families.
Shares shares_of_time(const ref::World& world, std::uint64_t seed)
{
    using Clock = std::chrono::steady_clock;
    Shares spent{};
    const ref::PathOptions options{.max_edges = max_edges};
    const auto timed = [&](std::size_t what, auto&& work) {
        const auto start = Clock::now();
        work();
        spent[what] += std::chrono::duration<double>(Clock::now() - start).count();
    };
    for (std::uint32_t pixel = 0; pixel < width * height; ++pixel)
        for (std::uint32_t sample = 0; sample < 8; ++sample) {
            const ref::SampleId id{seed, pixel, sample};
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

/// False if the scene has mirrors or glass: light tracing cannot find light that reaches the eye by way
/// of them, because no walk hits a pinhole, and a vertex with a delta lobe cannot be joined to it.
bool light_tracing_sees_everything(const scenes::Scene& scene)
{
    const auto is_smooth = [](const scenes::Material& m) {
        return std::holds_alternative<scenes::Mirror>(m) || std::holds_alternative<scenes::Glass>(m);
    };
    return std::ranges::none_of(scene.materials, is_smooth);
}

/// The values of one scene, by round.
struct Rounds {
    std::array<std::vector<double>, methods.size()> rates;  // samples per second
    std::array<std::vector<double>, methods.size()> errors; // relMSE after one second
    std::array<std::vector<double>, part_names.size()> shares;
};

Rounds measure(const scenes::Scene& scene, const figures::RoundOptions& options, std::mt19937_64& random)
{
    const ref::World world(scene, width, height);
    const images::Image reference =
        render_for(world, ref::trace_bidirectionally, options.seed, options.reference_seconds).image;
    Rounds values;
    std::vector<trade::Measurement> measurements;
    // No two pictures share their random numbers.
    const auto seed_of = [&](std::size_t round, std::size_t i) {
        return options.seed + 1 + round * (methods.size() + 1) + i;
    };
    for (std::size_t i = 0; i < methods.size(); ++i)
        measurements.emplace_back([&, i](std::size_t round) {
            const Timed timed =
                render_for(world, methods[i].integrator, seed_of(round, i), options.seconds);
            values.rates[i].push_back(timed.samples / timed.seconds);
            // The error of independent samples is inverse to the time. Scaled to one second.
            return figures::relative_mean_square_error(timed.image, reference) * timed.seconds;
        });
    measurements.emplace_back([&](std::size_t round) {
        const Shares shares = shares_of_time(world, seed_of(round, methods.size()));
        for (std::size_t i = 0; i < shares.size(); ++i) values.shares[i].push_back(shares[i]);
        return 0.0;
    });
    const auto errors = trade::measure_in_rounds(options.rounds, random, measurements);
    std::copy_n(errors.begin(), methods.size(), values.errors.begin());
    return values;
}

/// The method with less error, if the interval of the quotient of errors excludes 1.
std::string verdict(const trade::Estimate& path_over_bdpt)
{
    if (!path_over_bdpt.decided()) return "not decided";
    return path_over_bdpt.value > 1.0 ? "bdpt" : "path";
}

void print_scene(const scenes::Scene& scene, const Rounds& values)
{
    std::printf("| %s |", scene.name.c_str());
    for (std::size_t i = 0; i < methods.size(); ++i) {
        std::vector<double> thousands;
        for (const double rate : values.rates[i]) thousands.push_back(rate / 1e3);
        const bool blind =
            methods[i].integrator == ref::trace_light && !light_tracing_sees_everything(scene);
        std::printf(" %s | %s%s |", to_text(trade::mean_of_rounds(thousands)).c_str(),
                    to_text(trade::mean_of_rounds(values.errors[i])).c_str(), blind ? " *" : "");
    }
    const trade::Estimate ratio = trade::ratio_of_rounds(values.errors[0], values.errors[1]);
    std::printf(" %s | %s |", to_text(ratio).c_str(), verdict(ratio).c_str());
    for (const std::vector<double>& shares : values.shares) {
        std::vector<double> percent;
        for (const double share : shares) percent.push_back(100.0 * share);
        std::printf(" %s |", to_text(trade::mean_of_rounds(percent)).c_str());
    }
    std::printf("\n");
    std::fflush(stdout);
}

void print_head()
{
    std::string head = "| scene |";
    for (const Method& method : methods)
        head += std::string(" ") + method.name + ": 1000 samples/s | relMSE after 1 s |";
    head += " relMSE path / bdpt | less error |";
    for (const char* part : part_names) head += std::string(" ") + part + ", % |";
    std::string line;
    for (const char c : head)
        if (c == '|') line += line.empty() ? "|" : "---|";
    std::printf("%s\n%s\n", head.c_str(), line.c_str());
}

} // namespace

int main(int argc, char** argv)
{
    figures::Program program("Prints the table of docs/results/bdpt.md on path, bidirectional and light "
                             "tracing at equal CPU time",
                             "figure_equal_time");
    figures::SceneFiles files;
    figures::RoundOptions options;
    program.add(files);
    program.add(options);
    program.set_footer("Means over the rounds with 95% intervals.\n"
                       "Example: figure_equal_time scenes/cornell_glass.dae --rounds 10");
    return program.run(argc, argv, [&] {
        const std::vector<scenes::Scene> all = figures::read_scenes(files);
        std::mt19937_64 random(options.seed);
        print_head();
        for (const scenes::Scene& scene : all) print_scene(scene, measure(scene, options, random));
    });
}
