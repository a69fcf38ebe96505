// The effect of a run of mirrors and glass on a narrow pencil of rays [Igehy 1999].

#include "tests/ref/transport/path_oracle.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <limits>

namespace transport_test {

namespace {

using Kind = Place::Kind;

/// A vector that depends on two parameters: its value and its two derivatives.
struct Pencil {
    Vec3 value, du, dv;
};
struct Scalar {
    double value, du, dv;
};

Scalar dot(const Pencil& a, const Pencil& b)
{
    return {glm::dot(a.value, b.value), glm::dot(a.du, b.value) + glm::dot(a.value, b.du),
            glm::dot(a.dv, b.value) + glm::dot(a.value, b.dv)};
}

Pencil plus(const Pencil& a, const Pencil& b)
{
    return {a.value + b.value, a.du + b.du, a.dv + b.dv};
}

Pencil times(const Scalar& s, const Pencil& a)
{
    return {s.value * a.value, s.du * a.value + s.value * a.du, s.dv * a.value + s.value * a.dv};
}

Pencil constant(const Vec3& v)
{
    return {v, Vec3(0.0), Vec3(0.0)};
}

} // namespace

/// d xi_a / d xi_b along the walk from a to b, where all vertices between them are delta. xi_a is the
/// direction at a (at infinity: the position on a plane across the light). xi_b is the position on the
/// surface of b (for a point: on a plane across the ray; at infinity: the direction). The values are
/// those of the path, so that no error accumulates; only the derivatives are propagated.
PathOracle::Jacobian PathOracle::jacobian(const Places& walk, std::size_t a, std::size_t b) const
{
    const Vec3 w = towards(walk[a], walk[a + 1]);
    const Vec3 across =
        glm::normalize(glm::cross(w, std::abs(w.x) < 0.6 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0)));
    const Vec3 other = glm::cross(w, across);
    const bool from_infinity = is_infinite(walk[a]);
    Pencil origin =
        from_infinity ? Pencil{walk[a + 1].position - w, across, other} : constant(walk[a].position);
    Pencil ray = from_infinity ? constant(w) : Pencil{w, across, other};
    double condition = 1.0;
    // Where rays meet again, as behind a lens, the area is a small difference of large numbers.
    const auto area = [&](const Pencil& end) {
        const double spanned = glm::length(glm::cross(end.du, end.dv));
        return Jacobian{1.0 / spanned, condition * glm::length(end.du) * glm::length(end.dv) / spanned};
    };

    for (std::size_t i = a + 1; i <= b; ++i) {
        if (is_infinite(walk[i])) return area(ray);
        // The rays meet the surface, to first order its tangent plane, where n . (p - x) = 0.
        const Vec3 n = walk[i].kind == Kind::surface ? normal(walk[i]) : ray.value;
        const Vec3 x = walk[i].position;
        const double t = glm::distance(x, origin.value);
        const double cosine = glm::dot(ray.value, n);
        const auto moved = [&](const Vec3& dp, const Vec3& dw) {
            const Vec3 free = dp + t * dw;
            return free - glm::dot(free, n) / cosine * ray.value;
        };
        const Pencil p = {x, moved(origin.du, ray.du), moved(origin.dv, ray.dv)};
        if (i == b) return area(p);

        const std::size_t triangles = scene_.triangles.size();
        Pencil m = constant(n);
        if (walk[i].index >= triangles) {
            const double r = scene_.spheres[walk[i].index - triangles].radius;
            m = {n, p.du / r, p.dv / r};
            condition *= 1.0 + 2.0 * (t + radius_) / (r * std::abs(cosine));
        }
        const Scalar c = dot(ray, m); // negative outside
        if (same_side(walk, i)) {
            ray = plus(ray, times({-2.0 * c.value, -2.0 * c.du, -2.0 * c.dv}, m));
        } else if (std::holds_alternative<scenes::Mirror>(
                       material(walk[i]))) { // so close to grazing that it is rounded
            return {0.0, std::numeric_limits<double>::infinity()};
        } else { // w' = e w + (sign c' - e c) n, where c' is the cosine on the other side
            const double ior = std::get<scenes::Glass>(material(walk[i])).ior;
            const double e = c.value < 0.0 ? 1.0 / ior : ior;
            const double sign = c.value < 0.0 ? -1.0 : 1.0;
            const double ct = std::sqrt(1.0 - e * e * (1.0 - c.value * c.value));
            const Scalar factor = {sign * ct - e * c.value,
                                   sign * e * e * c.value * c.du / ct - e * c.du,
                                   sign * e * e * c.value * c.dv / ct - e * c.dv};
            ray = plus(times({e, 0.0, 0.0}, ray), times(factor, m));
        }
        ray.value = towards(walk[i], walk[i + 1]);
        origin = p;
    }
    return {0.0, 0.0};
}

} // namespace transport_test
