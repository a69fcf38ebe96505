#include "docs/figures/float_path.h"

#include "ref/transport/path_tracer.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

namespace figures {

namespace {

using Vec3f = glm::vec3;
constexpr std::uint32_t no_primitive = ~0U;

/// Where a ray meets a surface.
struct FloatHit {
    float t = std::numeric_limits<float>::infinity();
    std::uint32_t primitive = no_primitive;
    Vec3f barycentric{0.0F};
};

/// The ray meets the triangle at 0 < t < hit.t: updates `hit` [Möller and Trumbore 1997].
void meet_triangle(const scenes::Triangle& triangle, std::uint32_t number, const Vec3f& origin,
                   const Vec3f& d, FloatHit& hit)
{
    const Vec3f v0(triangle.vertices[0]);
    const Vec3f e1 = Vec3f(triangle.vertices[1]) - v0;
    const Vec3f e2 = Vec3f(triangle.vertices[2]) - v0;
    const Vec3f p = glm::cross(d, e2);
    const float determinant = glm::dot(e1, p);
    if (determinant == 0.0F) return;
    const Vec3f from = origin - v0;
    const float u = glm::dot(from, p) / determinant;
    const Vec3f q = glm::cross(from, e1);
    const float v = glm::dot(d, q) / determinant;
    const float t = glm::dot(e2, q) / determinant;
    if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F && t > 0.0F && t < hit.t)
        hit = {t, number, {1.0F - u - v, u, v}};
}

/// The same for a sphere; the direction has unit length.
void meet_sphere(const scenes::Sphere& sphere, std::uint32_t number, const Vec3f& origin, const Vec3f& d,
                 FloatHit& hit)
{
    const auto radius = static_cast<float>(sphere.radius);
    const Vec3f f = origin - Vec3f(sphere.center);
    const float b = -glm::dot(f, d);
    const Vec3f l = f + b * d;
    const float discriminant = radius * radius - glm::dot(l, l);
    if (discriminant < 0.0F) return;
    const float q = b + std::copysign(std::sqrt(discriminant), b);
    const float c = glm::dot(f, f) - radius * radius;
    for (const float t : {c / q, q})
        if (t > 0.0F && t < hit.t) hit = {t, number, {}};
}

FloatHit meet(const ref::World& world, const Vec3f& origin, const Vec3f& d)
{
    FloatHit hit;
    std::uint32_t number = 0;
    for (const scenes::Triangle& triangle : world.scene.triangles)
        meet_triangle(triangle, number++, origin, d, hit);
    for (const scenes::Sphere& sphere : world.scene.spheres)
        meet_sphere(sphere, number++, origin, d, hit);
    if (hit.primitive == no_primitive) return hit;
    // Of surfaces in the same place a ray sees a lamp from its front (docs/contacts.md).
    for (const std::uint32_t other : world.geometry.coincident().of(hit.primitive)) {
        if (other >= world.scene.triangles.size()) continue;
        const scenes::Triangle& triangle = world.scene.triangles[other];
        const auto& v = triangle.vertices;
        const bool front = glm::dot(glm::cross(v[1] - v[0], v[2] - v[0]), ref::Vec3(d)) < 0.0;
        FloatHit lamp;
        meet_triangle(triangle, other, origin, d, lamp);
        if (front && lamp.primitive == other &&
            std::holds_alternative<scenes::Emission>(world.scene.materials[triangle.material]))
            return lamp;
    }
    return hit;
}

/// The surface at `hit`, with the position that floats give: from the weights of the vertices, or
/// projected onto the sphere.
ref::SurfacePoint point_at(const ref::World& world, const Vec3f& origin, const Vec3f& d,
                           const FloatHit& hit)
{
    const ref::Ray ray{ref::Vec3(origin), ref::Vec3(d)};
    ref::SurfacePoint point =
        surface_point(world.geometry, ray, {hit.t, hit.primitive, ref::Vec3(hit.barycentric)});
    if (hit.primitive < world.scene.triangles.size()) {
        const auto& v = world.scene.triangles[hit.primitive].vertices;
        const Vec3f v0(v[0]);
        point.position = ref::Vec3(
            v0 + (hit.barycentric[1] * (Vec3f(v[1]) - v0) + hit.barycentric[2] * (Vec3f(v[2]) - v0)));
    } else {
        const scenes::Sphere& sphere = world.scene.spheres[hit.primitive - world.scene.triangles.size()];
        const Vec3f center(sphere.center);
        const Vec3f n = glm::normalize(origin + hit.t * d - center);
        point.position = ref::Vec3(center + static_cast<float>(sphere.radius) * n);
        point.normal = ref::Vec3(n);
    }
    return point;
}

class FloatPath {
public:
    FloatPath(const ref::World& world, const ref::PathOptions& options, Leave leave, SelfHits& self)
        : world_(world), options_(options), leave_(leave), self_(self)
    {}

