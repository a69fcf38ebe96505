#pragma once

// Measures a tree builder of the reference: the time of a build, and what rays through its tree cost.

#include "cli/builders.h"
#include "cli/scene_input.h"
#include "ref/trees/quality.h"
#include "scenes/scene.h"

#include <cstddef>
#include <optional>
#include <string>

namespace cli {

/// Rays of one kind, on average. All zero without rays.
struct RayCost {
    double mrays_per_s = 0;                          // millions of rays per second of CPU time
    std::optional<double> relative_standard_error{}; // of mrays_per_s; none without rays
    double nodes_per_ray = 0;                        // visited
    double primitives_per_ray = 0;                   // tested
};

/// One builder, measured on one scene.
struct MeasuredBuilder {
    std::string name;
    double build_ms; // CPU time, the median of all builds
    ref::Quality quality;
    std::size_t nodes;
    RayCost camera;  // a ray through the middle of each pixel
    RayCost diffuse; // from where such a ray hits, in a cosine-distributed direction
};

/// Builds the tree `repeats` times, and traces camera and diffuse rays for a picture of this size. Rays
/// of each kind are traced until the mean time is known to 2% (standard error of the mean of at least
/// five repetitions) or a second has passed. The scene must have a camera. CPU time, one thread.
MeasuredBuilder measure_builder(const scenes::Scene& scene, const NamedBuilder& named, const Size& size,
                                int repeats);

} // namespace cli
