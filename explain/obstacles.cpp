// Why a strategy contributes nothing: the conditions of ref/transport/connect.cpp, one by one.

#include "explain/parts.h"
#include "ref/transport/connect.h"

#include <stdexcept>

namespace explain {

namespace {

using Kind = ref::Vertex::Kind;

std::string name(char walk, int vertex)
{
    return std::string(1, walk) + "_" + std::to_string(vertex);
}

void set(Strategy& strategy, Obstacle obstacle, std::string at = "")
{
    strategy.obstacle = obstacle;
    strategy.at = std::move(at);
}

/// Sets the obstacle of a vertex that cannot be joined to another one. Returns whether it is one.
bool cannot_be_joined(const Setting& setting, const ref::Vertex& vertex, const std::string& at,
                      Strategy& strategy)
{
    if (scatters(setting.world, vertex)) return false;
    const bool emits = vertex.kind == Kind::surface &&
                       std::holds_alternative<scenes::Emission>(material_at(setting.world, vertex));
    set(strategy,
        vertex.kind != Kind::surface ? Obstacle::at_infinity
        : emits                      ? Obstacle::no_scattering
                                     : Obstacle::delta_vertex,
        at);
    return true;
}

/// Sets the obstacle of a BSDF that is 0 at `vertex` for light between a and b. Returns whether it is.
bool does_not_scatter(const Setting& setting, const ref::Vertex& a, const ref::Vertex& vertex,
                      const ref::Vertex& b, const std::string& at, Strategy& strategy)
{
    if (evaluate_bsdf(setting.world, a, vertex, b) != Rgb(0.0)) return false;
    const Vec3& normal = vertex.point.normal;
    const bool sides =
        glm::dot(normal, direction(vertex, a)) * glm::dot(normal, direction(vertex, b)) <= 0.0;
    set(strategy, sides ? Obstacle::other_side : Obstacle::black, at);
    return true;
}

/// Sets the obstacle of a line that is not free. Returns whether it is not.
bool is_blocked(const Setting& setting, const ref::LineOfSight& line, Strategy& strategy)
{
    if (line.test == ref::LineOfSight::Test::in_plane) {
        set(strategy, Obstacle::in_plane);
        return true;
    }
    const auto hit = intersect(setting.world.geometry, line.ray);
    if (!hit) return false;
    set(strategy, Obstacle::blocked);
    strategy.blocker = hit->primitive;
    return true;
}

/// All conditions hold: then only the product of all factors can be 0.
void expect_vanishing(Strategy& strategy, const Rgb& product)
{
    if (product != Rgb(0.0))
        throw std::logic_error("explain: no reason why the strategy (" + std::to_string(strategy.s) +
                               ", " + std::to_string(strategy.t) + ") contributes nothing");
    set(strategy, Obstacle::vanishes);
}

/// The point that sample_incident rejects: it has no light for `z`, or no density.
void find_lost_light(const Setting& setting, const ref::Vertex& z, const ref::Uniforms& u,
                     Strategy& strategy)
{
    const ref::World& world = setting.world;
    const ref::Emitter* emitter = world.emitters.choose(u[0]);
    if (emitter == nullptr) return set(strategy, Obstacle::no_emitter);
    if (!ref::is_surface(emitter->kind)) return set(strategy, Obstacle::dark_side, "y_0");
    const ref::SurfacePoint end = sample_surface(world.geometry, *emitter, u[1], u[2]);
    const Vec3 wi = glm::normalize(end.position - z.point.position);
    const bool dark = emitted_radiance(world.scene, end, -wi) == Rgb(0.0);
    set(strategy, dark ? Obstacle::dark_side : Obstacle::edge_on, "y_0");
    strategy.path.insert(strategy.path.begin(), surface_vertex(world, end, Rgb(1.0)));
}

} // namespace

void find_obstacle_of_emission_hit(const Setting& setting, Strategy& strategy)
{
    const ref::Vertex& last = strategy.path[0];
    const std::string at = name('z', strategy.t - 1);
    if (last.emitter == nullptr) return set(strategy, Obstacle::not_an_emitter, at);
    const Rgb light = emitted(setting.world, last, strategy.path[1]);
    if (light == Rgb(0.0)) return set(strategy, Obstacle::dark_side, at);
    expect_vanishing(strategy, last.alpha * light);
}

void find_obstacle_of_next_event(const Setting& setting, std::span<const ref::Vertex> z,
                                 Strategy& strategy)
{
    const ref::Vertex& last = z.back();
    const std::string at = name('z', strategy.t - 1);
    if (cannot_be_joined(setting, last, at, strategy)) return;
    const ref::Uniforms u =
        uniforms(setting.id, ref::Event::next_event, static_cast<std::uint32_t>(strategy.t - 1));
    const auto light = sample_incident(setting.world.emitters, last.point.position, u);
    if (!light) return find_lost_light(setting, last, u, strategy);
    const ref::Vertex y0 = light_vertex(setting.world, *light);
    if (does_not_scatter(setting, y0, last, z[z.size() - 2], at, strategy)) return;
    if (is_blocked(setting, line_of_sight(setting.world.geometry, last.point, *light), strategy)) return;
    if (is_covered(setting.world.geometry, *light)) return set(strategy, Obstacle::covered, "y_0");
    expect_vanishing(strategy, last.alpha * evaluate_bsdf(setting.world, y0, last, z[z.size() - 2]) *
                                   cosine(last, light->wi) * light->radiance / light->pdf);
}

void find_obstacle_of_light_image(const Setting& setting, std::span<const ref::Vertex> y,
                                  const ref::Vertex& eye, Strategy& strategy)
{
    const ref::World& world = setting.world;
    const ref::Vertex& last = y.back();
    const bool first = y.size() == 1;
    const std::string at = name('y', strategy.s - 1);
    if (first && !can_be_hit(*last.emitter)) return set(strategy, Obstacle::delta_emitter, at);
    if (!first && cannot_be_joined(setting, last, at, strategy)) return;
    const Vec3 w = direction(eye, last);
    if (!world.camera.project(w)) return set(strategy, Obstacle::outside_picture, at);
    if (first && emitted(world, last, eye) == Rgb(0.0)) return set(strategy, Obstacle::dark_side, at);
    if (!first && does_not_scatter(setting, y[y.size() - 2], last, eye, at, strategy)) return;
    if (is_blocked(setting, line_to_eye(world, last), strategy)) return;
    if (first && last.kind == Kind::surface && !sees_first(world.geometry, last.point, -w))
        return set(strategy, Obstacle::covered, at);
    const Rgb scattered =
        first ? emitted(world, last, eye) : evaluate_bsdf(world, y[y.size() - 2], last, eye);
    expect_vanishing(strategy, last.alpha * scattered * geometric_term(last, eye) *
                                   world.camera.cosine(w) * world.camera.importance(w));
}

void find_obstacle_of_inner_connection(const Setting& setting, std::span<const ref::Vertex> y,
                                       std::span<const ref::Vertex> z, Strategy& strategy)
{
    const ref::World& world = setting.world;
    const ref::Vertex& a = y.back();
    const ref::Vertex& b = z.back();
    const std::string at_y = name('y', strategy.s - 1);
    const std::string at_z = name('z', strategy.t - 1);
    if (cannot_be_joined(setting, a, at_y, strategy) || cannot_be_joined(setting, b, at_z, strategy))
        return;
    if (does_not_scatter(setting, y[y.size() - 2], a, b, at_y, strategy) ||
        does_not_scatter(setting, a, b, z[z.size() - 2], at_z, strategy))
        return;
    const Rgb f =
        evaluate_bsdf(world, y[y.size() - 2], a, b) * evaluate_bsdf(world, a, b, z[z.size() - 2]);
    if (f == Rgb(0.0)) return set(strategy, Obstacle::black);
    if (is_blocked(setting, line_of_sight(a.point, b.point), strategy)) return;
    expect_vanishing(strategy, a.alpha * f * geometric_term(a, b) * b.alpha);
}

} // namespace explain
