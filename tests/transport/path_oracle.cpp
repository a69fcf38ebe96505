#include "tests/transport/path_oracle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tests {

namespace {

constexpr double pi = std::numbers::pi;
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

bool infinite(const Place& place)
{
    return place.kind == Kind::directional || place.kind == Kind::environment;
}

/// The unit direction from a to b.
Vec3 towards(const Place& a, const Place& b)
{
    if (infinite(b)) return b.position;
    if (infinite(a)) return -a.position;
    return glm::normalize(b.position - a.position);
}

double mean(const Rgb& v)
{
    return (v.x + v.y + v.z) / 3.0;
}

double largest(const Rgb& v)
{
    return std::max({v.x, v.y, v.z});
}

} // namespace

PathOracle::PathOracle(const scenes::Scene& scene, int width, int height, bool roulette)
    : scene_(scene), width_(width), height_(height), roulette_(roulette)
{
    const double tan_half = std::tan(scene.camera->fov / 2.0);
    const bool horizontal = scene.camera->fov_axis == scenes::FovAxis::horizontal;
    tan_x_ = horizontal ? tan_half : tan_half * width / height;
    tan_y_ = horizontal ? tan_half * height / width : tan_half;

    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    const auto include = [&](const Vec3& p) {
        for (int i = 0; i < 3; ++i) {
            low[i] = std::min(low[i], p[i]);
            high[i] = std::max(high[i], p[i]);
        }
    };
    for (const auto& triangle : scene.triangles)
        for (const Vec3& v : triangle.vertices) include(v);
    for (const auto& sphere : scene.spheres) {
        include(sphere.center + Vec3(sphere.radius));
        include(sphere.center - Vec3(sphere.radius));
    }
    const bool empty = scenes::primitive_count(scene) == 0;
    radius_ = empty ? 0.0 : glm::distance(low, high) / 2.0;

    const auto emission = [&](std::uint32_t m) {
        const auto* e = std::get_if<scenes::Emission>(&scene.materials[m]);
        return e != nullptr ? mean(e->radiance) : 0.0;
    };
    for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
        const auto& v = scene.triangles[i].vertices;
        const double area = 0.5 * glm::length(glm::cross(v[2] - v[1], v[0] - v[1]));
        shares_.push_back({Kind::surface, i, area, pi * area * emission(scene.triangles[i].material)});
    }
    for (std::uint32_t i = 0; i < scene.spheres.size(); ++i) {
        const double area = 4.0 * pi * std::pow(scene.spheres[i].radius, 2);
        shares_.push_back({Kind::surface, static_cast<std::uint32_t>(scene.triangles.size()) + i, area,
                           pi * area * emission(scene.spheres[i].material)});
    }
    for (std::uint32_t i = 0; i < scene.point_lights.size(); ++i)
        shares_.push_back({Kind::point, i, 0.0, 4.0 * pi * mean(scene.point_lights[i].intensity)});
    for (std::uint32_t i = 0; i < scene.spot_lights.size(); ++i) {
        const auto& spot = scene.spot_lights[i]; // by the integral of the intensity over the cone
        const double c = spot.exponent > 0.0 ? std::max(spot.cos_cutoff, 0.0) : spot.cos_cutoff;
        const double n = spot.exponent + 1.0;
        shares_.push_back(
            {Kind::spot, i, 0.0, mean(spot.intensity) * 2.0 * pi * (1.0 - std::pow(c, n)) / n});
    }
    for (std::uint32_t i = 0; i < scene.directional_lights.size(); ++i)
        shares_.push_back({Kind::directional, i, 0.0,
                           pi * radius_ * radius_ * mean(scene.directional_lights[i].irradiance)});
    if (scene.environment)
        shares_.push_back(
            {Kind::environment, 0, 0.0, 4.0 * std::pow(pi * radius_, 2) * mean(*scene.environment)});

    double total = 0.0;
    for (const Share& share : shares_) total += share.probability;
    for (Share& share : shares_) share.probability = total > 0.0 ? share.probability / total : 0.0;
}

