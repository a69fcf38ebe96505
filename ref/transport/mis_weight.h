#pragma once

// Multiple importance sampling over the strategies of bidirectional path tracing, written as in the
// definition: the density of the finished path under every strategy, computed from the path alone, and
// the weight of one strategy [Veach 1997, sec. 10.2.1 with the balance and power heuristics of sec.
// 9.2].

#include "ref/transport/vertex.h"

#include <span>
#include <vector>

namespace ref {

/// A finished path x_0 ... x_k, from the emitter to the eye: x_i = y_i for i < s; the other vertices
/// are those of the eye subpath, backwards.
using Path = std::vector<const Vertex*>;

/// For every vertex x_i of a path, the density with which each walk samples it from the vertices
/// before it on its side: per area on a surface, per solid angle at infinity. The probability that
/// roulette lets the walk reach the vertex is included.
struct VertexDensities {
    std::vector<double> light; // p(x_i | x_{i-1}, x_{i-2}): by the light walk
    std::vector<double> eye;   // p(x_i | x_{i+1}, x_{i+2}): by the eye walk
};

VertexDensities vertex_densities(const World& world, const PathOptions& options, const Path& x);

/// Whether the strategy (s, k + 1 - s) can produce the path at all: x_{s-1} and x_s can be joined, or,
/// for s = 0, a walk can hit x_0.
bool is_possible(const World& world, const Path& x, std::size_t s);

/// p_i / p_s for i = 0 ... k: the density of the path under strategy i, relative to strategy s; 0
/// where i cannot produce it. `p` are the path's densities; none of the factors of p_s may be 0. p_i
/// is the product of p.light over x_0 ... x_{i-1} and of p.eye over x_i ... x_k. The quotient of two
/// neighbours has only two factors that differ: p_{i+1} / p_i = p.light[i] / p.eye[i] [Veach 1997, eq.
/// 10.9]. So a product has no more factors than the distance between the two strategies. The full
/// products p_i of a long path would overflow or underflow, in any unit of length.
std::vector<double> density_quotients(const World& world, const Path& x, const VertexDensities& p,
                                      std::size_t s);

/// The weight of strategy s for the path, 0 ... 1: exactly 0 where it is not possible. The weights of
/// all strategies add up to 1, except by Heuristic::uniform.
double mis_weight(const World& world, const PathOptions& options, const Path& x, std::size_t s);

} // namespace ref
