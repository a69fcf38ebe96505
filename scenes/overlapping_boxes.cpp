#include "scenes/overlapping_boxes.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

namespace scenes {
namespace {

constexpr std::size_t few = 24;
constexpr std::size_t most_compared = 4096;

class Search {
public:
    Search(std::span<const Bounds> boxes, const std::function<void(std::uint32_t, std::uint32_t)>& found)
        : boxes_(boxes), found_(found)
    {}

    bool among(const std::vector<std::uint32_t>& members)
    {
        if (members.size() <= few) return compare(members);
        for (const int axis : axes_by_extent(members)) {
            std::vector<std::uint32_t> left;
            std::vector<std::uint32_t> right;
            const double middle = median_center(members, axis);
            for (const std::uint32_t i : members) {
                if (boxes_[i].min[axis] <= middle) left.push_back(i);
                if (boxes_[i].max[axis] >= middle) right.push_back(i);
            }
            // Divide only if both parts are clearly smaller.
            if (4 * std::max(left.size(), right.size()) > 3 * members.size()) continue;
            const bool all_left = among(left);
            return among(right) && all_left;
        }
        return compare(members);
    }

private:
    [[nodiscard]] Vec3 center(std::uint32_t i) const
    {
        return 0.5 * boxes_[i].min + 0.5 * boxes_[i].max;
    }

    /// The axes in the order of the spread of the centres, largest first.
    [[nodiscard]] std::array<int, 3> axes_by_extent(const std::vector<std::uint32_t>& members) const
    {
        Vec3 low = center(members[0]);
        Vec3 high = low;
        for (const std::uint32_t i : members) {
            low = glm::min(low, center(i));
            high = glm::max(high, center(i));
        }
        std::array<int, 3> axes{0, 1, 2};
        const Vec3 extent = high - low;
        std::ranges::sort(axes, [&](int a, int b) { return extent[a] > extent[b]; });
        return axes;
    }

    [[nodiscard]] double median_center(const std::vector<std::uint32_t>& members, int axis) const
    {
        std::vector<double> centers;
        for (const std::uint32_t i : members) centers.push_back(center(i)[axis]);
        const auto middle = centers.begin() + static_cast<std::ptrdiff_t>(centers.size() / 2);
        std::ranges::nth_element(centers, middle);
        return *middle;
    }

    bool compare(const std::vector<std::uint32_t>& members)
    {
        if (members.size() > most_compared) return false;
        for (std::size_t i = 0; i < members.size(); ++i)
            for (std::size_t j = i + 1; j < members.size(); ++j) {
                const Bounds& a = boxes_[members[i]];
                const Bounds& b = boxes_[members[j]];
                bool apart = false;
                for (int axis = 0; axis < 3; ++axis)
                    apart = apart || a.max[axis] < b.min[axis] || b.max[axis] < a.min[axis];
                if (!apart) found_(std::min(members[i], members[j]), std::max(members[i], members[j]));
            }
        return true;
    }

    std::span<const Bounds> boxes_;
    const std::function<void(std::uint32_t, std::uint32_t)>& found_;
};

} // namespace

bool for_each_overlap(std::span<const Bounds> boxes,
                      const std::function<void(std::uint32_t, std::uint32_t)>& found)
{
    std::vector<std::uint32_t> members(boxes.size());
    std::iota(members.begin(), members.end(), 0u);
    return Search(boxes, found).among(members);
}

} // namespace scenes
