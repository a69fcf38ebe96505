// An ear is a corner whose two neighbours can be joined by a diagonal: every polygon of more than three
// corners has two [G. H. Meisters, "Polygons Have Ears", American Mathematical Monthly 82 (1975)]. The
// treatment of corners that touch follows M. Held, "FIST: Fast Industrial-Strength Triangulation of
// Polygons", Algorithmica 30 (2001), sec. 3.

#include "scenes/polygons/ears.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cstddef>
#include <deque>

namespace scenes::polygons {
namespace {

/// The condition on the triangle of an ear. The first rule is enough for simple polygons, and keeps them
/// simple. The others are for polygons that touch themselves, if no corner satisfies the rule before.
enum class Rule {
    nothing_touches, // counter-clockwise, and no other corner in it or on its boundary
    nothing_inside,  // counter-clockwise, and no other corner in it
    not_clockwise
};

class Walk {
public:
    Walk(std::span<const Point> points, const Ring& ring) : points_(points), corners_(ring.size())
    {
        const std::size_t n = ring.size();
        for (std::size_t i = 0; i < n; ++i)
            corners_[i] = {ring[i], (i + n - 1) % n, (i + 1) % n, 0, false};
        sort();
    }

    std::optional<std::vector<PointTriangle>> cut()
    {
        for (std::size_t i = 0; i < corners_.size(); ++i) cut_spikes(i);
        Rule rule = Rule::nothing_touches;
        enqueue_all();
        while (left_ > 3) {
            if (const auto ear = next_ear(rule)) {
                const auto [point, previous, next, queued, cut] = corners_[*ear];
                cut_off(*ear);
                cut_spikes(previous);
                cut_spikes(next);
                if (rule != Rule::nothing_touches) enqueue_all();
                rule = Rule::nothing_touches;
            } else if (cut_since_all_) {
                enqueue_all(); // a corner that was no ear may have become one
            } else if (rule == Rule::not_clockwise) {
                return std::nullopt;
            } else {
                rule = rule == Rule::nothing_touches ? Rule::nothing_inside : Rule::not_clockwise;
                enqueue_all();
            }
        }
        const auto last = std::ranges::find(corners_, false, &Corner::cut) - corners_.begin();
        if (turn(static_cast<std::size_t>(last)) < 0) return std::nullopt;
        emit(static_cast<std::size_t>(last));
        return std::move(triangles_);
    }

private:
    struct Corner {
        std::uint32_t point;
        std::size_t previous;
        std::size_t next;
        std::size_t queued; // number of times in the queue: only the last entry counts
        bool cut;
    };

    [[nodiscard]] const Point& at(std::size_t corner) const { return points_[corners_[corner].point]; }
    [[nodiscard]] const Point& before(std::size_t corner) const { return at(corners_[corner].previous); }
    [[nodiscard]] const Point& after(std::size_t corner) const { return at(corners_[corner].next); }
    [[nodiscard]] int turn(std::size_t corner) const
    {
        return orientation(before(corner), at(corner), after(corner));
    }

    /// Along the axis on which edges are shorter in total, so that few corners lie beside an ear.
    void sort()
    {
        Point total(0.0);
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            total += glm::abs(after(i) - at(i));
            sorted_.push_back(i);
        }
        axis_ = total.x <= total.y ? 0 : 1;
        std::ranges::sort(sorted_, {}, [&](std::size_t i) { return at(i)[axis_]; });
    }

    void enqueue(std::size_t corner) { queue_.push_back({corner, ++corners_[corner].queued}); }

    void enqueue_all()
    {
        queue_.clear();
        for (std::size_t i = 0; i < corners_.size(); ++i)
            if (!corners_[i].cut) enqueue(i);
        cut_since_all_ = false;
    }

    std::optional<std::size_t> next_ear(Rule rule)
    {
        while (!queue_.empty()) {
            const auto [corner, queued] = queue_.front();
            queue_.pop_front();
            if (!corners_[corner].cut && corners_[corner].queued == queued && is_ear(corner, rule))
                return corner;
        }
        return std::nullopt;
    }

