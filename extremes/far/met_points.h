#pragma once

// What rays from the eye of a scene meet, on each wing.

#include "extremes/wing.h"

#include "scenes/scene.h"

#include <functional>
#include <optional>
#include <vector>

namespace extremes {

/// The points that rays meet; none where a ray meets nothing.
using MetPoints = std::vector<std::optional<scenes::Vec3>>;

/// Computes what the rays from the eye in the unit directions `towards` meet.
using EyeTracer =
    std::function<MetPoints(const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards)>;

MetPoints met_by(Wing wing, const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards);

/// The fast path on the host, but the origin of each ray is moved along it to the scene, in double,
/// before it is rounded.
MetPoints met_from_nearby(const scenes::Scene& scene, const std::vector<scenes::Vec3>& towards);

} // namespace extremes
