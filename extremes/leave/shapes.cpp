#include "extremes/leave/shapes.h"

#include "scenes/largest_component.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace extremes {

Turn random_turn(Random& random)
{
    const scenes::Vec3 x = random.direction();
    scenes::Vec3 other = random.direction();
    while (std::abs(glm::dot(x, other)) > 0.9) other = random.direction();
    const scenes::Vec3 y = glm::normalize(glm::cross(x, other));
    return {x, y, glm::cross(x, y)};
}

scenes::Vec3 direction_between(const scenes::Vec3& a, const scenes::Vec3& b)
{
    const double largest = std::max(scenes::largest_component(a), scenes::largest_component(b));
    const bool would_overflow = largest > 1e300;
    const scenes::Vec3 d = would_overflow ? 0.5 * b - 0.5 * a : b - a;
    return glm::normalize(d / scenes::largest_component(d));
}

double cosine_to_normal(const std::array<scenes::Vec3, 3>& triangle, const scenes::Vec3& direction)
{
    return std::abs(glm::dot(
        glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0])), direction));
}

} // namespace extremes
