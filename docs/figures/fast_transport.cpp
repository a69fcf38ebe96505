// How fast is the fast path? Measures samples per CPU second beside the reference, the error of path
// tracing and bidirectional path tracing after one second, the gain from a second thread, and the gain
// from kernels without the features that a scene lacks. Measured in rounds, with intervals (rounds.h).
//
// Usage: figure_fast_transport --help. 240 x 160 pixels, at most 6 edges.

#include "cuda/launch/renderer.h"
#include "docs/figures/measure.h"
#include "docs/figures/program.h"
#include "ref/transport/bdpt.h"
#include "ref/transport/path_tracer.h"
#include "ref/transport/renderer.h"
#include "trade/rounds.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace {

constexpr int width = 240;
constexpr int height = 160;
constexpr int max_edges = 6;

double wall_seconds()
{
    using Clock = std::chrono::steady_clock;
    return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

struct Rendered {
    images::Image image;
    double samples_per_second;
    double seconds;
};

/// Renders batches for `seconds` of `clock`; `render_batch` takes the number of a batch.
template <class RenderBatch>
Rendered render_for(double seconds, double (*clock)(), const RenderBatch& render_batch)
{
    images::Film film(width, height);
    std::uint64_t number = 0;
    render_batch(number); // not timed: fills caches and adapts the size of launches
    const double start = clock();
    while (clock() - start < seconds) film.add_batch(render_batch(++number));
    const double passed = clock() - start;
    return {film.mean(), static_cast<double>(film.batches()) * 4 * width * height / passed, passed};
}

Rendered fast(const scenes::Scene& scene, fast::Integrator integrator, unsigned threads, double seconds,
              std::uint64_t seed, fast::Needs at_least = {})
{
    images::RenderOptions options;
    options.integrator = integrator;
    options.max_edges = max_edges;
    options.seed = seed;
    const auto renderer =
        fast::host_renderer(scene, width, height, options, threads, {.at_least = at_least});
    return render_for(seconds, threads == 1 ? figures::cpu_seconds : wall_seconds,
                      [&](std::uint64_t number) { return renderer->render_batch(number, {})->mean; });
}

Rendered by_reference(const scenes::Scene& scene, ref::Integrator integrator, double seconds,
                      std::uint64_t seed)
{
    const ref::World world(scene, width, height);
    const auto renderer = ref::renderer(world, integrator, {.seed = seed, .max_edges = max_edges});
    return render_for(seconds, figures::cpu_seconds,
                      [&](std::uint64_t number) { return renderer->render_batch(number)->mean; });
}

/// Rates in thousands of samples per second.
std::string rates_text(const std::vector<double>& rates)
{
    std::vector<double> thousands;
    for (const double rate : rates) thousands.push_back(rate / 1e3);
    return to_text(trade::mean_of_rounds(thousands));
}

/// Path tracing, then bidirectional path tracing.
constexpr std::array integrators = {fast::Integrator::path, fast::Integrator::bdpt};
constexpr std::array names = {"path", "bdpt"};
constexpr std::array reference_integrators = {ref::trace_path, ref::trace_bidirectionally};

/// Prints one scene in the first table: rates and efficiencies.
void compare(const scenes::Scene& scene, const figures::RoundOptions& options, std::mt19937_64& random)
{
    const images::Image truth =
        fast(scene, fast::Integrator::bdpt, 1, options.reference_seconds, options.seed).image;
    std::array<std::vector<double>, 2> efficiencies; // 1 / (relMSE s)
    std::vector<trade::Measurement> measurements;    // for each integrator: fast, reference, two threads
    const auto seed_of = [&](std::size_t round) { return options.seed + 1 + round; };
    for (std::size_t i = 0; i < integrators.size(); ++i) {
        measurements.emplace_back([&, i](std::size_t round) {
            const Rendered rendered = fast(scene, integrators[i], 1, options.seconds, seed_of(round));
            efficiencies[i].push_back(
                1.0 / (figures::relative_mean_square_error(rendered.image, truth) * rendered.seconds));
            return rendered.samples_per_second;
        });
        measurements.emplace_back([&, i](std::size_t round) {
            return by_reference(scene, reference_integrators[i], options.seconds, seed_of(round))
                .samples_per_second;
        });
        measurements.emplace_back([&, i](std::size_t round) {
            return fast(scene, integrators[i], 2, options.seconds, seed_of(round)).samples_per_second;
        });
    }
    const auto rates = trade::measure_in_rounds(options.rounds, random, measurements);

    std::printf("| %s |", scene.name.c_str());
    for (std::size_t i = 0; i < integrators.size(); ++i) {
        const std::vector<double>& one = rates[3 * i];
        const std::vector<double>& reference = rates[3 * i + 1];
        const std::vector<double>& two = rates[3 * i + 2];
        std::printf(" %s | %s | %s | %s | %s |", rates_text(one).c_str(), rates_text(reference).c_str(),
                    to_text(trade::ratio_of_rounds(one, reference)).c_str(),
                    to_text(trade::ratio_of_rounds(two, one)).c_str(),
                    to_text(trade::mean_of_rounds(efficiencies[i])).c_str());
    }
    const trade::Estimate gain = trade::ratio_of_rounds(efficiencies[1], efficiencies[0]);
    std::printf(" %s | %s |\n", to_text(gain).c_str(),
                !gain.decided() ? "not decided" : names[gain.value > 1.0 ? 1 : 0]);
    std::fflush(stdout);
}

/// Prints one scene in the second table: kernels with more features than the scene needs.
void measure_needs(const scenes::Scene& scene, const figures::RoundOptions& options,
                   std::mt19937_64& random)
{
    for (std::size_t i = 0; i < integrators.size(); ++i) {
        std::vector<trade::Measurement> measurements;
        for (const fast::Needs& needs : fast::compiled_needs)
            measurements.emplace_back([&, i, needs](std::size_t round) {
                return fast(scene, integrators[i], 1, options.seconds, options.seed + 1 + round, needs)
                    .samples_per_second;
            });
        const auto rates = trade::measure_in_rounds(options.rounds, random, measurements);
        std::printf("| %s | %s | %s |", scene.name.c_str(), names[i], rates_text(rates[0]).c_str());
        for (std::size_t j = 1; j < fast::compiled_needs.size(); ++j)
            std::printf(" %s |", to_text(trade::ratio_of_rounds(rates[j], rates[0])).c_str());
        std::printf("\n");
        std::fflush(stdout);
    }
}

} // namespace