    /// The radiance of one sample; the steps are those of ref::trace_path.
    [[nodiscard]] ref::Rgb trace(const ref::SampleId& id) const
    {
        ref::Rgb sum(0.0);
        const auto add = [&](const std::optional<ref::Contribution>& c) {
            if (c) sum += c->weight * c->value;
        };
        ref::EyeWalk walk = ref::first_edge(world_, id);
        std::uint32_t left = no_primitive;
        for (int j = 1; j <= last_edge(options_); ++j) {
            const Vec3f origin(walk.ray.origin);
            const Vec3f d(walk.ray.direction);
            const FloatHit hit = meet(world_, origin, d);
            if (left != no_primitive) count(hit, left, walk);
            if (hit.primitive == no_primitive) {
                add(environment_of_edge(world_, id, j, walk));
                return sum;
            }
            const ref::SurfacePoint point = point_at(world_, origin, d, hit);
            add(emission_of_edge(world_, id, j, walk, point));
            if (j == options_.max_edges) return sum;
            const ref::WalkVertex vertex(world_, walk, point);
            sum += next_event(id, j, walk, vertex);
            const auto next = next_edge(options_, id, j, walk, vertex);
            if (!next) return sum;
            walk = *next;
            walk.ray.origin = ref::Vec3(left_surface(point, walk.ray.direction));
            left = hit.primitive;
        }
        return sum;
    }

private:
    /// Where a ray in `direction` (unit length) starts that leaves `point`, or a segment of this length
    /// ends that comes from that direction.
    [[nodiscard]] Vec3f left_surface(const ref::SurfacePoint& point, const ref::Vec3& direction,
                                     double length = 0.0) const
    {
        const Vec3f p(point.position);
        if (leave_.epsilon != 0.0F) return p + leave_.epsilon * Vec3f(direction);
        // The bound is in units of the unit roundoff of doubles; floats have 29 bits less.
        const double bound =
            0x1p29 * (glm::dot(glm::abs(point.normal), point.error) + 16 * 0x1p-53 * length);
        const double side = glm::dot(direction, point.normal) < 0.0 ? -1.0 : 1.0;
        return Vec3f(ref::Vec3(p) + side * bound * point.normal);
    }

    /// As next_event_of_vertex, with a segment in floats.
    [[nodiscard]] ref::Rgb next_event(const ref::SampleId& id, int j, const ref::EyeWalk& walk,
                                      const ref::WalkVertex& vertex) const
    {
        if (ref::is_delta(vertex.material)) return ref::Rgb(0.0);
        const auto light =
            sample_incident(world_.emitters, vertex.point.position,
                            uniforms(id, ref::Event::next_event, static_cast<std::uint32_t>(j)));
        if (!light) return ref::Rgb(0.0);
        const ref::Vec3 wi_local = vertex.frame.to_local(light->wi);
        const ref::Rgb f = ref::evaluate_bsdf(vertex.material, vertex.wo_local, wi_local);
        if (f == ref::Rgb(0.0) || is_hidden(vertex.point, *light)) return ref::Rgb(0.0);
        const double pdf_hit = light->delta ? 0.0 : pdf_of_bounce(options_, j, vertex, wi_local);
        return walk.throughput * f * std::abs(wi_local.z) * light->radiance / (light->pdf + pdf_hit);
    }

