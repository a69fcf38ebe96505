#include "cli/compare_candidate.h"

#include "cli/compare_scene.h"
#include "cli/compare_transport.h"
#include "cli/render_metadata.h"
#include "golden/compare.h"
#include "golden/diagnosis.h"
#include "golden/independence.h"
#include "golden/reason.h"
#include "images/file_ending.h"
#include "images/image_error.h"
#include "images/non_finite.h"
#include "images/pfm.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace cli {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view batch_prefix = "batch."; // of the layers that render --keep-batches writes

images::ExrPicture read_picture(const fs::path& path, const CompareCommand& options)
{
    images::ExrPicture picture;
    const std::string& layer = options.layer;
    if (images::has_ending(path, ".exr"))
        picture = images::read_exr(path, layer);
    else if (images::has_ending(path, ".pfm") && !layer.empty())
        throw images::ImageError(path, "has no layers (--layer " + layer + ")");
    else if (images::has_ending(path, ".pfm"))
        picture.mean = images::read_pfm(path);
    else
        throw images::ImageError(path, "is no .exr, .pfm or .dae");
    if (const auto fault = images::say_non_finite(picture.mean)) throw images::ImageError(path, *fault);
    if (picture.layer != layer && !picture.layer.empty() && !options.quiet)
        std::cerr << path.string() << ": its layer " << picture.layer << " is compared\n";
    return picture;
}

void expect_size(const fs::path& path, const images::Image& image, const golden::Golden& golden)
{
    if (image.width != golden.mean.width || image.height != golden.mean.height)
        throw images::ImageError(path, "has " + std::to_string(image.width) + "x" +
                                           std::to_string(image.height) + " pixels, the golden " +
                                           std::to_string(golden.mean.width) + "x" +
                                           std::to_string(golden.mean.height));
}

/// A number of samples per pixel in the metadata; 0 if there is none.
double samples_in(const images::Metadata& metadata, const char* key)
{
    const std::string text = value_of(metadata, key);
    double samples = 0.0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), samples);
    return error == std::errc() && rest == text.data() + text.size() ? samples : 0.0;
}

double samples_of(const std::string& file, const images::Metadata& metadata,
                  const CompareCommand& options)
{
    if (options.samples) return *options.samples;
    const double samples = samples_in(metadata, "samples");
    if (samples == 0.0)
        throw std::invalid_argument(file + ": does not say its number of samples per pixel: give -s");
    return samples;
}

/// golden::check_comparable, with an error that names the file.
void check_file(const golden::Golden& golden, const std::string& file, const images::Metadata& metadata,
                golden::Method method)
{
    try {
        golden::check_comparable(golden, metadata, method);
    } catch (const std::invalid_argument& error) {
        throw images::ImageError(file, error.what());
    }
}

/// Throws if two of the pictures, which are called `names`, share their noise.
void expect_independent_pictures(const golden::Golden& golden,
                                 const std::vector<images::Image>& pictures,
                                 const std::vector<std::string>& names)
{
    if (const auto shared = golden::shared_noise(golden, pictures))
        throw std::invalid_argument(names[shared->first] + " and " + names[shared->second] + " " +
                                    shared->why +
                                    ": they are not independent. Does the renderer ignore "
                                    "its seed? Give one of them, and its samples by -s");
}

/// The batches of one file, as layers.
JudgedCandidate judge_batches(const golden::Golden& golden, const std::string& file,
                              images::ExrPicture picture)
{
    golden::Candidate candidate(golden.functionals);
    std::vector<images::Image> batches;
    std::vector<std::string> names;
    for (const auto& [name, layer] : picture.layers) {
        if (!name.starts_with(batch_prefix)) continue;
        if (const auto fault = images::say_non_finite(layer))
            throw images::ImageError(file, "layer " + name + ": " + *fault);
        batches.push_back(layer);
        names.push_back(names.empty() ? file + ": layers " + name : name);
        candidate.add_batch(layer);
    }
    const golden::Method method = same_estimator(picture.metadata, golden.metadata)
                                      ? golden::Method::ranks
                                      : golden::Method::welch;
    check_file(golden, file, picture.metadata, method);
    expect_independent_pictures(golden, batches, names);
    golden::Comparison comparison =
        method == golden::Method::ranks
            ? golden::compare(golden, candidate, method)
            : golden::compare_pictures(golden, batches,
                                       {.picture_samples = samples_in(picture.metadata, "batch_size")});
    return {std::move(comparison), candidate.mean(), std::move(picture.metadata),
            std::move(picture.layers)};
}

