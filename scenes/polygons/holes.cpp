// The hole that reaches furthest to the left sees, from its leftmost corner, a corner of the outline: no
// other hole is on its left. After it is joined to that corner it is part of the outline for the next
// hole [D. Eberly, "Triangulation by Ear Clipping", 2002, sec. 3].

#include "scenes/polygons/holes.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace scenes::polygons {
namespace {

bool is_left_of(const Point& a, const Point& b)
{
    return a.x != b.x ? a.x < b.x : a.y < b.y;
}

/// Whether a bridge may touch other corners and edges.
enum class Touch { nothing, touching };

class Bridges {
public:
    Bridges(std::span<const Point> points, const Ring& outline, const std::vector<Ring>& holes)
        : points_(points), walk_(outline), holes_(holes)
    {
        for (Ring& hole : holes_) { // each begins with its leftmost corner
            const auto leftmost = std::ranges::min_element(
                hole, [&](auto i, auto j) { return is_left_of(points_[i], points_[j]); });
            std::rotate(hole.begin(), leftmost, hole.end());
        }
        std::ranges::sort(holes_, [&](const Ring& a, const Ring& b) {
            return is_left_of(points_[a.front()], points_[b.front()]);
        });
    }

    std::optional<Ring> join()
    {
        for (const Ring& hole : holes_) {
            auto place = visible_corner(hole, Touch::nothing);
            if (!place) place = visible_corner(hole, Touch::touching);
            if (!place) return std::nullopt;
            Ring detour = {hole.begin(), hole.end()};
            detour.push_back(hole.front());
            detour.push_back(walk_[*place]);
            walk_.insert(walk_.begin() + static_cast<std::ptrdiff_t>(*place) + 1, detour.begin(),
                         detour.end());
        }
        return walk_;
    }

private:
    /// The place in the walk of the nearest corner from which a bridge to the first corner of `hole` can
    /// start.
    [[nodiscard]] std::optional<std::size_t> visible_corner(const Ring& hole, Touch touch) const
    {
        const Point& end = points_[hole.front()];
        std::vector<std::size_t> places(walk_.size());
        std::iota(places.begin(), places.end(), 0);
        std::ranges::sort(places, {}, [&](std::size_t place) {
            const Point way = points_[walk_[place]] - end;
            return glm::dot(way, way);
        });
        const auto found = std::ranges::find_if(
            places, [&](std::size_t place) { return is_visible(place, hole, touch); });
        return found == places.end() ? std::nullopt : std::optional(*found);
    }

    [[nodiscard]] bool is_visible(std::size_t place, const Ring& hole, Touch touch) const
    {
        const std::size_t n = walk_.size();
        const Point& start = points_[walk_[place]];
        const Point& end = points_[hole.front()];
        // A bridge must go into the inside. It has length zero where the hole touches the outline.
        const Point& target = start == end ? points_[hole[1]] : end;
        if (!is_in_wedge(points_[walk_[(place + n - 1) % n]], start, points_[walk_[(place + 1) % n]],
                         target))
            return false;
        if (start == end) return true;
        if (is_blocked(start, end, walk_, touch)) return false;
        return std::ranges::none_of(
            holes_, [&](const Ring& other) { return is_blocked(start, end, other, touch); });
    }

    [[nodiscard]] bool is_blocked(const Point& start, const Point& end, const Ring& ring,
                                  Touch touch) const
    {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Point& a = points_[ring[i]];
            const Point& b = points_[ring[(i + 1) % ring.size()]];
            const int a_side = orientation(start, end, a);
            const int b_side = orientation(start, end, b);
            if (touch == Touch::nothing && a_side == 0 && is_between(start, a, end)) return true;
            if (a_side * b_side >= 0) continue; // an edge along the line is tested at its corners
            const int start_side = orientation(a, b, start);
            const int end_side = orientation(a, b, end);
            if (start_side * end_side < 0) return true;
            if (touch == Touch::nothing && (start_side == 0 || end_side == 0)) {
                const Point& on = start_side == 0 ? start : end;
                if (is_between(a, on, b)) return true;
            }
        }
        return false;
    }

    std::span<const Point> points_;
    Ring walk_;
    std::vector<Ring> holes_;
};

} // namespace

std::optional<Ring> join_holes(std::span<const Point> points, const Ring& outline,
                               const std::vector<Ring>& holes)
{
    return Bridges(points, outline, holes).join();
}

} // namespace scenes::polygons
