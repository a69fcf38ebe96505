// The four families of strategies on the fast path's vertices. A value is a product of factors. Its
// error is the sum of the errors of the weights of both walks, of cosines and of squared distances,
// and 16 roundings.

#include "tests/cuda/path_judge/judged_paths.h"
#include "tests/cuda/path_judge/path_rounding.h"

#include "ref/transport/connect.h"
#include "ref/transport/emission.h"
#include "ref/transport/visibility.h"

namespace path_judge_test {

using ref::Vec3;
using ref::Vertex;

double PathJudge::end_error(const FollowedWalk& walk, std::size_t i, const Vec3& w, double turned,
                            const ref::Rgb& at_most) const
{
    const Vertex& vertex = walk.vertices[i];
    const double c = cosine(vertex, w);
    const double error = turned + cosine_error;
    if (c <= error) throw Grazing{at_most * (c + error)};
    if (i > 0) { // the direction of the walk decides the side of the surface
        const double came = cosine(vertex, direction(vertex, walk.vertices[i - 1]));
        if (came <= walk.turned[i] + cosine_error) throw Undecided("the side that a walk comes from");
    }
    return error / c;
}

ref::Rgb PathJudge::scattered_at_most(const Vertex& vertex) const
{
    return vertex.alpha * std::get<scenes::Lambertian>(material_at(setting_.world, vertex)).albedo *
           ref::inverse_pi;
}

LineOfSight PathJudge::line_from(const ref::SurfacePoint& point, const Vec3& w) const
{
    const Vec3 from = leave_surface(point, w);
    LineOfSight line{from, 4 * roundoff * glm::length(from), Vec3(0), 0};
    line.start = point.primitive;
    return line;
}

std::optional<ExpectedContribution> PathJudge::emission_hit(std::size_t t) const
{
    const std::span<const Vertex> z(z_.vertices.data(), t);
    const Vertex& last = z.back();
    if (last.emitter == nullptr) return std::nullopt;
    const Vec3 back = direction(last, z[t - 2]);
    if (cosine(last, back) <= z_.turned[t - 1] + cosine_error)
        throw Undecided("a connection in the plane of a surface");
    const ref::Rgb value = last.alpha * emitted(setting_.world, last, z[t - 2]);
    if (value == ref::Rgb(0)) return std::nullopt;
    ExpectedContribution expected{value, z_.alpha_error[t - 1] + in_product, 0, 0};
    weigh(join(0, t), 0, expected);
    return expected;
}

std::optional<ExpectedContribution> PathJudge::light_image(std::size_t s, bool found) const
{
    const ref::World& world = setting_.world;
    const Vertex& last = y_.vertices[s - 1];
    if (s == 1 ? !ref::can_be_hit(*last.emitter) : !scatters(world, last)) return std::nullopt;
    const Vertex& eye = z_.vertices[0];
    const Vec3 w = direction(eye, last);
    const double ahead = world.camera.cosine(w);
    if (std::abs(ahead) <= cosine_error) throw Undecided("the plane of the eye");
    if (ahead < 0) return std::nullopt;
    ExpectedContribution expected{ref::Rgb(0), y_.alpha_error[s - 1] + in_product, 0, 0};
    expected.value_error += 3 * cosine_error / ahead;

    // The film point. Its error is that of two cosines over that of a third, and that of the scaling.
    const scenes::Camera& source = world.scene.camera.value();
    const double width = world.camera.width();
    const double height = world.camera.height();
    const double across = source.fov_axis == scenes::FovAxis::horizontal ? width : height;
    const double scale = across / (2 * std::tan(source.fov / 2)) / ahead;
    const double right = scale * glm::dot(w, source.right);
    const double up = scale * glm::dot(w, source.up);
    expected.x = width / 2 + right;
    expected.y = height / 2 - up;
    expected.film_error = cosine_error * scale +
                          (cosine_error / ahead + 4 * roundoff) * (std::abs(right) + std::abs(up)) +
                          2 * roundoff * (width + height);
    const double inside = std::min({expected.x, width - expected.x, expected.y, height - expected.y});
    if (std::abs(inside) <= expected.film_error) throw Undecided("the border of the film");
    if (inside < 0) return std::nullopt;

    const double measured = ahead * world.camera.importance(w);
    if (last.kind == Vertex::Kind::surface) {
        const ref::Rgb sent =
            s == 1 ? last.alpha * std::get<scenes::Emission>(material_at(world, last)).radiance
                   : scattered_at_most(last);
        const Vec3 d = last.point.position - eye.point.position;
        expected.value_error += end_error(y_, s - 1, -w, 0, sent * measured / glm::dot(d, d));
    }
    const ref::Rgb scattered =
        s == 1 ? emitted(world, last, eye) : evaluate_bsdf(world, y_.vertices[s - 2], last, eye);
    expected.value =
        last.alpha * scattered * geometric_term(last, eye) * ahead * world.camera.importance(w);
    if (expected.value == ref::Rgb(0)) return std::nullopt;
    LineOfSight line{eye.point.position, end_slack(world, eye.point.position), w, 8 * roundoff, true};
    bool seen = false;
    if (last.kind == Vertex::Kind::surface) {
        line = line_from(last.point, -w);
        line.to = eye.point.position;
        line.to_slack = end_slack(world, eye.point.position);
        seen = visible(world.geometry, last.point, eye.point.position, world.eye_on);
    } else {
        seen = !occluded(world.geometry, {eye.point.position, w, ref::Ray{}.t_max, world.eye_on});
    }
    if (seen != found) explain_sight(world, line, found);
    if (!seen) return std::nullopt;
    weigh(join(s, 1), s, expected);
    return expected;
}

std::optional<ExpectedContribution> PathJudge::inner_connection(std::size_t s, std::size_t t,
                                                                bool found) const
{
    const ref::World& world = setting_.world;
    const Vertex& y = y_.vertices[s - 1];
    const Vertex& z = z_.vertices[t - 1];
    if (!scatters(world, y) || !scatters(world, z)) return std::nullopt;
    const Vec3 w = direction(z, y);
    ExpectedContribution expected{ref::Rgb(0),
                                  y_.alpha_error[s - 1] + z_.alpha_error[t - 1] + in_product, 0, 0};
    const Vec3 d = y.point.position - z.point.position;
    const ref::Rgb at_most = scattered_at_most(y) * scattered_at_most(z) / glm::dot(d, d);
    expected.value_error += end_error(y_, s - 1, w, 0, at_most) + end_error(z_, t - 1, w, 0, at_most);
    expected.value = y.alpha * evaluate_bsdf(world, y_.vertices[s - 2], y, z) *
                     evaluate_bsdf(world, y, z, z_.vertices[t - 2]) * geometric_term(y, z) * z.alpha;
    if (expected.value == ref::Rgb(0)) return std::nullopt;
    const bool seen = visible(world.geometry, y.point, z.point);
    if (seen != found) {
        LineOfSight line = line_from(z.point, w);
        line.to =
            leave_surface(y.point, -w) +
            std::copysign(24 * roundoff * glm::length(d), -glm::dot(w, y.point.normal)) * y.point.normal;
        line.to_slack = 4 * roundoff * glm::length(line.to);
        line.end = y.point.primitive;
        explain_sight(world, line, found);
    }
    if (!seen) return std::nullopt;
    weigh(join(s, t), s, expected);
    return expected;
}

} // namespace path_judge_test