const scenes::Material& PathOracle::material(const Place& place) const
{
    return scene_.materials[scenes::material_of(scene_, place.index)];
}

bool PathOracle::scatters(const Place& place) const
{
    return place.kind == Kind::surface && std::holds_alternative<scenes::Lambertian>(material(place));
}

bool PathOracle::is_delta(const Place& place) const
{
    return place.kind == Kind::surface && (std::holds_alternative<scenes::Mirror>(material(place)) ||
                                           std::holds_alternative<scenes::Glass>(material(place)));
}

Vec3 PathOracle::normal(const Place& place) const
{
    const std::size_t triangles = scene_.triangles.size();
    if (place.index >= triangles)
        return glm::normalize(place.position - scene_.spheres[place.index - triangles].center);
    const auto& v = scene_.triangles[place.index].vertices;
    return glm::normalize(glm::cross(v[1] - v[0], v[2] - v[0]));
}

Share PathOracle::share_of(const Place& place) const
{
    for (const Share& share : shares_)
        if (share.kind == place.kind && share.index == place.index) return share;
    return {place.kind, place.index, 0.0, 0.0};
}

double PathOracle::survival(const Place& place, std::size_t bounce) const
{
    if (!roulette_ || bounce < 5) return 1.0; // the first four bounces are free
    double albedo = 0.0;
    if (const auto* l = std::get_if<scenes::Lambertian>(&material(place))) albedo = largest(l->albedo);
    if (const auto* m = std::get_if<scenes::Mirror>(&material(place))) albedo = largest(m->reflectance);
    if (const auto* g = std::get_if<scenes::Glass>(&material(place)))
        albedo = std::max(largest(g->reflectance), largest(g->transmittance));
    return std::min(albedo, 0.95);
}

Rgb PathOracle::emitted(const Place& x0, const Vec3& w) const
{
    switch (x0.kind) {
    case Kind::eye:
        break;
    case Kind::surface: {
        const auto* emission = std::get_if<scenes::Emission>(&material(x0));
        const bool front = glm::dot(normal(x0), w) > 0.0;
        return emission != nullptr && front ? emission->radiance : Rgb(0.0);
    }
    case Kind::point:
        return scene_.point_lights[x0.index].intensity;
    case Kind::spot: {
        const auto& spot = scene_.spot_lights[x0.index];
        const double c = glm::dot(spot.direction, w);
        if (c <= spot.cos_cutoff || (c <= 0.0 && spot.exponent > 0.0)) return Rgb(0.0);
        return spot.intensity * (spot.exponent > 0.0 ? std::pow(c, spot.exponent) : 1.0);
    }
    case Kind::directional:
        return scene_.directional_lights[x0.index].irradiance;
    case Kind::environment:
        return *scene_.environment;
    }
    return Rgb(0.0);
}

/// Of the light walk's first direction w, per solid angle; from infinity, of its place on the disc.
double PathOracle::pdf_start(const Place& x0, const Vec3& w) const
{
    switch (x0.kind) {
    case Kind::eye:
        return 0.0;
    case Kind::surface:
        return std::max(0.0, glm::dot(normal(x0), w)) / pi;
    case Kind::point:
        return 1.0 / (4.0 * pi);
    case Kind::spot: {
        const auto& spot = scene_.spot_lights[x0.index];
        const bool inside = glm::dot(spot.direction, w) > spot.cos_cutoff;
        return inside ? 1.0 / (2.0 * pi * (1.0 - spot.cos_cutoff)) : 0.0;
    }
    case Kind::directional:
    case Kind::environment:
        break;
    }
    return 1.0 / (pi * radius_ * radius_);
}

double PathOracle::eye_cosine(const Vec3& w) const
{
    return -glm::dot(scene_.camera->backward, w);
}