int main(int argc, char** argv)
{
    figures::Program program(
        "Prints the tables of docs/results/cuda-bdpt.md on the speed of the fast path on the host",
        "figure_fast_transport");
    figures::SceneFiles files;
    figures::RoundOptions options{.seconds = 0.7, .reference_seconds = 8.0};
    program.add(files);
    program.add(options);
    program.set_footer("Means over the rounds with 95% intervals; quotients with theirs in brackets.\n"
                       "Example: figure_fast_transport scenes/cornell_glass.dae --rounds 10");
    return program.run(argc, argv, [&] {
        const std::vector<scenes::Scene> all = figures::read_scenes(files);
        std::mt19937_64 random(options.seed);
        std::printf("| scene |");
        for (const char* name : names)
            std::printf(" %s: 1000 samples/s | ref | fast / ref | two threads / one | 1/(relMSE s) |",
                        name);
        std::printf(
            " efficiency bdpt / path | more efficient |\n|---|---|---|---|---|---|---|---|---|---|---"
            "|---|---|\n");
        for (const scenes::Scene& scene : all) compare(scene, options, random);
        std::printf(
            "\n| scene | integrator | 1000 samples/s | rate with spheres, mirrors and glass | with all "
            "|\n|---|---|---|---|---|\n");
        for (const scenes::Scene& scene : all) measure_needs(scene, options, random);
    });
}
