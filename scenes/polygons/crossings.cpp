#include "scenes/polygons/crossings.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>

namespace scenes::polygons {
namespace {

/// The edge from `from` to `to`, and the point before it, so that the start of the edge can be examined
/// as a corner, too.
struct Edge {
    Point before;
    Point from;
    Point to;
};

/// The edges of a ring, without those of length zero.
void append_edges(std::span<const Point> points, const Ring& ring, std::vector<Edge>& edges)
{
    std::vector<Point> corners;
    for (const std::uint32_t corner : ring)
        if (corners.empty() || corners.back() != points[corner]) corners.push_back(points[corner]);
    while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    const std::size_t n = corners.size();
    if (n < 2) return;
    for (std::size_t i = 0; i < n; ++i)
        edges.push_back({corners[(i + n - 1) % n], corners[i], corners[(i + 1) % n]});
}

bool inner_points_meet(const Edge& a, const Edge& b)
{
    return orientation(a.from, a.to, b.from) * orientation(a.from, a.to, b.to) < 0 &&
           orientation(b.from, b.to, a.from) * orientation(b.from, b.to, a.to) < 0;
}

/// Whether the walk crosses `edge` at the corner where `other` starts.
bool corner_crosses(const Edge& edge, const Edge& other)
{
    return orientation(edge.from, edge.to, other.from) == 0 &&
           is_between(edge.from, other.from, edge.to) &&
           orientation(edge.from, edge.to, other.before) * orientation(edge.from, edge.to, other.to) < 0;
}

/// Whether two corners at the same place cross: one edge of the second corner is on the left of the
/// first corner, the other on its right. The tip of a spike has no left and right side.
bool corners_cross(const Edge& a, const Edge& b)
{
    if (a.from != b.from) return false;
    if (orientation(a.before, a.from, a.to) == 0 && !is_between(a.before, a.from, a.to)) return false;
    const auto left = [&](const Point& p) { return is_in_wedge(a.before, a.from, a.to, p); };
    const auto right = [&](const Point& p) { return is_in_wedge(a.to, a.from, a.before, p); };
    return (left(b.before) && right(b.to)) || (right(b.before) && left(b.to));
}

bool cross(const Edge& a, const Edge& b)
{
    return inner_points_meet(a, b) || corner_crosses(a, b) || corner_crosses(b, a) ||
           corners_cross(a, b);
}

} // namespace

bool cross(std::span<const Point> points, std::span<const Ring> rings)
{
    std::vector<Edge> edges;
    for (const Ring& ring : rings) append_edges(points, ring, edges);

    // Only edges that overlap along both axes can meet. After sorting along one axis, edges that overlap
    // along it are neighbours.
    Point total(0.0);
    for (const Edge& edge : edges) total += glm::abs(edge.to - edge.from);
    const int axis = total.x <= total.y ? 0 : 1;
    const auto low = [](const Edge& e, int i) { return std::min(e.from[i], e.to[i]); };
    const auto high = [](const Edge& e, int i) { return std::max(e.from[i], e.to[i]); };
    std::ranges::sort(edges, {}, [&](const Edge& e) { return low(e, axis); });
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size() && low(edges[j], axis) <= high(edges[i], axis); ++j)
            if (low(edges[j], 1 - axis) <= high(edges[i], 1 - axis) &&
                low(edges[i], 1 - axis) <= high(edges[j], 1 - axis) && cross(edges[i], edges[j]))
                return true;
    return false;
}

} // namespace scenes::polygons
