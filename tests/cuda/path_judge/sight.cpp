#include "tests/cuda/path_judge/sight.h"

#include "tests/cuda/path_judge/path_rounding.h"
#include "tests/cuda/trees/hit_bounds.h"

#include "scenes/contacts.h"

#include <cmath>

namespace path_judge_test {

using fast_trees_test::hit_bounds;
using fast_trees_test::HitBounds;

double end_slack(const ref::World& world, const ref::Vec3& end)
{
    // coincident_arrays.h: 30 u D for the surface, and clearance.h: 24 u D for the longest segment.
    const double clearance = 54 * roundoff * world.geometry.diagonal();
    if (scenes::surfaces_near(world.scene, end, clearance).empty()) return 0;
    return std::sqrt(3.0) * clearance; // along three planes at right angles
}

void explain_sight(const ref::World& world, const LineOfSight& line, bool seen)
{
    const scenes::Scene& scene = world.scene;
    const ref::Vec3 direction = line.to_infinity ? line.to : line.to - line.from;
    const float t_max = line.to_infinity ? std::numeric_limits<float>::infinity() : 1.0f;
    const fast::Ray ray{fast::Vec3(line.from), t_max, fast::Vec3(direction)};
    // The ray here is rounded like that of the fast path.
    const double rounding = 4 * roundoff * (glm::length(line.from) + glm::length(direction));
    // A direction that turns by an angle moves points of the scene by that angle times two diagonals.
    const double far_slack =
        line.to_infinity ? 2 * world.geometry.diagonal() * line.to_slack : line.to_slack;
    bool may_be_hit = false;
    for (std::uint32_t i = 0; i < scenes::primitive_count(scene); ++i) {
        // At an end only the slack of that end matters: elsewhere the line is away from the surface of
        // the end.
        const double slack = rounding + (line.start == i ? line.from_slack
                                         : line.end == i ? line.to_slack
                                                         : std::max(line.from_slack, far_slack));
        const std::size_t triangles = scene.triangles.size();
        HitBounds judged{};
        if (i < triangles) {
            const auto& v = scene.triangles[i].vertices;
            judged = hit_bounds(
                ray, fast::Triangle{{fast::Vec3(v[0]), fast::Vec3(v[1]), fast::Vec3(v[2])}}, slack);
        } else {
            const auto& sphere = scene.spheres[i - triangles];
            judged = hit_bounds(
                ray, fast::Sphere{fast::Vec3(sphere.center), static_cast<float>(sphere.radius)}, slack);
        }
        require(!(seen && judged.certain), "a blocked line of sight counts as free");
        may_be_hit = may_be_hit || judged.possible;
    }
    require(seen || may_be_hit, "a free line of sight counts as blocked");
    throw Undecided("a line of sight along an edge");
}

} // namespace path_judge_test
