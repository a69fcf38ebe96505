#pragma once

// Polygons with corners at whole numbers, so that everything can be checked without rounding.

#include "scenes/polygons/cut.h"

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace transport_test {

using scenes::polygons::Point;
using scenes::polygons::PointTriangle;
using scenes::polygons::Ring;

struct WholePoint {
    std::int64_t x, y;
    bool operator==(const WholePoint&) const = default;
};

inline std::int64_t twice_area(const WholePoint& a, const WholePoint& b, const WholePoint& c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The first ring is the outline, the others are holes.
using Shape = std::vector<std::vector<WholePoint>>;

inline std::int64_t twice_area(const std::vector<WholePoint>& ring)
{
    std::int64_t area = 0;
    for (std::size_t i = 0; i + 2 < ring.size(); ++i)
        area += twice_area(ring[0], ring[i + 1], ring[i + 2]);
    return area;
}

/// Twice the area of the outline minus the holes, which may turn in either direction.
inline std::int64_t twice_area(const Shape& shape)
{
    std::int64_t area = twice_area(shape[0]);
    for (std::size_t i = 1; i < shape.size(); ++i) area -= std::abs(twice_area(shape[i]));
    return area;
}

inline std::vector<WholePoint> all_corners(const Shape& shape)
{
    std::vector<WholePoint> corners;
    for (const auto& ring : shape) corners.insert(corners.end(), ring.begin(), ring.end());
    return corners;
}

inline std::vector<Point> points_of(const Shape& shape)
{
    std::vector<Point> points;
    for (const WholePoint& p : all_corners(shape))
        points.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y));
    return points;
}

inline std::vector<Ring> rings_of(const Shape& shape)
{
    std::vector<Ring> rings;
    std::uint32_t next = 0;
    for (const auto& corners : shape) {
        rings.emplace_back(corners.size());
        std::iota(rings.back().begin(), rings.back().end(), next);
        next += static_cast<std::uint32_t>(corners.size());
    }
    return rings;
}

/// Whether the segments ab and cd have a point in common.
inline bool meet(const WholePoint& a, const WholePoint& b, const WholePoint& c, const WholePoint& d)
{
    const auto sign = [](std::int64_t v) { return v > 0 ? 1 : v < 0 ? -1 : 0; };
    const auto on = [](const WholePoint& p, const WholePoint& q, const WholePoint& r) {
        return std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= r.y &&
               r.y <= std::max(p.y, q.y);
    };
    const int abc = sign(twice_area(a, b, c));
    const int abd = sign(twice_area(a, b, d));
    const int cda = sign(twice_area(c, d, a));
    const int cdb = sign(twice_area(c, d, b));
    if (abc != abd && cda != cdb) return true;
    return (abc == 0 && on(a, b, c)) || (abd == 0 && on(a, b, d)) || (cda == 0 && on(c, d, a)) ||
           (cdb == 0 && on(c, d, b));
}

/// Whether the polygon is simple: only neighbouring edges have a point in common, their corner.
inline bool is_simple(const std::vector<WholePoint>& ring)
{
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        const WholePoint& a = ring[i];
        const WholePoint& b = ring[(i + 1) % n];
        const WholePoint& c = ring[(i + 2) % n];
        if (a == b || (twice_area(a, b, c) == 0 && (meet(a, b, c, c) || meet(b, c, a, a)))) return false;
        for (std::size_t j = i + 2; j < n; ++j)
            if ((j + 1) % n != i && meet(a, b, ring[j], ring[(j + 1) % n])) return false;
    }
    return true;
}

/// Whether a point that is on no edge is inside, by the even-odd rule. The point is given times three.
inline bool is_inside(const Shape& shape, const WholePoint& tripled)
{
    bool inside = false;
    for (const auto& ring : shape)
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const WholePoint a{3 * ring[i].x, 3 * ring[i].y};
            const WholePoint& next = ring[(i + 1) % ring.size()];
            const WholePoint b{3 * next.x, 3 * next.y};
            if ((a.y > tripled.y) == (b.y > tripled.y)) continue;
            if ((twice_area(a, b, tripled) > 0) == (b.y > a.y)) inside = !inside;
        }
    return inside;
}

/// A polygon through points drawn from a grid of `width` x `width`. It is made simple by reversing the
/// part between two edges that meet, as long as there are such edges; empty if that does not succeed.
inline std::vector<WholePoint> random_simple_ring(int corners, int width)
{
    std::vector<WholePoint> ring;
    for (int i = 0; i < corners; ++i)
        ring.push_back({*rc::gen::inRange(0, width), *rc::gen::inRange(0, width)});
    const std::size_t n = ring.size();
    for (int pass = 0; pass < 100; ++pass) {
        if (is_simple(ring)) {
            if (twice_area(ring) < 0) std::reverse(ring.begin(), ring.end());
            return ring;
        }
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i + 2; j < n; ++j)
                if ((j + 1) % n != i && meet(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n]))
                    std::reverse(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                                 ring.begin() + static_cast<std::ptrdiff_t>(j) + 1);
    }
    return {};
}