/// The Fresnel reflectance at walk[i] for light that comes from walk[i-1] (or goes there).
double PathOracle::fresnel_at(const Places& walk, std::size_t i) const
{
    const double ior = std::get<scenes::Glass>(material(walk[i])).ior;
    const double cosine = glm::dot(normal(walk[i]), towards(walk[i], walk[i - 1]));
    const double n = cosine > 0.0 ? ior : 1.0 / ior; // of the far side, relative to this one
    const double ci = std::abs(cosine);
    const double ct2 = 1.0 - (1.0 - ci * ci) / (n * n);
    if (ct2 <= 0.0) return 1.0;
    const double ct = std::sqrt(ct2);
    const double s = (ci - n * ct) / (ci + n * ct);
    const double p = (n * ci - ct) / (n * ci + ct);
    return 0.5 * (s * s + p * p);
}

bool PathOracle::same_side(const Places& walk, std::size_t i) const
{
    const Vec3 n = normal(walk[i]);
    return glm::dot(n, towards(walk[i], walk[i - 1])) * glm::dot(n, towards(walk[i], walk[i + 1])) > 0.0;
}

/// d xi_a / d xi_b along the walk from a to b, all vertices between them delta: xi_a the direction at a
/// (at infinity: the place on a plane across the light), xi_b the place on the surface of b (of a point:
/// on a plane across the ray; at infinity: the direction). The values are those of the path, so that
/// nothing drifts; only derivatives are carried.
PathOracle::Jacobian PathOracle::jacobian(const Places& walk, std::size_t a, std::size_t b) const
{
    const Vec3 w = towards(walk[a], walk[a + 1]);
    const Vec3 across =
        glm::normalize(glm::cross(w, std::abs(w.x) < 0.6 ? Vec3(1.0, 0.0, 0.0) : Vec3(0.0, 1.0, 0.0)));
    const Vec3 other = glm::cross(w, across);
    const bool from_infinity = infinite(walk[a]);
    Pencil origin =
        from_infinity ? Pencil{walk[a + 1].position - w, across, other} : constant(walk[a].position);
    Pencil ray = from_infinity ? constant(w) : Pencil{w, across, other};
    double condition = 1.0;
    // Where rays meet again, as behind a lens, the area is a small difference.
    const auto area = [&](const Pencil& end) {
        const double spanned = glm::length(glm::cross(end.du, end.dv));
        return Jacobian{1.0 / spanned, condition * glm::length(end.du) * glm::length(end.dv) / spanned};
    };

    for (std::size_t i = a + 1; i <= b; ++i) {
        if (infinite(walk[i])) return area(ray);
        // Where the rays meet the surface, to first order its tangent plane: n . (p - x) = 0.
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
                       material(walk[i]))) { // so grazing that it rounds
            return {0.0, std::numeric_limits<double>::infinity()};
        } else { // w' = e w + (sign c' - e c) n, c' the cosine on the other side
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

/// The density with which a walk makes the first `vertices` of these places.
double PathOracle::walk_density(const Places& walk, std::size_t vertices, bool from_eye) const
{
    if (vertices == 0) return 1.0;
    double density = 1.0;
    if (!from_eye) {
        const Share share = share_of(walk[0]);
        density = share.probability;
        if (walk[0].kind == Kind::surface) density /= share.area;
        if (walk[0].kind == Kind::environment) density /= 4.0 * pi;
    }
    for (std::size_t a = 0; a + 1 < vertices;) {
        const Vec3 w = towards(walk[a], walk[a + 1]);
        if (a > 0)
            density *= same_side(walk, a)
                           ? std::abs(glm::dot(normal(walk[a]), w)) / pi * survival(walk[a], a)
                           : 0.0;
        else if (from_eye)
            density *= 1.0 / (4.0 * tan_x_ * tan_y_ * std::pow(eye_cosine(w), 3));
        else
            density *= pdf_start(walk[0], w);
        std::size_t b = a + 1;
        for (; is_delta(walk[b]); ++b) {
            density *= survival(walk[b], b);
            if (std::holds_alternative<scenes::Glass>(material(walk[b])))
                density *= same_side(walk, b) ? fresnel_at(walk, b) : 1.0 - fresnel_at(walk, b);
        }
        density *= jacobian(walk, a, b).value;
        a = b;
    }
    return density;
}

bool PathOracle::can_join(const Places& x, std::size_t s) const
{
    const std::size_t k = x.size() - 1;
    const bool can_be_hit = x[0].kind == Kind::surface || x[0].kind == Kind::environment;
    if (s == 0 || k == 1) return can_be_hit; // no eye meets a point, nor sees one
    return (s == 1 || scatters(x[s - 1])) && (s == k || scatters(x[s]));
}

Judgement PathOracle::judge(const Places& x) const
{
    const std::size_t k = x.size() - 1;
    const Places backwards(x.rbegin(), x.rend());
    Judgement result{Rgb(0.0), {}, 1.0};
    for (std::size_t s = 0; s <= k; ++s) {
        result.densities.push_back(
            can_join(x, s) ? walk_density(x, s, false) * walk_density(backwards, k + 1 - s, true) : 0.0);
    }

    // Flux is carried from the emitter to the eye, where it is measured across the ray:
    // W_e cos = 1 / (A cos^3).
    const Vec3 to_emitter = towards(x[k], x[k - 1]);
    Rgb f = emitted(x[0], towards(x[0], x[1])) /
            (4.0 * tan_x_ * tan_y_ * std::pow(eye_cosine(to_emitter), 3));
    double growth = 1.0;
    for (std::size_t a = 0; a < k;) {
        const Vec3 w = towards(x[a], x[a + 1]);
        if (x[a].kind == Kind::surface) f *= std::abs(glm::dot(normal(x[a]), w));
        if (a > 0) {
            const auto* lambertian = std::get_if<scenes::Lambertian>(&material(x[a]));
            f *= lambertian != nullptr && same_side(x, a) ? lambertian->albedo / pi : Rgb(0.0);
        }
        std::size_t b = a + 1;
        for (; is_delta(x[b]); ++b) {
            if (const auto* mirror = std::get_if<scenes::Mirror>(&material(x[b])))
                f *= mirror->reflectance;
            if (const auto* glass = std::get_if<scenes::Glass>(&material(x[b])))
                f *= same_side(x, b) ? glass->reflectance * fresnel_at(x, b)
                                     : glass->transmittance * (1.0 - fresnel_at(x, b));
        }
        f *= jacobian(x, a, b).value;
        growth =
            std::max({growth, jacobian(x, a, b).condition, jacobian(backwards, k - b, k - a).condition});
        a = b;
    }
    result.throughput = f;

    // A direction is known to (size of coordinates) / (length of the edge) roundoffs, a cosine to that
    // over itself; in glass the cosine of refraction, over its square; each delta vertex passes on what
    // came before, magnified by the curvature that it meets.
    double size = 0.0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i <= k; ++i) {
        if (infinite(x[i])) continue;
        size = std::max({size, glm::length(x[i].position), radius_});
        if (i < k && !infinite(x[i + 1]))
            shortest = std::min(shortest, glm::distance(x[i].position, x[i + 1].position));
    }
    for (std::size_t i = 0; i <= k; ++i) {
        if (x[i].kind != Kind::surface) continue;
        double grazing = 1.0;
        if (i > 0)
            grazing = std::min(grazing, std::abs(glm::dot(normal(x[i]), towards(x[i], x[i - 1]))));
        if (i < k)
            grazing = std::min(grazing, std::abs(glm::dot(normal(x[i]), towards(x[i], x[i + 1]))));
        result.condition += 1.0 / (grazing * grazing);
    }
    result.condition *= growth * (std::isfinite(shortest) ? 1.0 + size / shortest : 1.0);
    return result;
}

