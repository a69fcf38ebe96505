#include "scenes/polygons/cut.h"

#include "scenes/polygons/holes.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

namespace scenes::polygons {
namespace {

/// The ring without corners at the same place as the corner before. Each removed corner removes a
/// triangle of zero area.
Ring without_repeated(std::span<const Point> points, const Ring& ring,
                      std::vector<PointTriangle>& repeated)
{
    Ring kept;
    for (const std::uint32_t corner : ring) {
        if (kept.empty() || points[kept.back()] != points[corner])
            kept.push_back(corner);
        else
            repeated.push_back({kept.back(), corner, ring.front()});
    }
    while (kept.size() > 1 && points[kept.front()] == points[kept.back()]) {
        repeated.push_back({kept.back(), kept.front(), kept[1]});
        kept.pop_back();
    }
    return kept;
}

/// Twice the signed area.
double area_of(std::span<const Point> points, const Ring& ring)
{
    double area = 0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        const Point a = points[ring[i]] - points[ring[0]];
        const Point b = points[ring[i + 1]] - points[ring[0]];
        area += a.x * b.y - a.y * b.x;
    }
    return area;
}

/// The triangles around the first corner, if none is clockwise.
std::optional<std::vector<PointTriangle>> fan_of(std::span<const Point> points, const Ring& ring)
{
    std::vector<PointTriangle> fan;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
        if (orientation(points[ring[0]], points[ring[i]], points[ring[i + 1]]) < 0) return std::nullopt;
        fan.push_back({ring[0], ring[i], ring[i + 1]});
    }
    return fan;
}

/// Whether all corners are within half a turn around the first one, and the ring does not return to it.
/// Then the edges of a fan that is not clockwise do not cross.
bool is_within_half_a_turn(std::span<const Point> points, const Ring& ring)
{
    const Point& first = points[ring[0]];
    const auto same = [&](std::uint32_t corner) { return points[corner] == first; };
    const auto begin = std::ranges::find_if_not(ring, same);
    if (begin == ring.end()) return true;
    const auto end = std::find_if_not(ring.rbegin(), ring.rend(), same).base();
    return std::all_of(begin, end, [&](std::uint32_t corner) {
        return !same(corner) && orientation(first, points[*begin], points[corner]) >= 0;
    });
}

} // namespace

std::optional<std::vector<PointTriangle>> cut_polygon(std::span<const Point> points,
                                                      const std::vector<Ring>& rings)
{
    std::optional<std::vector<PointTriangle>> fan;
    if (rings.size() == 1) fan = fan_of(points, rings[0]);
    if (fan && is_within_half_a_turn(points, rings[0])) return fan;
    if (points.size() > most_corners) throw std::length_error("too many corners");
    if (cross(points, rings)) return std::nullopt;
    if (fan) return fan;

    std::vector<PointTriangle> triangles;
    Ring walk = without_repeated(points, rings[0], triangles);
    std::vector<Ring> holes;
    for (std::size_t i = 1; i < rings.size(); ++i) {
        std::vector<PointTriangle> repeated;
        Ring hole = without_repeated(points, rings[i], repeated);
        if (hole.size() < 3) continue;
        if (area_of(points, hole) > 0) std::ranges::reverse(hole);
        holes.push_back(std::move(hole));
        triangles.insert(triangles.end(), repeated.begin(), repeated.end());
    }
    if (walk.size() < 3) return std::nullopt;
    if (!holes.empty()) {
        auto joined = join_holes(points, walk, holes);
        if (!joined) return std::nullopt;
        walk = std::move(*joined);
    }
    const auto ears = cut_ears(points, walk);
    if (!ears) return std::nullopt;
    triangles.insert(triangles.end(), ears->begin(), ears->end());
    return triangles;
}

} // namespace scenes::polygons
