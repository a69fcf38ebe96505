#pragma once

// The JSON and the warnings of `plumbline render`.

#include "cli/render_command.h"
#include "cuda/transport/needs.h"
#include "images/dropped.h"
#include "images/film.h"
#include "scenes/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace cli {

/// The mean of the whole picture over the batches of a run, with its standard error. A film's standard
/// errors per pixel do not give it, as splats of light walks make pixels depend on each other.
class PictureMean {
public:
    /// Adds the mean per pixel of one batch. All batches have as many samples and are independent.
    void add_batch(const images::Image& batch);

    /// Standard error, per channel, of the mean of a picture of `batches` batches. Batches of an
    /// earlier run are assumed to have the variance of those added here. None if fewer than two were
    /// added.
    [[nodiscard]] std::optional<images::Rgb> standard_error(std::uint64_t batches) const;

private:
    images::Film film_{1, 1}; // a picture of one pixel, the mean of all
};

/// The mean over all pixels.
images::Rgb mean_of(const images::Image& image);

/// The results of a run of `plumbline render`.
struct RenderRun {
    const scenes::Scene& scene;
    const images::Film& film;
    const PictureMean& mean;
    const images::Dropped& dropped;
    std::optional<fast::Needs> kernel; // of the fast path; none for the reference
    std::string builder;               // of the tree
    double samples;                    // of all pixels together, in this run
    double seconds;
    double cpu_seconds;
    double build_seconds; // before `seconds`: until the renderer could begin, with its trees
    double build_cpu_seconds;
};

/// Whether every pixel is 0 as a float although the scene has an emitter.
bool is_unexpectedly_black(const scenes::Scene& scene, const images::Image& picture);

/// Warnings, a line each: contributions that were left out, and a picture that is black although the
/// scene has emitters.
std::vector<std::string> warnings(const RenderRun& run);

/// One JSON object in one line, without a line break at its end. Numbers that are not finite are null.
std::string render_json(const RenderCommand& options, const RenderRun& run);

} // namespace cli
