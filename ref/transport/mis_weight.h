#pragma once

// Multiple importance sampling over the strategies of bidirectional path tracing, literally: the density
// of the finished path under every strategy, from the path alone, and the share of one of them
// [Veach 1997, sec. 10.2.1 with the balance and power heuristics of sec. 9.2].

#include "ref/transport/vertex.h"

#include <span>
#include <vector>

namespace ref {

/// A finished path x_0 ... x_k, from the emitter to the eye: x_i = y_i for i < s, the rest is the eye
/// subpath backwards.
using Path = std::vector<const Vertex*>;

/// For every vertex x_i of a path the density with which each walk would make it from the vertices
/// before it on its side: per area on a surface, per solid angle at infinity. The chance that the walk
/// goes on as far is part of it.
struct VertexDensities {
    std::vector<double> light; // p(x_i | x_{i-1}, x_{i-2}): as the light walk makes it
    std::vector<double> eye;   // p(x_i | x_{i+1}, x_{i+2}): as the eye walk makes it
};

VertexDensities vertex_densities(const World& world, const PathOptions& options, const Path& x);

/// Whether the strategy (s, k + 1 - s) can make the path at all: x_{s-1} and x_s can be joined, or, for
/// s = 0, x_0 can be run into.
bool is_possible(const World& world, const Path& x, std::size_t s);

/// The densities p_s of the path under the strategies s = 0 ... k with t = k + 1 - s >= 1: 0 where the
/// strategy is not possible. In long double for its range alone: a path has many factors.
std::vector<long double> strategy_densities(const World& world, const PathOptions& options,
                                            const Path& x);

/// The share of strategy s in the path, 0 ... 1: exactly 0 where it is not possible. Over all strategies
/// they add up to 1.
double mis_weight(const World& world, const PathOptions& options, const Path& x, std::size_t s);

} // namespace ref
