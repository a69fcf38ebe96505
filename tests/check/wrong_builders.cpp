#include "tests/check/wrong_builders.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace check_test {

namespace {

using check::NeutralTree;
using ref::Aabb;

constexpr std::size_t block = 64; // of threads

/// Splits every set at its median along the longest axis of its centroids; one primitive per leaf.
class MedianSplit {
public:
    MedianSplit(Defect defect, std::span<const Aabb> boxes) : defect_(defect), boxes_(boxes)
    {
        tree_.primitives.resize(boxes.size());
        std::iota(tree_.primitives.begin(), tree_.primitives.end(), 0);
    }

    NeutralTree take()
    {
        const std::size_t n = boxes_.size();
        if (defect_ == Defect::lost_key && n > block)
            for (std::size_t i = n / block * block; i < n; ++i) tree_.primitives[i] = 0;
        if (n > 0) subtree(0, n);
        if (n > 0 && defect_ == Defect::partial_block && n > block) {
            Aabb scene;
            for (std::size_t i = 0; i < n / block * block; ++i) scene = unite(scene, boxes_[i]);
            tree_.boxes.front() = scene;
        }
        if (n % block == 1 && defect_ == Defect::last_leaf) tree_.boxes.back() = Aabb{};
        if (defect_ == Defect::scene_box)
            for (Aabb& box : tree_.boxes) box = tree_.boxes.front();
        return std::move(tree_);
    }

private:
    [[nodiscard]] ref::Vec3 center(std::int64_t primitive) const
    {
        return centroid(boxes_[static_cast<std::size_t>(primitive)]);
    }

    /// Adds a node without children over these slots, and its box.
    std::size_t add_node(std::size_t first, std::size_t count)
    {
        const std::size_t node = tree_.boxes.size();
        for (const std::int64_t value :
             {NeutralTree::none, NeutralTree::none, static_cast<std::int64_t>(first),
              static_cast<std::int64_t>(count)})
            tree_.nodes.push_back(value);
        Aabb box;
        for (std::size_t i = first; i < first + count; ++i)
            box = unite(box, boxes_[static_cast<std::size_t>(tree_.primitives[i])]);
        tree_.boxes.push_back(box);
        return node;
    }

    void set(std::size_t node, std::size_t column, std::size_t value)
    {
        tree_.nodes[4 * node + column] = static_cast<std::int64_t>(value);
    }

    /// Sorts the slots along the longest axis. Returns its extent, in centroids.
    double sort_slots(std::size_t first, std::size_t count)
    {
        Aabb centers;
        for (std::size_t i = first; i < first + count; ++i)
            centers = unite(centers, {center(tree_.primitives[i]), center(tree_.primitives[i])});
        const ref::Vec3 extent = centers.upper - centers.lower;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const auto begin = tree_.primitives.begin() + static_cast<std::ptrdiff_t>(first);
        std::stable_sort(
            begin, begin + static_cast<std::ptrdiff_t>(count),
            [&](std::int64_t a, std::int64_t b) { return center(a)[axis] < center(b)[axis]; });
        return extent[axis];
    }

    std::size_t subtree(std::size_t first, std::size_t count)
    {
        const std::size_t node = add_node(first, count);
        const bool goes_on = defect_ == Defect::leaf_goes_on && count == 2;
        if (count == 1) return node;
        const double extent = sort_slots(first, count);
        if (defect_ == Defect::short_count && extent == 0) {
            set(node, 3, count % 256);
            return node;
        }
        std::size_t half = count / 2;
        if (defect_ == Defect::chain && extent == 0) half = 1;
        if (!goes_on) {
            set(node, 2, 0);
            set(node, 3, 0);
        }
        if (defect_ == Defect::flat_axis && !(extent / extent > 0))
            return node; // NaN is on neither side
        const std::size_t left = subtree(first, half);
        std::size_t right = subtree(first + half, count - half);
        if (defect_ == Defect::shared_child && extent == 0 && count == 3) right = left;
        if (defect_ == Defect::offset_twice && first > 0) right += first;
        set(node, 0, left);
        set(node, 1, right);
        if (defect_ == Defect::stale_box) tree_.boxes[node] = tree_.boxes[left];
        return node;
    }

    Defect defect_;
    std::span<const Aabb> boxes_;
    NeutralTree tree_;
};

} // namespace

NeutralTree build(Defect defect, std::span<const Aabb> boxes)
{
    for (const Aabb& box : boxes)
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_nan = box.lower[axis] != box.lower[axis] || box.upper[axis] != box.upper[axis];
            if (is_nan && defect == Defect::accepts_nan) return MedianSplit(Defect::none, {}).take();
            if (is_nan || !ref::is_finite(box.lower) || !ref::is_finite(box.upper))
                throw std::invalid_argument("NaN or infinite");
        }
    if (defect == Defect::tiny_input && boxes.size() == 2) throw std::logic_error("endless loop");
    if (defect == Defect::one_primitive && boxes.size() == 1) throw std::logic_error("crash");
    return MedianSplit(defect, boxes).take();
}

} // namespace check_test