    [[nodiscard]] bool is_ear(std::size_t corner, Rule rule) const
    {
        const Point& a = before(corner);
        const Point& b = at(corner);
        const Point& c = after(corner);
        const int side = orientation(a, b, c);
        if (rule == Rule::not_clockwise) return side >= 0;
        if (side <= 0) return false;
        const double low = std::min({a[axis_], b[axis_], c[axis_]});
        const double high = std::max({a[axis_], b[axis_], c[axis_]});
        auto other =
            std::ranges::lower_bound(sorted_, low, {}, [&](std::size_t i) { return at(i)[axis_]; });
        for (; other != sorted_.end() && at(*other)[axis_] <= high; ++other)
            if (!corners_[*other].cut && is_in_the_way(*other, corner, rule)) return false;
        return true;
    }

    /// Whether the corner `other` prevents cutting off the counter-clockwise ear `ear`.
    [[nodiscard]] bool is_in_the_way(std::size_t other, std::size_t ear, Rule rule) const
    {
        if (other == ear || other == corners_[ear].previous || other == corners_[ear].next) return false;
        const Point& a = before(ear);
        const Point& b = at(ear);
        const Point& c = after(ear);
        const Point& p = at(other);
        const int ab = orientation(a, b, p);
        const int bc = orientation(b, c, p);
        const int ca = orientation(c, a, p);
        if (ab < 0 || bc < 0 || ca < 0) return false;
        // An edge that starts at a or c and enters the triangle must end in it, and its end is tested.
        // An edge that starts at b may leave the triangle through the diagonal.
        if (p == a || p == c) return false;
        if (p == b) return is_in_wedge(a, b, c, before(other)) || is_in_wedge(a, b, c, after(other));
        return rule == Rule::nothing_touches || (ab > 0 && bc > 0 && ca > 0);
    }

    void emit(std::size_t corner)
    {
        const auto& [point, previous, next, queued, cut] = corners_[corner];
        triangles_.push_back({corners_[previous].point, point, corners_[next].point});
    }

    /// Cuts off `corner`, and then its neighbours, as long as the corner repeats another or is the tip
    /// of a spike. Neither side of a spike is the inside; what remains may be mistaken for an ear.
    void cut_spikes(std::size_t corner)
    {
        std::vector<std::size_t> suspects = {corner};
        while (!suspects.empty() && left_ > 3) {
            corner = suspects.back();
            suspects.pop_back();
            if (corners_[corner].cut || turn(corner) != 0 ||
                is_between(before(corner), at(corner), after(corner)))
                continue;
            suspects.push_back(corners_[corner].previous);
            suspects.push_back(corners_[corner].next);
            cut_off(corner);
        }
    }

    /// The neighbours go to the end of the queue. If ears along a convex outline were cut one after the
    /// other, all of them would share a corner and be long and thin.
    void cut_off(std::size_t corner)
    {
        emit(corner);
        const auto [point, previous, next, queued, cut] = corners_[corner];
        corners_[corner].cut = true;
        corners_[previous].next = next;
        corners_[next].previous = previous;
        enqueue(previous);
        enqueue(next);
        cut_since_all_ = true;
        if (--left_ < sorted_.size() / 2)
            std::erase_if(sorted_, [&](std::size_t i) { return corners_[i].cut; });
    }

    struct Entry {
        std::size_t corner;
        std::size_t queued;
    };

    std::span<const Point> points_;
    std::vector<Corner> corners_;
    std::vector<std::size_t> sorted_;
    int axis_ = 0;
    std::deque<Entry> queue_;
    std::size_t left_ = corners_.size();
    bool cut_since_all_ = false;
    std::vector<PointTriangle> triangles_;
};

} // namespace

std::optional<std::vector<PointTriangle>> cut_ears(std::span<const Point> points, const Ring& walk)
{
    return Walk(points, walk).cut();
}

} // namespace scenes::polygons
