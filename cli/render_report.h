#pragma once

// What `plumbline render --json` says.

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
/// errors cannot be added up to that: what light walks splat makes pixels vary together.
class PictureMean {
public:
    /// Adds the mean per pixel of one batch. All batches have as many samples and are independent.
    void add_batch(const images::Image& batch);

    /// Standard error, per channel, of the mean of a picture of `batches` batches. If an earlier run
    /// rendered some of them, they are taken to scatter as those do that were added here. None if fewer
    /// than two were added: one batch says nothing of how they scatter.
    [[nodiscard]] std::optional<images::Rgb> standard_error(std::uint64_t batches) const;

private:
    images::Film film_{1, 1}; // a picture of one pixel, the mean of all
};

/// The mean over all pixels.
images::Rgb mean_of(const images::Image& image);

/// What a run of `plumbline render` did.
struct RenderRun {
    const scenes::Scene& scene;
    const images::Film& film;
    const PictureMean& mean;
    const images::Dropped& dropped;
    std::optional<gpu::Needs> kernel; // of the fast path; none for the reference
    double samples;                   // of all pixels together, in this run
    double seconds;
    double cpu_seconds;
};

/// Whether every pixel is 0 as a float, though something in the scene shines.
bool is_unexpectedly_black(const scenes::Scene& scene, const images::Image& picture);

/// What a person must know to trust the picture, a line each: contributions that were left out, and a
/// picture that is black though the scene has emitters.
std::vector<std::string> warnings(const RenderRun& run);

/// One JSON object in one line, without a line break at its end. Numbers that are not finite are null.
std::string render_json(const RenderCommand& options, const RenderRun& run);

} // namespace cli
