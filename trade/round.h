#pragma once

// One measurement: one configuration renders a fixed number of batches once.

#include "golden/statistics.h"
#include "images/renderer.h"
#include "trade/truth.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace trade {

/// Durations in seconds: by the clock on the wall, and of all threads of the process.
struct Seconds {
    double wall = 0.0;
    double cpu = 0.0;
};

/// The time so far. Tests bring a clock of their own.
using Clock = std::function<Seconds()>;

/// The time of this process.
Seconds process_clock();

/// Makes the renderer of a configuration ready, with this number of samples per pixel in a batch.
using MakeRenderer =
    std::function<std::unique_ptr<images::Renderer>(std::uint32_t batch_size, std::uint64_t seed)>;

/// The samples of a measurement. They are fixed before it begins: if it ended when its time is up, long
/// batches would be cut off more often than short ones, and these may differ in brightness.
struct Plan {
    std::uint32_t batch_size = 1; // samples per pixel
    std::uint64_t batches = 0;
};

constexpr std::uint64_t fewest_batches = 4;
constexpr std::uint64_t most_batches = 32; // about: enough for the statistics of a round

/// A plan that takes about `seconds` on the wall, found by rendering for about a quarter of that time,
/// and at least two samples per pixel.
/// It has fewest_batches at least, even where they take longer. None if `stop` returned true.
std::optional<Plan> plan_for(double seconds, const MakeRenderer& make, std::uint64_t seed,
                             const Clock& clock, const std::function<bool()>& stop);

/// The results of one measurement.
struct Round {
    Seconds build;  // to make the renderer ready
    Seconds render; // all batches
    Plan plan;
    std::vector<golden::Moments> brightness; // over the batches, by Truth::regions()
    /// Over the batches: the relMSE of one sample per pixel by noise alone.
    golden::Moments noise;
    /// The part of the relMSE that does not come from noise, neither of the picture nor of the truth:
    /// the mean over pixels and channels of the squared relative bias. An unbiased estimate, which may
    /// be negative.
    double bias_squared = 0.0;

    /// Samples per pixel.
    [[nodiscard]] double samples() const { return static_cast<double>(plan.batches) * plan.batch_size; }
};

struct MeasuredRound {
    Round round;
    images::Image picture; // the mean of all batches
};

/// Measures a configuration. Only building and rendering are timed. None if `stop` returned true.
/// Throws the errors of the renderer, and std::runtime_error for contributions that are not finite.
std::optional<MeasuredRound> measure(const MakeRenderer& make, const Plan& plan, std::uint64_t seed,
                                     const Truth& truth, const Clock& clock,
                                     const std::function<bool()>& stop);

} // namespace trade
