// The family of strategies that samples a point of an emitter for every eye vertex. The fast path's
// point is not recorded: the reference samples one from the same numbers, and the two points may
// differ by the rounding of one sampling step.

#include "tests/cuda/path_judge/judged_paths.h"
#include "tests/cuda/path_judge/path_rounding.h"

#include "ref/transport/connect.h"
#include "ref/transport/visibility.h"

namespace path_judge_test {

using ref::Vec3;
using ref::Vertex;

std::optional<ExpectedContribution> PathJudge::next_event(std::size_t t, bool found) const
{
    const ref::World& world = setting_.world;
    const Vertex& last = z_.vertices[t - 1];
    if (!scatters(world, last)) return std::nullopt;
    const ref::Uniforms u =
        float_uniforms(setting_.id, ref::Event::next_event, static_cast<std::uint32_t>(t - 1));
    if (world.emitters.choose(u[0]) == nullptr) return std::nullopt;
    const ref::Emitter& emitter = *world.emitters.choose(u[0]);
    const Vec3& p = last.point.position;
    // The error of the light's position, and the angle by which it turns the connection.
    double turned = 0;
    double error = z_.alpha_error[t - 1] + in_product;
    double light_normal_error = 0;
    LineOfSight line{};
    switch (emitter.kind) {
    case ref::EmitterKind::triangle:
    case ref::EmitterKind::sphere: {
        const ref::SurfacePoint end = sample_surface(world.geometry, emitter, u[1], u[2]);
        const double off = drawn_point_error(world, end);
        const double distance = glm::length(end.position - p);
        turned = 1.1 * off / distance;
        light_normal_error = normal_error(world, end);
        const double c = glm::dot(end.normal, glm::normalize(p - end.position));
        const double c_error = turned + cosine_error + light_normal_error;
        if (turned > 0.01) throw Undecided("a light too close to tell its direction");
        if (std::abs(c) <= c_error) {
            const ref::Rgb& emitted =
                std::get<scenes::Emission>(world.scene.materials[end.material]).radiance;
            throw Grazing{scattered_at_most(last) * emitted * (2 * c_error / (distance * distance)) *
                          (emitter.area / emitter.probability)};
        }
        if (c < 0) return std::nullopt;
        error += 2 * turned + c_error / c;
        const Range clearance = clearance_of(world, end.primitive, end.position, end.normal);
        const double for_length = 24 * roundoff * distance;
        line = line_from(last.point, end.position - p);
        line.to = end.position + (clearance.low + for_length) * end.normal;
        // An error of the normal turns the offset of the end: this is of second order, as the length
        // of the offset is.
        line.to_slack = 1.01 * (clearance.high - clearance.low + off) + 0.01 * for_length;
        line.end = end.primitive;
        break;
    }
    case ref::EmitterKind::point:
    case ref::EmitterKind::spot: {
        const Vec3& position = emitter.kind == ref::EmitterKind::point
                                   ? world.scene.point_lights[emitter.index].position
                                   : world.scene.spot_lights[emitter.index].position;
        line = line_from(last.point, position - p);
        line.to = position;
        line.to_slack = end_slack(world, position);
        if (emitter.kind == ref::EmitterKind::point) break;
        const auto& spot = world.scene.spot_lights[emitter.index];
        const double c = glm::dot(spot.direction, glm::normalize(p - position));
        const double c_error = spot_cosine_error(c);
        if (std::abs(c - spot.cos_cutoff) <= c_error) throw Undecided("the rim of a spot");
        if (spot.exponent > 0 && std::abs(c) <= 20 * c_error) throw Undecided("the rim of a spot");
        error += spot_falloff_error(spot.exponent, std::abs(c), c_error);
        break;
    }
    case ref::EmitterKind::directional:
    case ref::EmitterKind::environment: {
        turned = emitter.kind == ref::EmitterKind::environment ? 16 * roundoff : 0;
        const Vec3 w = emitter.kind == ref::EmitterKind::environment
                           ? ref::sample_sphere(u[1], u[2])
                           : -world.scene.directional_lights[emitter.index].direction;
        line = line_from(last.point, w);
        line.to = w;
        line.to_slack = turned;
        line.to_infinity = true;
        break;
    }
    }
    const auto light = sample_incident(world.emitters, p, u);
    if (!light) return std::nullopt;
    const Vertex y0 = light->infinite ? infinity_vertex(*light->emitter, light->wi, ref::Rgb(1))
                      : light->delta  ? source_vertex(*light->emitter, light->end.position, ref::Rgb(1))
                                      : surface_vertex(world, light->end, ref::Rgb(1));
    error +=
        end_error(z_, t - 1, light->wi, turned, scattered_at_most(last) * light->radiance / light->pdf);
    const ref::Rgb f = evaluate_bsdf(world, y0, last, z_.vertices[t - 2]);
    const ref::Rgb value = last.alpha * f * cosine(last, light->wi) * light->radiance / light->pdf;
    if (value == ref::Rgb(0)) return std::nullopt;
    const bool seen = visible(world.geometry, last.point, *light);
    if (seen != found) explain_sight(world, line, found);
    if (!seen) return std::nullopt;

    ExpectedContribution expected{value, error, 0, 0};
    JoinedPath x = join(0, t);
    x.vertices.insert(x.vertices.begin(), &y0);
    x.turned.insert(x.turned.begin(), turned);
    x.normal_error = light_normal_error;
    weigh(x, 1, expected);
    return expected;
}

} // namespace path_judge_test