PathOracle::Answer PathOracle::blocked(const Place& a, const Place& b) const
{
    const bool far_a = infinite(a);
    const Place& near = far_a ? b : a;
    const Place& end = far_a ? a : b;
    const Vec3 d = infinite(end) ? end.position * 4.0 * (radius_ + glm::length(near.position))
                                 : end.position - near.position;
    constexpr double margin = 1e-9;
    Answer answer = Answer::no;
    const auto judge_margin = [&](double inside) {
        if (inside > margin) return true;
        if (inside > -margin) answer = Answer::undecided;
        return false;
    };
    const auto on = [](const Place& place, std::uint32_t primitive) {
        return place.kind == Kind::surface && place.index == primitive;
    };
    for (std::uint32_t i = 0; i < scene_.triangles.size(); ++i) {
        if (on(near, i) || on(end, i)) continue; // a plane is met once, at the end
        const auto& v = scene_.triangles[i].vertices;
        const Vec3 h = glm::cross(d, v[2] - v[0]);
        const double det = glm::dot(v[1] - v[0], h);
        if (det == 0.0) continue;
        const double b1 = glm::dot(near.position - v[0], h) / det;
        const Vec3 q = glm::cross(near.position - v[0], v[1] - v[0]);
        const double b2 = glm::dot(d, q) / det;
        const double t = glm::dot(v[2] - v[0], q) / det;
        if (judge_margin(std::min({b1, b2, 1.0 - b1 - b2, t, 1.0 - t}))) return Answer::yes;
    }
    for (std::uint32_t i = 0; i < scene_.spheres.size(); ++i) {
        const auto& sphere = scene_.spheres[i];
        const auto index = static_cast<std::uint32_t>(scene_.triangles.size()) + i;
        const Vec3 o = near.position - sphere.center;
        const double dd = glm::dot(d, d);
        const double half = glm::dot(o, d) / dd;
        if (on(near, index)) { // leaves it for good, or crosses its inside to t = -2 half
            const double other = -2.0 * half;
            const bool ends_there = on(end, index);
            if (std::abs(other) < margin)
                answer = Answer::undecided;
            else if (other > 0.0 && !ends_there && judge_margin(std::min(other, 1.0 - other)))
                return Answer::yes;
            continue;
        }
        const double product = (glm::dot(o, o) - sphere.radius * sphere.radius) / dd;
        if (on(end, index)) { // one root is 1, the other is their product
            if (judge_margin(std::min(product, 1.0 - product))) return Answer::yes;
            continue;
        }
        const double discriminant = half * half - product;
        const double clearance = discriminant * dd / (sphere.radius * sphere.radius);
        if (std::abs(clearance) < margin) answer = Answer::undecided;
        if (clearance < margin) continue;
        const double root = std::sqrt(discriminant);
        for (const double t : {-half - root, -half + root})
            if (judge_margin(std::min(t, 1.0 - t))) return Answer::yes;
    }
    return answer;
}

int PathOracle::pixel_of(const Place& place) const
{
    const auto& camera = *scene_.camera;
    const Vec3 w = infinite(place) ? place.position : place.position - camera.eye;
    const double ahead = -glm::dot(w, camera.backward);
    if (ahead <= 0.0) return -1;
    const double x = (1.0 + glm::dot(w, camera.right) / ahead / tan_x_) * 0.5 * width_;
    const double y = (1.0 - glm::dot(w, camera.up) / ahead / tan_y_) * 0.5 * height_;
    if (std::abs(x - std::round(x)) < 1e-9 || std::abs(y - std::round(y)) < 1e-9) return -2;
    if (x < 0.0 || y < 0.0 || x > width_ || y > height_) return -1;
    return static_cast<int>(y) * width_ + static_cast<int>(x);
}

} // namespace tests
