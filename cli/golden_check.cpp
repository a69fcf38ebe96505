#include "cli/golden_check.h"

#include "cli/golden_mismatch.h"
#include "cli/golden_render.h"
#include "cli/interrupt.h"
#include "cli/renderer_for.h"
#include "cli/scene_input.h"
#include "golden/compare.h"
#include "scenes/read_scene.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <random>
#include <vector>

namespace cli {

namespace fs = std::filesystem;

namespace {

/// `count` different numbers below `total`, ascending, drawn anew in every run, so that all batches are
/// checked over time.
std::vector<std::uint64_t> draw(std::uint64_t count, std::uint64_t total)
{
    std::vector<std::uint64_t> all(total);
    std::iota(all.begin(), all.end(), 0);
    std::vector<std::uint64_t> drawn;
    std::sample(all.begin(), all.end(), std::back_inserter(drawn), count,
                std::mt19937_64(std::random_device()()));
    return drawn;
}

enum class Outcome { same, different, interrupted };

Outcome verify(const GoldenCommand& options, const std::string& file)
{
    const fs::path path = golden_file(options, file);
    const golden::Golden stored = golden::read_golden(path);
    expect_made_so(options, Ask::given_options, {path, stored.mean, stored.metadata, true}, {});
    RenderCommand command = render_of(stored, file);
    command.threads = options.threads;
    const scenes::Scene scene = load_scene(file, command.frame, true);
    golden::check_comparable(stored, {{"scene_hash", scene.hash}}, golden::Method::picture);

    const Size size = parse_size(command.size);
    const auto renderer = renderer_for(command, scene);
    const std::uint64_t reference = stored.reference.size();
    const std::uint64_t total = command.samples / command.batch_size;
    const std::uint64_t pilot = total - reference;
    const bool everything = options.verify >= total;
    images::Film film(size.width, size.height);
    // A batch of the pilot enters only the mean, which can be compared only if all are rendered.
    std::vector<std::uint64_t> chosen = draw(std::min(options.verify, reference), reference);
    for (std::uint64_t& batch : chosen) batch += pilot;
    if (everything) {
        chosen.resize(total);
        std::iota(chosen.begin(), chosen.end(), 0);
    }
    for (const std::uint64_t number : chosen) {
        const auto batch = renderer->render_batch(number, {{}, interrupt_requested});
        if (!batch) return Outcome::interrupted;
        if (number >= pilot &&
            stored.functionals.evaluate(batch->mean) != stored.reference[number - pilot]) {
            std::printf("%s: batch %llu is another one now\n", scene.name.c_str(),
                        static_cast<unsigned long long>(number));
            return Outcome::different;
        }
        if (everything) film.add_batch(batch->mean);
    }
    if (everything) {
        const images::Image mean = film.mean();
        for (std::size_t i = 0; i < mean.pixels.size(); ++i)
            for (int c = 0; c < 3; ++c)
                if (static_cast<float>(mean.pixels[i][c]) !=
                    static_cast<float>(stored.mean.pixels[i][c])) {
                    std::printf("%s: the mean of pixel %zu is another one now\n", scene.name.c_str(), i);
                    return Outcome::different;
                }
    }
    std::printf("%s: %zu of %llu batches are the same, bit for bit%s\n", scene.name.c_str(),
                chosen.size(), static_cast<unsigned long long>(total),
                everything ? ", and so is the mean" : "");
    return Outcome::same;
}

/// Relative standard error of the picture's mean, all channels together.
double relative_error(const golden::Golden& golden)
{
    double sum = 0.0;
    double variance = 0.0;
    for (std::size_t i = 0; i < golden.mean.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            sum += golden.mean.pixels[i][c];
            variance += golden.standard_error.pixels[i][c] * golden.standard_error.pixels[i][c];
        }
    return sum > 0.0 ? std::sqrt(variance) / sum : 0.0;
}

std::string days_since(const fs::path& file)
{
    const auto age = fs::file_time_type::clock::now() - fs::last_write_time(file);
    return std::to_string(std::chrono::duration_cast<std::chrono::hours>(age).count() / 24) + " d";
}

} // namespace

ExitStatus verify_goldens(const GoldenCommand& options)
{
    bool all_same = true;
    for (const std::string& scene : options.scenes) {
        const Outcome outcome = verify(options, scene);
        std::fflush(stdout);
        if (outcome == Outcome::interrupted) return interrupted;
        all_same = all_same && outcome == Outcome::same;
    }
    return all_same ? fine : check_failed;
}

ExitStatus list_goldens(const GoldenCommand& options)
{
    std::printf("%-26s %9s %8s %9s %12s %8s %9s  %s\n", "scene", "size", "samples", "std.error",
                "detectable", "MiB", "scene age", "");
    for (const std::string& file : options.scenes) {
        const fs::path path = golden_file(options, file);
        const scenes::Scene scene = scenes::read_scene(file);
        if (!fs::exists(path)) {
            std::printf("%-26s no golden\n", scene.name.c_str());
            continue;
        }
        const golden::Golden stored = golden::read_golden(path);
        expect_made_so(options, Ask::given_options, {path, stored.mean, stored.metadata, true}, {});
        const RenderCommand command = render_of(stored, file);
        const auto detectable =
            golden::detectable_error(stored, golden::CompareOptions{}.stages.front());
        const std::string same = stored.metadata.at("scene_hash") == scene.hash
                                     ? ""
                                     : "the scene has changed since: make it anew";
        std::printf("%-26s %9s %8llu %8.3f%% %11.2f%% %8.2f %9s  %s\n", scene.name.c_str(),
                    command.size.c_str(), static_cast<unsigned long long>(command.samples),
                    100.0 * relative_error(stored),
                    100.0 * *std::max_element(detectable.begin(), detectable.end()),
                    static_cast<double>(fs::file_size(path)) / (1 << 20), days_since(file).c_str(),
                    same.c_str());
    }
    return fine;
}

} // namespace cli
