#pragma once

// Is this picture right? A candidate is judged against a golden, with a known chance of a false alarm,
// and says what it could have seen. docs/comparison.md explains each step.

#include "golden/compare_options.h"
#include "golden/finding.h"
#include "golden/functionals.h"
#include "golden/golden.h"
#include "golden/method.h"
#include "golden/odd_pixels.h"
#include "images/film.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace golden {

enum class Verdict { pass, fail, inconclusive };
std::string describe(Verdict verdict); // "PASS", "FAIL", "INCONCLUSIVE"

/// The batches of one stage of a candidate, seen through a golden's functionals, which must outlive it.
class Candidate {
public:
    explicit Candidate(const Functionals& functionals);

    /// Adds one batch: for Method::ranks the mean of as many samples as the golden's batches are, else
    /// one of several independent pictures, each equally good. Throws std::invalid_argument if its size
    /// differs from the golden's or a pixel is NaN or infinite; the message names no file.
    void add_batch(const images::Image& batch);

    [[nodiscard]] std::uint64_t batches() const { return film_.batches(); }
    [[nodiscard]] const images::Film& film() const { return film_; }
    [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }
    [[nodiscard]] const Functionals& functionals() const { return *functionals_; }

private:
    const Functionals* functionals_;
    images::Film film_;
    std::vector<Row> rows_;
};

/// One stage, and what it said about the suspicion: the finding with the smallest adjusted p-value.
struct Stage {
    std::uint64_t batches;
    double p;     // first stage: the smallest adjusted p; later: one-sided, of that functional alone
    double level; // the suspicion stands if p < level
};

/// How much it would take for an error of the specified size to be detectable: so many batches of the
/// candidate (pictures, with Method::welch) with the golden as it is; or a golden of so many batches,
/// its pilot included. The first is infinite if the golden's own noise hides such an error.
struct Shortfall {
    double candidate;
    double golden;
};

struct Comparison {
    Verdict verdict = Verdict::inconclusive;
    std::string reason; // one or two sentences
    Method method = Method::ranks;
    double p = 1.0; // the smallest adjusted p of the first stage
    std::vector<Finding> findings;
    std::optional<std::size_t> suspicion; // of `findings`: the smallest p, whether it stands or not
    std::vector<Stage> stages;
    /// Smallest detectable relative error of the whole picture, per channel, at the first stage; NaN for
    /// a channel in which the golden is black.
    std::array<double, 3> detectable{};
    /// The same for a candidate without noise: smaller errors are hidden by the golden's own noise.
    std::array<double, 3> golden_limit{};
    std::optional<Shortfall> shortfall; // if `detectable` is larger than the specification asks for
    std::vector<OddPixels> odd;         // of the candidate's pixels: named before all statistics
    /// The stratum in which the smallest detectable error is largest: the finding that would show it, if
    /// any would.
    std::optional<std::size_t> blindest_stratum;
    double false_alarm = 0.0; // at most this chance has a right picture to FAIL
    double coverage = 1.0;    // share of the findings that are conclusive
    /// Method::picture: the variance of the picture's own noise over the one assumed, in the whole
    /// picture but its odd pixels, in the channel where it is largest; and the standard error of this
    /// ratio.
    std::optional<double> noise_ratio, noise_error;
    std::uint64_t golden_batches = 0; // those that the candidate was compared with
    double candidate_batches = 0.0;   // of its first stage; pictures, with Method::welch
    double batch_size = 0.0;          // samples per pixel in a batch of the golden; 0 if it does not say
};

/// The finding of the whole picture in this channel, plainly weighed: its ratio is that of the means.
const Finding& whole_picture(const Comparison& comparison, std::size_t channel);

/// The fine tiles' z in one channel, matched weights: row by row, `columns` a row; NaN if inconclusive.
struct TileMap {
    int columns = 0, rows = 0;
    std::vector<double> z;
};
TileMap tile_map(const Comparison& comparison, std::size_t channel);

/// Throws std::invalid_argument if the two cannot be compared by this method: different scene hashes,
/// for Method::ranks different batch sizes, integrators' parameters, or the golden's own seed. What a
/// candidate does not say about itself is not checked.
void check_comparable(const Golden& golden, const images::Metadata& candidate, Method method);

/// Judges by what there is: one stage. A suspicion that no further stage can confirm or clear makes
/// INCONCLUSIVE, unless it is beyond doubt. Method::ranks or Method::welch; the latter needs two batches
/// at least and throws std::invalid_argument for fewer.
Comparison compare(const Golden& golden, const Candidate& candidate, Method method,
                   const CompareOptions& options = {});

/// What a candidate of so many batches of the golden's own kind would let see: the smallest relative
/// error of the whole picture, per channel, as Comparison::detectable; NaN for a channel that is black.
std::array<double, 3> detectable_error(const Golden& golden, std::uint64_t batches,
                                       const CompareOptions& options = {});

/// Renders `batches` batches into an empty candidate, with random numbers that no other stage used.
using RenderStage = std::function<void(std::size_t stage, std::uint64_t batches, Candidate& candidate)>;

/// Judges in stages: a suspicion of the first is tested again on fresh renders, and it takes all of them
/// to fail.
Comparison compare(const Golden& golden, const RenderStage& render, Method method,
                   const CompareOptions& options = {});

/// Judges several independent pictures, each equally good, of an unknown estimator, by Method::welch as
/// above. If what rules the result are a few pixels far brighter than the golden's, it says what the
/// verdict would be without them. Throws as Candidate::add_batch and compare.
Comparison compare_pictures(const Golden& golden, std::span<const images::Image> pictures,
                            const CompareOptions& options = {});

/// Judges a single picture, said to be the mean of `samples` samples per pixel. Its noise is taken to be
/// that of the golden's estimator, or what it shows between neighbouring pixels beyond the golden's own
/// noise, whichever is larger: see noise_ratio. Pixels far brighter than the golden's are treated as by
/// compare_pictures. The golden's metadata must have a batch_size. Throws std::invalid_argument as
/// Candidate::add_batch, for samples that are not positive, and for a picture that has the golden's own
/// noise, as a copy of it has.
Comparison compare_picture(const Golden& golden, const images::Image& picture, double samples,
                           const CompareOptions& options = {});

} // namespace golden