    /// Whether something is between `point` and the light: both ends of the segment are moved.
    [[nodiscard]] bool is_hidden(const ref::SurfacePoint& point, const ref::IncidentLight& light) const
    {
        const Vec3f from = left_surface(point, light.wi);
        if (light.infinite) return meet(world_, from, Vec3f(light.wi)).primitive != no_primitive;
        const Vec3f to = light.delta ? Vec3f(light.end.position)
                                     : left_surface(light.end, -light.wi,
                                                    glm::length(light.end.position - point.position));
        const float length = glm::length(to - from);
        // The ends have passed each other: nothing is left of the segment.
        if (glm::dot(to - from, Vec3f(light.wi)) <= 0.0F) return false;
        const FloatHit hit = meet(world_, from, (to - from) / length);
        ++self_.rays;
        if (hit.t < length && hit.primitive == point.primitive &&
            point.primitive < world_.scene.triangles.size())
            ++self_.hits;
        return hit.t < length;
    }

    /// A ray that leaves a triangle never meets it again; one that leaves a sphere outwards neither. One
    /// that goes into a sphere meets it at the end of the chord: much earlier is too early.
    void count(const FloatHit& hit, std::uint32_t left, const ref::EyeWalk& walk) const
    {
        ++self_.rays;
        if (hit.primitive != left) return;
        const auto triangles = static_cast<std::uint32_t>(world_.scene.triangles.size());
        double chord = 0.0;
        if (left >= triangles) {
            const scenes::Sphere& sphere = world_.scene.spheres[left - triangles];
            const ref::Vec3 n = glm::normalize(walk.from - sphere.center);
            chord = -2.0 * sphere.radius * glm::dot(n, walk.ray.direction);
        }
        if (chord <= 0.0 || static_cast<double>(hit.t) < 0.5 * chord) ++self_.hits;
    }

    const ref::World& world_;
    const ref::PathOptions& options_;
    Leave leave_;
    SelfHits& self_;
};

/// The mean of `trace` over the samples of each pixel of a region.
template <class Trace>
images::Image mean_of_samples(const ref::World& world, std::uint64_t seed, Region region,
                              std::uint32_t samples, const Trace& trace)
{
    images::Image image(region.width, region.height);
    for (int y = 0; y < region.height; ++y)
        for (int x = 0; x < region.width; ++x) {
            const auto pixel =
                static_cast<std::uint32_t>((region.top + y) * world.camera.width() + region.left + x);
            for (std::uint32_t sample = 0; sample < samples; ++sample)
                image.at(x, y) +=
                    trace(ref::SampleId{seed, pixel, sample}) / static_cast<double>(samples);
        }
    return image;
}

} // namespace

images::Image render_in_floats(const ref::World& world, const ref::PathOptions& options, Leave leave,
                               Region region, std::uint32_t samples, SelfHits& self)
{
    const FloatPath path(world, options, leave, self);
    return mean_of_samples(world, options.seed, region, samples,
                           [&](const ref::SampleId& id) { return path.trace(id); });
}

images::Image render_in_doubles(const ref::World& world, const ref::PathOptions& options, Region region,
                                std::uint32_t samples)
{
    std::vector<ref::Contribution> out;
    return mean_of_samples(world, options.seed, region, samples, [&](const ref::SampleId& id) {
        out.clear();
        ref::trace_path(world, options, id, out);
        ref::Rgb sum(0.0);
        for (const ref::Contribution& c : out) sum += c.weight * c.value;
        return sum;
    });
}

} // namespace figures