/// Several pictures, `first` the first of them.
JudgedCandidate judge_pictures(const golden::Golden& golden, const std::vector<std::string>& files,
                               images::ExrPicture first, const CompareCommand& options)
{
    std::vector<images::Image> pictures = {first.mean};
    const SceneMistakes of_scene = mistakes_of_scene(golden, pictures, 0.0, options);
    std::map<std::string, std::string> seeds; // and the file that has it
    images::Metadata metadata = first.metadata;
    golden::CompareOptions levels;
    for (std::size_t i = 0; i < files.size(); ++i) {
        images::ExrPicture picture = i == 0 ? images::ExrPicture{} : read_picture(files[i], options);
        if (i > 0) {
            expect_size(files[i], picture.mean, golden);
            pictures.push_back(std::move(picture.mean));
            metadata = picture.metadata;
        }
        check_file(golden, files[i], metadata, golden::Method::welch);
        const double samples = options.samples ? *options.samples : samples_in(metadata, "samples");
        levels.picture_samples = i == 0 ? samples : std::min(levels.picture_samples, samples);
        const std::string seed = value_of(metadata, "seed");
        const auto [other, is_new] = seeds.emplace(seed, files[i]);
        if (!is_new && !seed.empty())
            throw std::invalid_argument(other->second + " and " + files[i] + " have the same seed, " +
                                        seed + ": they are not independent");
    }
    expect_independent_pictures(golden, pictures, files);
    const auto compared = [&](const std::vector<images::Image>& of) {
        return golden::compare_pictures(golden, of, levels);
    };
    golden::Comparison comparison = compared(pictures);
    comparison.diagnosis = golden::diagnose(golden, comparison, pictures, levels.picture_samples,
                                            compared, of_scene.explain, of_scene.more);
    const bool may_hide = std::ranges::any_of(
        comparison.findings, [](const golden::Finding& finding) { return finding.hidden > 0.0; });
    if (comparison.verdict == golden::Verdict::inconclusive && may_hide && levels.picture_samples == 0.0)
        comparison.reason +=
            " The files do not say their samples per pixel: give -s, and fewer pictures "
            "may be enough.";
    images::Film film(golden.mean.width, golden.mean.height);
    for (const images::Image& picture : pictures) film.add_batch(picture);
    return {std::move(comparison), film.mean(), std::move(first.metadata), std::move(first.layers)};
}

JudgedCandidate judge_picture(const golden::Golden& golden, const std::string& file,
                              images::ExrPicture picture, const CompareCommand& options)
{
    check_file(golden, file, picture.metadata, golden::Method::picture);
    // The samples that a file states are those of the whole.
    if (options.layer.starts_with(batch_prefix) && !options.samples)
        throw std::invalid_argument(file + ": layer " + options.layer +
                                    " is one batch: give its samples by -s");
    const double samples = samples_of(file, picture.metadata, options);
    const std::vector<images::Image> pictures = {picture.mean};
    const SceneMistakes of_scene = mistakes_of_scene(golden, pictures, samples, options);
    golden::Comparison comparison;
    const auto compared = [&](const std::vector<images::Image>& of) {
        return golden::compare_picture(golden, of.front(), samples);
    };
    try {
        comparison = compared(pictures);
        comparison.diagnosis = golden::diagnose(golden, comparison, pictures, samples, compared,
                                                of_scene.explain, of_scene.more);
    } catch (const std::invalid_argument& error) {
        throw images::ImageError(file, error.what());
    }
    return {std::move(comparison), std::move(picture.mean), std::move(picture.metadata),
            std::move(picture.layers)};
}

} // namespace

JudgedCandidate judge(const golden::Golden& golden, const std::vector<std::string>& files,
                      const CompareCommand& options)
{
    const bool scene = images::has_ending(files.front(), ".dae");
    if (!scene && (!options.integrator.empty() || options.seed || options.device != "ref"))
        throw std::invalid_argument(
            "--integrator, --device and --seed are for a scene that is rendered here");
    if (scene && files.size() > 1) throw std::invalid_argument(files[1] + ": a scene is judged alone");
    if (scene && !options.layer.empty())
        throw std::invalid_argument("--layer " + options.layer + " is for pictures, .exr");
    if (scene && !options.scene.empty())
        throw std::invalid_argument("--scene " + options.scene + " is for pictures, not for a scene");
    if (scene) return judge_scene(golden, files.front(), options);

    images::ExrPicture first = read_picture(files.front(), options);
    expect_size(files.front(), first.mean, golden);
    const auto batches = std::count_if(first.layers.begin(), first.layers.end(), [](const auto& layer) {
        return layer.first.starts_with(batch_prefix);
    });
    JudgedCandidate judged = files.size() > 1 ? judge_pictures(golden, files, std::move(first), options)
                             : batches > 1 && options.layer.empty()
                                 ? judge_batches(golden, files.front(), std::move(first))
                                 : judge_picture(golden, files.front(), std::move(first), options);
    judged.comparison.reason +=
        golden::say_possible_causes(judged.comparison, golden, judged.metadata, judged.mean);
    return judged;
}

} // namespace cli