/// A random simple polygon of three corners or more that begins with any corner. On a coarse grid
/// corners are often in line with others.
inline std::vector<WholePoint> any_simple_ring(int most_corners)
{
    const int corners = *rc::gen::inRange(3, most_corners + 1);
    const int width = *rc::gen::element(4, 7, 20, 100000);
    std::vector<WholePoint> ring = random_simple_ring(corners, width);
    RC_PRE(!ring.empty());
    const auto first = *rc::gen::inRange<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(ring.size()));
    std::rotate(ring.begin(), ring.begin() + first, ring.end());
    return ring;
}

/// The same with up to `most_holes` holes. No hole touches another ring or lies in another hole.
inline Shape any_shape_with_holes(int most_corners, int most_holes)
{
    Shape shape = {any_simple_ring(most_corners)};
    for (WholePoint& p : shape[0]) p = {12 * p.x, 12 * p.y};
    const auto tripled = [](const WholePoint& p) { return WholePoint{3 * p.x, 3 * p.y}; };
    const auto fits = [&](const std::vector<WholePoint>& hole) {
        for (const auto& ring : shape)
            for (std::size_t i = 0; i < ring.size(); ++i)
                for (std::size_t j = 0; j < hole.size(); ++j)
                    if (meet(ring[i], ring[(i + 1) % ring.size()], hole[j],
                             hole[(j + 1) % hole.size()]) ||
                        is_inside({hole}, tripled(ring[i])))
                        return false;
        return is_inside(shape, tripled(hole[0]));
    };
    const int wanted = *rc::gen::inRange(1, most_holes + 1);
    for (int tries = 0; tries < 30 && static_cast<int>(shape.size()) <= wanted; ++tries) {
        std::vector<WholePoint> hole =
            random_simple_ring(*rc::gen::inRange(3, 7), *rc::gen::element(3, 9, 40));
        if (hole.empty()) continue;
        const WholePoint& near = shape[0][*rc::gen::inRange<std::size_t>(0, shape[0].size())];
        const WholePoint shift{near.x + *rc::gen::inRange(-60, 60), near.y + *rc::gen::inRange(-60, 60)};
        for (WholePoint& p : hole) p = {p.x + shift.x, p.y + shift.y};
        if (*rc::gen::arbitrary<bool>()) std::reverse(hole.begin(), hole.end());
        if (fits(hole)) shape.push_back(hole);
    }
    RC_PRE(shape.size() > 1);
    return shape;
}

/// The text in which a failing test shows the shape.
inline std::string text_of(const Shape& shape)
{
    std::string text;
    for (const auto& ring : shape) {
        for (const WholePoint& p : ring) text += std::to_string(p.x) + "," + std::to_string(p.y) + " ";
        text += "; ";
    }
    return text;
}

/// A star of `points` points, some of them three times as far from the middle as others.
inline std::vector<WholePoint> star(int points)
{
    std::vector<WholePoint> ring;
    for (int i = 0; i < 2 * points; ++i) {
        const double angle = std::numbers::pi * i / points;
        const double radius = i % 2 == 0 ? 3000 : 1000;
        ring.push_back({std::llround(radius * std::cos(angle)), std::llround(radius * std::sin(angle))});
    }
    return ring;
}

/// A band of width 1 that winds around itself `turns` times, with square corners.
inline std::vector<WholePoint> spiral(int turns)
{
    std::vector<WholePoint> inner;
    std::vector<WholePoint> outer;
    for (int i = 1; i <= turns; ++i) { // counter-clockwise outwards
        const int r = 2 * i;
        for (const auto& [x, y] :
             {std::pair(r, 1 - r), std::pair(r, r), std::pair(-r, r), std::pair(-r, -r - 1)}) {
            inner.push_back({x, y});
            outer.push_back({x + (x > 0 ? 1 : -1), y + (y > 0 ? 1 : -1)});
        }
    }
    std::vector<WholePoint> ring = outer;
    ring.insert(ring.end(), inner.rbegin(), inner.rend());
    return ring;
}

/// A comb with `teeth` teeth, their tips and gaps in line.
inline std::vector<WholePoint> comb(int teeth)
{
    std::vector<WholePoint> ring = {{0, 0}, {2 * teeth - 1, 0}};
    for (int i = teeth; i > 0; --i) {
        ring.push_back({2 * i - 1, 10});
        ring.push_back({2 * i - 2, 10});
        if (i > 1) {
            ring.push_back({2 * i - 2, 1});
            ring.push_back({2 * i - 3, 1});
        }
    }
    return ring;
}

} // namespace transport_test
