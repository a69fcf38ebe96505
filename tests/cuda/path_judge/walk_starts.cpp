// The start of walks, and the conditions that their vertices must meet.

#include "tests/cuda/path_judge/followed_walk.h"
#include "tests/cuda/path_judge/path_rounding.h"
#include "tests/cuda/path_judge/sight.h"

#include "ref/transport/emission.h"
#include "scenes/contacts.h"

#include <algorithm>

namespace path_judge_test {

using ref::Vec3;

void require(bool condition, const char* otherwise)
{
    if (!condition) throw Disagreement(otherwise);
}

ref::Uniforms float_uniforms(const ref::SampleId& id, ref::Event event, std::uint32_t j)
{
    ref::Uniforms u = uniforms(id, event, j);
    for (double& x : u) x = std::floor(x * 0x1p24) * 0x1p-24;
    return u;
}

ref::SurfacePoint surface_of(const ref::World& world, const fast::SurfacePoint& point)
{
    ref::SurfacePoint result{};
    result.position = Vec3(point.position);
    result.normal = Vec3(point.normal);
    // So that leave_surface moves as far as the fast path does: |n| times this is the clearance.
    result.error = static_cast<double>(point.clearance) * glm::abs(result.normal);
    result.primitive = point.primitive;
    result.material = scenes::material_of(world.scene, point.primitive);
    return result;
}

double normal_error(const ref::World& world, const ref::SurfacePoint& point)
{
    const std::size_t triangles = world.scene.triangles.size();
    if (point.primitive < triangles)
        return triangle_normal_error(world.scene.triangles[point.primitive].vertices);
    const double radius = world.scene.spheres[point.primitive - triangles].radius;
    return (8 + 2 * glm::length(point.position) / radius) * roundoff;
}

void require_on_surface(const ref::World& world, const fast::SurfacePoint& point)
{
    const Vec3 p(point.position);
    const std::size_t triangles = world.scene.triangles.size();
    Vec3 normal;
    double off = 0;
    double bound = 0;
    if (point.primitive < triangles) {
        const auto& v = world.scene.triangles[point.primitive].vertices;
        normal = glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
        off = glm::dot(normal, p - v[0]);
        bound = triangle_point_error(v, p);
    } else {
        const auto& sphere = world.scene.spheres[point.primitive - triangles];
        normal = glm::normalize(p - sphere.center);
        off = glm::length(p - sphere.center) - sphere.radius;
        bound = sphere_point_error(sphere.radius, p);
    }
    require(std::abs(off) <= bound, "a vertex is off its surface");
    require(glm::length(Vec3(point.normal) - normal) <= normal_error(world, surface_of(world, point)),
            "a normal is wrong");
    const Range clearance = clearance_of(world, point.primitive, p, Vec3(point.normal));
    require(point.clearance >= clearance.low && point.clearance <= clearance.high,
            "a clearance is wrong");
}

Range clearance_of(const ref::World& world, std::uint32_t primitive, const Vec3& p, const Vec3& normal)
{
    const Vec3 n = glm::abs(normal);
    const double position = 2 * glm::dot(n, glm::abs(p));
    const std::size_t triangles = world.scene.triangles.size();
    if (primitive >= triangles) {
        const double clearance = position + 56 * world.scene.spheres[primitive - triangles].radius;
        return {0.999 * roundoff * clearance, 1.001 * roundoff * clearance};
    }
    const auto& v = world.scene.triangles[primitive].vertices;
    const double edges = 4 * glm::dot(n, glm::max(glm::abs(v[1] - v[0]), glm::abs(v[2] - v[0])));
    const Vec3 own = glm::max(glm::max(v[0], v[1]), v[2]) - glm::min(glm::min(v[0], v[1]), v[2]);
    const auto of_extent = [&](const Vec3& a) {
        return glm::dot(n, 2.0 * a) + 6 * std::max({a.x, a.y, a.z}) * (n.x + n.y + n.z);
    };
    const double least = position + edges + of_extent(own);
    const double most = position + edges + of_extent(world.geometry.extent(primitive, own));
    return {0.999 * roundoff * least, 1.001 * roundoff * most};
}

double drawn_point_error(const ref::World& world, const ref::SurfacePoint& drawn)
{
    const std::size_t triangles = world.scene.triangles.size();
    if (drawn.primitive < triangles) {
        const auto& v = world.scene.triangles[drawn.primitive].vertices;
        return triangle_point_error(v, drawn.position) + moved_off_edges(v, drawn.position);
    }
    // The direction from the centre, as on the unit sphere (path_rounding.h, 3).
    return (13 + 8) * roundoff * world.scene.spheres[drawn.primitive - triangles].radius +
           2 * roundoff * glm::length(drawn.position);
}

namespace {

/// The y_0 on a surface: it must be the reference's point, up to rounding.
void require_drawn(const ref::World& world, const fast::SurfacePoint& point,
                   const ref::SurfacePoint& drawn)
{
    require(point.primitive == drawn.primitive, "a light walk starts on a wrong surface");
    require_on_surface(world, point);
    const double error = drawn_point_error(world, drawn);
    require(glm::length(Vec3(point.position) - drawn.position) <= error,
            "a light walk starts at a wrong point");
}

/// Whether another surface is so close to the emitter's point, and beside it, that the fast path may
/// count the point as covered (coincident_arrays.cpp); the reference lets light into the gap.
bool has_near_surface(const ref::World& world, const ref::SurfacePoint& point)
{
    const double near = 54 * roundoff * world.geometry.diagonal();
    return std::ranges::any_of(scenes::surfaces_near(world.scene, point.position, near),
                               [&](const scenes::NearSurface& surface) {
                                   return surface.primitive != point.primitive && surface.side != 0;
                               });
}

NextStep first_of_light(const Setting& setting, const fast::SampledEmission& emission,
                        const ref::SampledEmission& drawn, const ref::Uniforms& direction)
{
    const ref::World& world = setting.world;
    const ref::Emitter& emitter = *drawn.y0.emitter;
    // Factors: emission, area, probability, disc or solid angle; and their products.
    NextStep step{drawn.ray.origin, 0, drawn.ray.direction, direction_error, drawn.alpha, 16 * roundoff};
    switch (emitter.kind) {
    case ref::EmitterKind::triangle:
    case ref::EmitterKind::sphere: {
        require_drawn(world, emission.end, drawn.y0.point);
        // Around the fast path's normal.
        const ref::SurfacePoint point = surface_of(world, emission.end);
        const ref::Frame frame(point.normal);
        step.direction =
            glm::normalize(frame.to_world(ref::sample_cosine_hemisphere(direction[0], direction[1])));
        step.origin = leave_surface(point, point.normal);
        step.slack = 4 * roundoff * glm::length(point.position);
        break;
    }
    case ref::EmitterKind::point:
        step.slack = end_slack(world, step.origin);
        break;
    case ref::EmitterKind::spot: {
        step.slack = end_slack(world, step.origin);
        const auto& light = world.scene.spot_lights[emitter.index];
        const double cosine = glm::dot(light.direction, drawn.ray.direction);
        const double error = drawn_spot_cosine_error;
        if (cosine - light.cos_cutoff <= error || (light.exponent > 0 && std::abs(cosine) <= 20 * error))
            throw Undecided("the rim of a spot");
        step.alpha_error += spot_falloff_error(light.exponent, std::abs(cosine), error);
        break;
    }
    case ref::EmitterKind::directional:
    case ref::EmitterKind::environment: {
        const Vec3 towards(emission.towards);
        require(glm::length(towards - drawn.y0.towards) <= 16 * roundoff, "light has a wrong direction");
        const ref::Frame frame(towards);
        const glm::dvec2 disc = ref::sample_disc(direction[0], direction[1]);
        const double radius = world.emitters.radius();
        step.origin = radius * (disc.x * frame.x + disc.y * frame.y + 2.0 * towards);
        step.slack = 48 * roundoff * radius; // 36 as for a direction; three times as long only along it
        step.direction = -towards;
        step.error = 0;
        break;
    }
    }
    return step;
}

} // namespace

FollowedWalk followed_light_walk(const Setting& setting, const RecordedSample& sample,
                                 std::size_t most_vertices)
{
    const ref::Uniforms position = float_uniforms(setting.id, ref::Event::emission_position);
    const ref::Uniforms direction = float_uniforms(setting.id, ref::Event::emission_direction);
    const auto drawn = sample_emission(setting.world, position, direction);
    require(drawn.has_value() == sample.emission.has_value(), "a light walk exists in one wing only");
    if (!drawn) return {};
    const ref::Emitter& chosen = *setting.world.emitters.choose(position[0]);
    require(&setting.world.emitters.all()[sample.emission->emitter] == &chosen,
            "another emitter is chosen");

    const NextStep step = first_of_light(setting, *sample.emission, *drawn, direction);
    const fast::Vec3 origin = sample.emission->ray.origin;
    require(glm::length(Vec3(origin) - step.origin) <= step.slack, "a light walk has a wrong start");
    FollowedWalk walk{{drawn->y0}, {0}, {12 * roundoff}};
    ref::Vertex& y0 = walk.vertices[0];
    if (y0.kind == ref::Vertex::Kind::surface)
        y0.point = surface_of(setting.world, sample.emission->end);
    if (y0.kind == ref::Vertex::Kind::infinity) y0.towards = Vec3(sample.emission->towards);
    const bool is_surface = y0.kind == ref::Vertex::Kind::surface;
    if (is_surface && sample.light.vertices.empty() && !sample.light.missed &&
        has_near_surface(setting.world, y0.point))
        throw Undecided("light in a gap");
    NextStep from_there = step;
    from_there.origin = Vec3(origin);
    from_there.slack = 0;
    follow(setting, ref::Transport::power, sample.light, most_vertices, from_there, walk);
    return walk;
}

FollowedWalk followed_eye_walk(const Setting& setting, const RecordedSample& sample)
{
    const ref::Camera& camera = setting.world.camera;
    const auto width = static_cast<std::uint32_t>(camera.width());
    const ref::Uniforms u = float_uniforms(setting.id, ref::Event::camera);
    // The fast path's start. end_contacts_test.cpp tests that it is on the right side of every
    // surface.
    const ref::Ray ray = camera.ray({setting.id.pixel % width + u[0], setting.id.pixel / width + u[1]});
    const scenes::Camera& source = setting.world.scene.camera.value();
    const int across = source.fov_axis == scenes::FovAxis::horizontal ? camera.width() : camera.height();
    const double extent = 2 * std::tan(source.fov / 2) * (camera.width() + camera.height()) / across;
    FollowedWalk walk{{eye_vertex(setting.world)}, {0}, {0}};
    follow(setting, ref::Transport::radiance, sample.eye,
           static_cast<std::size_t>(setting.options.max_edges) + 1,
           {ray.origin, end_slack(setting.world, ray.origin), ray.direction,
            camera_direction_error(extent), ref::Rgb(1), 0},
           walk);
    return walk;
}

} // namespace path_judge_test
