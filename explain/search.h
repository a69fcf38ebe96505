#pragma once

// Finds the samples of a picture that are worth an explanation.

#include "explain/condition.h"
#include "images/renderer.h"
#include "ref/transport/world.h"

#include <optional>

namespace explain {

/// A sample, and one of its strategies.
struct Found {
    ref::SampleId id;
    int s, t;
};

/// The samples to search.
struct Range {
    std::uint32_t samples;                   // of each pixel: 0 ... samples - 1
    std::optional<std::uint32_t> pixel = {}; // only this one
};

/// The first sample with a strategy for which the condition holds: samples in the order of their
/// numbers, and among those of one number by pixel. None if there is no such sample. Calls
/// monitor.progress with the samples done; if monitor.stop returns true, `stopped` is set and the result
/// is none.
std::optional<Found> find_first(const ref::World& world, const images::RenderOptions& options,
                                const Range& range, const Condition& condition,
                                const images::Monitor& monitor, bool& stopped);

/// A pixel that is bright by one sample.
struct Firefly {
    std::uint32_t pixel;
    std::uint32_t sample; // the number of the sample; a splat may be of another pixel's sample
    double mean;          // luminance of the pixel, over all samples
    double others;        // over all samples but this number
    Found cause;          // the largest contribution to the pixel among the samples of this number
    double adds;          // luminance of that contribution
};

/// The pixel whose mean is raised most by the samples of one number: the mean over all `samples` minus
/// that over the others is largest (for one sample, the mean itself). Unlike the brightest pixel, it is
/// not one where a lamp is seen in every sample. Renders the picture with `threads`. None for a black
/// picture, and if monitor.stop returned true, which sets `stopped`.
std::optional<Firefly> find_firefly(const ref::World& world, images::RenderOptions options,
                                    std::uint32_t samples, unsigned threads,
                                    const images::Monitor& monitor, bool& stopped);

/// A line that says what was found, before the explanation of the sample.
std::string describe(const Found& found, const std::string& condition);
std::string describe(const Firefly& firefly, int width);

} // namespace explain
