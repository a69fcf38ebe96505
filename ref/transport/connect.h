#pragma once

// The four families of strategies that join s vertices of a light walk and t vertices of an eye walk
// into a path. Each function returns the contribution of the path to the picture, both unweighted and
// weighted, or nullopt.
//
//   family            (s, t)           2015 report     Lafortune & Willems 1993
//   emission_hit      s = 0,  t >= 2   Case I (k = 1)  the eye walk hits a light source
//   next_event        s = 1,  t >= 2   Case II         direct light at an eye vertex
//   light_image       s >= 1, t = 1    Case III        a light vertex seen from the eye
//   inner_connection  s >= 2, t >= 2   Case IV         a light vertex seen from an eye vertex

#include "ref/transport/mis_weight.h"
#include "ref/transport/vertex.h"
#include "ref/transport/visibility.h"

#include <optional>
#include <span>

namespace ref {

/// x_0 ... x_k: the light walk, then the eye walk backwards.
Path join(std::span<const Vertex> y, std::span<const Vertex> z);

/// The vertex y_0 of a next event: where `light` leaves its emitter.
Vertex light_vertex(const World& world, const IncidentLight& light);

/// What has to be free between the eye and another vertex, on a surface or at infinity.
LineOfSight line_to_eye(const World& world, const Vertex& vertex);

/// s = 0: the eye walk z_0 ... z_{t-1} ends on an emitter.
std::optional<Contribution> emission_hit(const World& world, const PathOptions& options,
                                         const SampleId& id, std::span<const Vertex> z);

/// s = 1: z_{t-1} is joined to a fresh point of an emitter.
std::optional<Contribution> next_event(const World& world, const PathOptions& options,
                                       const SampleId& id, std::span<const Vertex> z);

/// t = 1: y_{s-1} is joined to the pinhole z_0. The contribution goes to the pixel that sees y_{s-1}.
std::optional<Contribution> light_image(const World& world, const PathOptions& options,
                                        std::span<const Vertex> y, const Vertex& eye);

/// s, t >= 2: y_{s-1} is joined to z_{t-1}.
std::optional<Contribution> inner_connection(const World& world, const PathOptions& options,
                                             const SampleId& id, std::span<const Vertex> y,
                                             std::span<const Vertex> z);

} // namespace ref
