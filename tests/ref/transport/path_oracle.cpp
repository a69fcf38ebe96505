// f(x) and p_s(x) by their definitions, vertex by vertex.

#include "tests/ref/transport/path_oracle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace transport_test {

namespace {

using std::numbers::pi;
using Kind = Place::Kind;

double largest(const Rgb& v)
{
    return std::max({v.x, v.y, v.z});
}

} // namespace

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

double PathOracle::survival(const Place& place, std::size_t bounce) const
{
    if (!roulette_ || static_cast<int>(bounce) < roulette_from_) return 1.0;
    double albedo = 0.0;
    if (const auto* l = std::get_if<scenes::Lambertian>(&material(place))) albedo = largest(l->albedo);
    if (const auto* m = std::get_if<scenes::Mirror>(&material(place))) albedo = largest(m->reflectance);
    if (const auto* g = std::get_if<scenes::Glass>(&material(place)))
        albedo = std::max(largest(g->reflectance), largest(g->transmittance));
    if (albedo >= 1.0) return 0.95;
    return albedo < 0.999 ? albedo : 0.999;
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
    const double n = cosine > 0.0 ? ior : 1.0 / ior; // of the far side, relative to the near side
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
    if (s == 0 || k == 1) return can_be_hit; // a point light is neither hit nor seen
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

    // Flux goes from the emitter to the eye, where it is measured across the ray: W_e cos = 1 / (A
    // cos^3).
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

    // A direction has an error of (size of coordinates) / (length of the edge) roundoffs. A cosine has
    // that error divided by itself; in glass, the cosine of refraction has it divided by its square.
    // Each delta vertex passes on the earlier errors, magnified by the curvature of its surface.
    double size = 0.0;
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i <= k; ++i) {
        if (is_infinite(x[i])) continue;
        size = std::max({size, glm::length(x[i].position), radius_});
        if (i < k && !is_infinite(x[i + 1]))
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

} // namespace transport_test
