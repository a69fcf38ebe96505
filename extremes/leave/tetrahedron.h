#pragma once

// A closed room of four triangles: the ordinary case of leaving a surface.

#include "extremes/leave/bound.h"
#include "extremes/leave/leave_case.h"
#include "extremes/leave/shapes.h"

#include <functional>

namespace extremes {

/// A regular tetrahedron in the unit sphere, turned at random, its corners moved by up to 0.15 along
/// each axis; then every corner is replaced by place(corner). Rays from inside meet a face, and the
/// light goes on to another face. `size`: of the error. All rays keep a weight of 0.1 off the edges, and
/// cosines of at least least_cosine to the normals of both faces, unless place() rounds the corners
/// away.
LeaveCase tetrahedron_case(Random& random, int rays, double size,
                           const std::function<scenes::Vec3(const scenes::Vec3&)>& place);

constexpr double least_cosine = 0.3;
constexpr double tetrahedron_extent = 2.3;  // largest extent along an axis: 2 + 2 * 0.15
constexpr double tetrahedron_radius = 1.15; // largest coordinate

/// bound_of_leaving for this room, in multiples of its radius. `farthest`: the largest coordinate at
/// which an implementation has placed it.
double bound_in_tetrahedron(Format format, double farthest);

} // namespace extremes
