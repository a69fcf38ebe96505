#include "tests/cuda/path_judge/followed_walk.h"

#include "tests/cuda/path_judge/path_rounding.h"
#include "tests/cuda/trees/hit_bounds.h"

#include <optional>

namespace path_judge_test {

using fast_trees_test::exactly;
using fast_trees_test::hit_bounds;
using fast_trees_test::HitBounds;

namespace {

using ref::Vec3;

HitBounds hit_bounds_on(const ref::World& world, const fast::Ray& ray, std::uint32_t primitive,
                        double slack)
{
    const scenes::Scene& scene = world.scene;
    if (primitive < scene.triangles.size()) {
        const auto& v = scene.triangles[primitive].vertices;
        return hit_bounds(ray, fast::Triangle{{fast::Vec3(v[0]), fast::Vec3(v[1]), fast::Vec3(v[2])}},
                          slack);
    }
    const auto& sphere = scene.spheres[primitive - scene.triangles.size()];
    return hit_bounds(ray, fast::Sphere{fast::Vec3(sphere.center), static_cast<float>(sphere.radius)},
                      slack);
}

/// Compares the primitive that `ray` found, or no hit, with the hits of the reference on the same ray.
void require_closest(const ref::World& world, const fast::Ray& ray, double slack,
                     std::optional<std::uint32_t> found)
{
    const auto closest = ref::intersect(world.geometry, exactly(ray));
    if (closest && found != closest->primitive) {
        const HitBounds missed = hit_bounds_on(world, ray, closest->primitive, slack);
        const bool is_before =
            !found || missed.highest < hit_bounds_on(world, ray, *found, slack).lowest;
        require(!(missed.certain && is_before), "a ray misses a primitive that it must hit");
    }
    if (found)
        require(hit_bounds_on(world, ray, *found, slack).possible,
                "a ray hits a primitive that it must miss");
}

/// Requires that the point found is where `ray` meets its primitive.
void require_position(const ref::World& world, const fast::Ray& ray, double slack,
                      const fast::SurfacePoint& point)
{
    const HitBounds bounds = hit_bounds_on(world, ray, point.primitive, slack);
    const Vec3 d(ray.direction);
    const Vec3 from = Vec3(point.position) - Vec3(ray.origin);
    const double t = glm::dot(from, d) / glm::dot(d, d);
    // The error of the vertex weights of a triangle, and, for a sphere, that of t and of the sum on
    // the ray; then the error of any point of the surface.
    double size = glm::length(from) + glm::length(Vec3(ray.origin));
    double across = slack;
    if (point.primitive < world.scene.triangles.size()) {
        const auto& v = world.scene.triangles[point.primitive].vertices;
        const double edges = glm::length(v[1] - v[0]) + glm::length(v[2] - v[0]);
        across += 3 * bounds.margin * edges + moved_off_edges(v, Vec3(point.position));
        size += edges;
    } else {
        const auto& sphere = world.scene.spheres[point.primitive - world.scene.triangles.size()];
        size += glm::length(sphere.center) + sphere.radius;
        // The projection onto the sphere moves it by the hit's distance from the sphere (sphere.h: 22
        // u M).
        across += 44 * roundoff * (glm::length(Vec3(ray.origin) - sphere.center) + sphere.radius);
    }
    across += 8 * roundoff * size;
    require(glm::length(from - t * d) <= across, "a vertex is off its ray");
    require(t >= bounds.lowest - across && t <= bounds.highest + across,
            "a vertex is not where its ray meets the surface");
}

double angle_between(const Vec3& a, const Vec3& b)
{
    return glm::length(glm::normalize(a) - glm::normalize(b));
}

/// The fast path's vertex; alpha is the reference's.
ref::Vertex vertex_of(const Setting& setting, const fast::WalkVertex& vertex, const NextStep& step)
{
    for (int i = 0; i < 3; ++i)
        require(std::abs(vertex.alpha[i] - step.alpha[i]) <= step.alpha_error * step.alpha[i] + 0x1p-100,
                "a walk has a wrong weight");
    return surface_vertex(setting.world, surface_of(setting.world, vertex.point), step.alpha);
}

/// The one of the possible steps that the walk took, given its direction `d`.
NextStep step_taken(const std::vector<NextStep>& steps, const Vec3& d)
{
    require(!steps.empty(), "a walk goes on where it must end");
    for (const NextStep& step : steps)
        if (glm::length(d - step.direction) <= step.error) return step;
    throw Disagreement("a walk has a wrong direction");
}

/// A walk may end without a record if it is in the plane of a surface.
void require_in_plane(const ref::World& world, const NextStep& step)
{
    const ref::Ray ray{step.origin, step.direction};
    const auto hit = ref::intersect(world.geometry, ray);
    require(hit.has_value(), "a walk ends where it must go on to infinity");
    const double cosine = glm::dot(surface_point(world.geometry, ray, *hit).normal, step.direction);
    require(std::abs(cosine) <= cosine_error + step.error, "a walk ends where it must go on");
    throw Undecided("a walk in the plane of a surface");
}

} // namespace

void follow(const Setting& setting, ref::Transport carried, const RecordedSample::Walk& recorded,
            std::size_t most_vertices, NextStep step, FollowedWalk& walk)
{
    const ref::World& world = setting.world;
    std::vector<NextStep> steps = {step};
    for (std::size_t n = 1;; ++n) {
        const bool met = n <= recorded.vertices.size();
        const bool over = n >= most_vertices || steps.empty() || steps[0].alpha == ref::Rgb(0);
        require(!over || (!met && !recorded.missed), "a walk goes on where it must end");
        if (over) return;
        if (ref::max_component(steps[0].alpha) < 0x1p-100)
            throw Undecided("too little light for floats");
        if (!met && !recorded.missed) require_in_plane(world, steps[0]);

        const fast::Vec3 d = met ? -recorded.vertices[n - 1].wo : recorded.missed->ray.direction;
        step = step_taken(steps, Vec3(d));
        const fast::Ray ray{fast::Vec3(step.origin), std::numeric_limits<float>::infinity(), d};
        if (!met) {
            require_closest(world, ray, step.slack, std::nullopt);
            if (carried == ref::Transport::radiance && world.scene.environment) {
                walk.vertices.push_back(
                    infinity_vertex(*world.emitters.environment(), Vec3(d), step.alpha));
                walk.turned.push_back(0);
                walk.alpha_error.push_back(step.alpha_error);
            }
            return;
        }
        const fast::WalkVertex& vertex = recorded.vertices[n - 1];
        require(vertex.n == static_cast<int>(n), "a vertex has a wrong number");
        require_closest(world, ray, step.slack, vertex.point.primitive);
        require_on_surface(world, vertex.point);
        require_position(world, ray, step.slack, vertex.point);
        const ref::Vertex& last = walk.vertices.back();
        walk.turned.push_back(
            last.kind == ref::Vertex::Kind::infinity
                ? 0
                : angle_between(Vec3(vertex.point.position) - last.point.position, Vec3(d)));
        walk.vertices.push_back(vertex_of(setting, vertex, step));
        walk.alpha_error.push_back(step.alpha_error);
        steps =
            n + 1 < most_vertices ? next_steps(setting, carried, vertex, step) : std::vector<NextStep>{};
    }
}

} // namespace path_judge_test
