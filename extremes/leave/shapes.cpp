#include "extremes/leave/shapes.h"

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
    const ExactVec3 d = ExactVec3(b) - ExactVec3(a);
    const Exact scale = 1 / length(d);
    return {Exact(d.x * scale).convert_to<double>(), Exact(d.y * scale).convert_to<double>(),
            Exact(d.z * scale).convert_to<double>()};
}

double exact_cosine(const std::array<scenes::Vec3, 3>& triangle, const scenes::Vec3& direction)
{
    const ExactVec3 n = cross(ExactVec3(triangle[1]) - ExactVec3(triangle[0]),
                              ExactVec3(triangle[2]) - ExactVec3(triangle[0]));
    const ExactVec3 d(direction);
    return abs(Exact(dot(n, d) / (length(n) * length(d)))).convert_to<double>();
}

} // namespace extremes
