#include "cli/candidate.h"

#include "cli/fast_render.h"
#include "cli/golden.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cuda/transport/renderer.h"
#include "golden/file_ending.h"
#include "golden/image_error.h"
#include "golden/pfm.h"

#include <charconv>
#include <filesystem>
#include <random>
#include <stdexcept>
#include <utility>

namespace cli {

namespace fs = std::filesystem;

namespace {

golden::ExrPicture read_picture(const fs::path& path)
{
    golden::ExrPicture picture;
    if (golden::has_ending(path, ".exr"))
        picture = golden::read_exr(path);
    else if (golden::has_ending(path, ".pfm"))
        picture.mean = golden::read_pfm(path);
    else
        throw golden::ImageError(path, "is no .exr, .pfm or .dae");
    if (const auto pixel = golden::first_non_finite(picture.mean))
        throw golden::ImageError(path, "pixel (" + std::to_string(pixel->x) + ", " +
                                           std::to_string(pixel->y) + ") is no finite number");
    return picture;
}

void expect_size(const fs::path& path, const golden::Image& image, const golden::Golden& golden)
{
    if (image.width != golden.mean.width || image.height != golden.mean.height)
        throw golden::ImageError(path, "has " + std::to_string(image.width) + "x" +
                                           std::to_string(image.height) + " pixels, the golden " +
                                           std::to_string(golden.mean.width) + "x" +
                                           std::to_string(golden.mean.height));
}

/// Whether batches of the two are distributed alike if both are right.
bool same_estimator(const golden::Metadata& a, const golden::Metadata& b)
{
    for (const char* key : {"integrator", "heuristic", "batch_size", "max_edges", "roulette"})
        if (value_of(a, key).empty() || value_of(a, key) != value_of(b, key)) return false;
    return true;
}

Judged judge_scene(const golden::Golden& golden, const std::string& file,
                   const CandidateOptions& options)
{
    RenderCommand command = render_of(golden, file);
    if (!options.integrator.empty()) command.integrator = options.integrator;
    command.threads = options.threads;
    command.device = options.device;
    const std::uint64_t seed = options.seed.value_or(std::random_device()());
    const scenes::Scene scene = load_scene(file, command.frame, options.quiet);
    command.seed = seed;
    golden::Metadata metadata = describe(command, scene);
    const golden::Method method =
        same_estimator(metadata, golden.metadata) ? golden::Method::ranks : golden::Method::welch;
    golden::check_comparable(golden, metadata, method);
    const Size size = parse_size(command.size);
    std::optional<ref::World> world;
    if (command.device == "ref") world.emplace(scene, size.width, size.height);
    golden::Image mean;
    const auto render = [&](std::size_t stage, std::uint64_t batches, golden::Candidate& candidate) {
        command.seed = seed + stage;
        command.samples = batches * command.batch_size;
        Progress progress(scene.name + ", stage " + std::to_string(stage + 1), 0.0,
                          static_cast<double>(batches), options.quiet);
        const ref::Monitor monitor{[&](double done) { progress.update(done); }, interrupt_requested};
        const auto fast = world ? nullptr : fast_renderer(command, scene);
        for (std::uint64_t i = 0; i < batches; ++i) {
            const auto batch = fast ? render_batch(*fast, command, i, monitor)
                                    : ref::render_batch(*world, integrator_of(command),
                                                        render_options(command), i, monitor);
            if (!batch) throw Interrupted();
            candidate.add_batch(*batch);
        }
        mean = candidate.film().mean();
        metadata["samples"] = std::to_string(command.samples);
    };
    golden::Comparison comparison = golden::compare(golden, render, method);
    return {std::move(comparison), std::move(mean), std::move(metadata), {}};
}

Judged judge_batches(const golden::Golden& golden, const std::vector<golden::Image>& batches,
                     golden::Method method, golden::ExrPicture first)
{
    golden::Candidate candidate(golden.functionals);
    for (const golden::Image& batch : batches) candidate.add_batch(batch);
    golden::Comparison comparison = golden::compare(golden, candidate, method);
    return {std::move(comparison), candidate.film().mean(), std::move(first.metadata),
            std::move(first.layers)};
}

double samples_of(const std::string& file, const golden::Metadata& metadata,
                  const CandidateOptions& options)
{
    if (options.samples) return *options.samples;
    const std::string text = value_of(metadata, "samples");
    double samples = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), samples);
    if (error != std::errc() || rest != text.data() + text.size())
        throw std::invalid_argument(file + ": does not say its number of samples per pixel: give -s");
    return samples;
}

} // namespace

Judged judge(const golden::Golden& golden, const std::vector<std::string>& files,
             const CandidateOptions& options)
{
    const bool scene = golden::has_ending(files.front(), ".dae");
    if (!scene && (!options.integrator.empty() || options.seed || options.device != "ref"))
        throw std::invalid_argument(
            "--integrator, --device and --seed are for a scene that is rendered here");
    if (scene && files.size() > 1) throw std::invalid_argument(files[1] + ": a scene is judged alone");
    if (options.samples && (scene || files.size() > 1))
        throw std::invalid_argument("--samples is for a single picture");
    if (scene) return judge_scene(golden, files.front(), options);

    golden::ExrPicture first = read_picture(files.front());
    expect_size(files.front(), first.mean, golden);
    std::vector<golden::Image> batches;
    if (files.size() > 1) { // independent pictures
        golden::check_comparable(golden, first.metadata, golden::Method::welch);
        batches.push_back(first.mean);
        for (std::size_t i = 1; i < files.size(); ++i) {
            golden::ExrPicture picture = read_picture(files[i]);
            expect_size(files[i], picture.mean, golden);
            golden::check_comparable(golden, picture.metadata, golden::Method::welch);
            batches.push_back(std::move(picture.mean));
        }
        return judge_batches(golden, batches, golden::Method::welch, std::move(first));
    }
    for (const auto& [name, layer] : first.layers)
        if (name.starts_with("batch.")) batches.push_back(layer);
    if (batches.size() > 1) {
        const golden::Method method = same_estimator(first.metadata, golden.metadata)
                                          ? golden::Method::ranks
                                          : golden::Method::welch;
        golden::check_comparable(golden, first.metadata, method);
        return judge_batches(golden, batches, method, std::move(first));
    }
    golden::check_comparable(golden, first.metadata, golden::Method::picture);
    const double samples = samples_of(files.front(), first.metadata, options);
    golden::Comparison comparison = golden::compare_picture(golden, first.mean, samples);
    return {std::move(comparison), std::move(first.mean), std::move(first.metadata),
            std::move(first.layers)};
}

} // namespace cli
