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

/// p_i / p_s for i = 0 ... k: how much denser than strategy s every strategy i makes the path; 0 where i
/// cannot. `p` are the path's densities; none of those that make up p_s may be 0. p_i is the product of
/// p.light over x_0 ... x_{i-1} and of p.eye over x_i ... x_k; the quotient of two neighbours has two
/// factors that differ, p_{i+1} / p_i = p.light[i] / p.eye[i] [Veach 1997, eq. 10.9]. So no product has
/// more factors than the strategies lie apart: those of a long path, in the unit of length of any scene,
/// would leave the range of doubles.
std::vector<double> density_quotients(const World& world, const Path& x, const VertexDensities& p,
                                      std::size_t s);

/// The share of strategy s in the path, 0 ... 1: exactly 0 where it is not possible. Over all strategies
/// they add up to 1.
double mis_weight(const World& world, const PathOptions& options, const Path& x, std::size_t s);

} // namespace ref
