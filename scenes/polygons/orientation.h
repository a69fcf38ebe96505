#pragma once

// On which side of a line does a point lie? The answer is exact, so that the pieces of a cut fit.

#include <glm/vec2.hpp>

namespace scenes::polygons {

using Point = glm::dvec2;

/// The sign of twice the signed area of the triangle a, b, c: 1 if c lies on the left of the line from a
/// to b, -1 if on the right, 0 if the three are collinear or coincide. Exact for coordinates that are 0
/// or whose magnitude is between 2^-400 and 2^400: no product of two then leaves the range of a double.
int orientation(const Point& a, const Point& b, const Point& c);

/// Whether b, collinear with a and c, lies on the segment between them and differs from both.
bool is_between(const Point& a, const Point& b, const Point& c);

/// Whether the direction from `at` to `target` points strictly into the wedge that begins at the
/// direction to `next` and ends, turning left, at the direction to `previous`: the inside of a
/// counter-clockwise polygon at its corner `at`. The three must differ from `at`.
bool is_in_wedge(const Point& previous, const Point& at, const Point& next, const Point& target);

} // namespace scenes::polygons
