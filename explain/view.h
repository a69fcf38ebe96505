#pragma once

// Views of a scene on a plane: how points of space become points of a panel of a drawing.

#include "ref/transport/world.h"

#include <glm/vec2.hpp>

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace explain {

using ref::Vec3;
using Line = std::pair<glm::dvec2, glm::dvec2>;

/// A panel of `width` x `height` pixels.
struct View {
    std::string title;
    double width, height;
    /// Where the panel shows the segment between two points; none if it lies behind the camera.
    std::function<std::optional<Line>(Vec3, Vec3)> line;
    /// The outline of a ball, as a closed polygon; empty if it is behind the camera or around it.
    std::function<std::vector<glm::dvec2>(const Vec3& center, double radius)> outline;
};

/// What the camera sees, at the aspect ratio of its picture.
View camera_view(const ref::World& world, double height);

/// The scene, its eye and `points` in parallel projection: from above for the axis nearest to the
/// camera's `up`, and from the side for that nearest to its `right`.
std::vector<View> parallel_views(const ref::World& world, const std::vector<Vec3>& points,
                                 double height);

} // namespace explain
