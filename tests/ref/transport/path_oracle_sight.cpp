// The surfaces between two places, and the pixel where the eye sees a place.

#include "tests/ref/transport/path_oracle.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace transport_test {

namespace {

using Kind = Place::Kind;

} // namespace

PathOracle::Answer PathOracle::blocked(const Place& a, const Place& b) const
{
    const bool far_a = is_infinite(a);
    const Place& near = far_a ? b : a;
    const Place& end = far_a ? a : b;
    const Vec3 d = is_infinite(end) ? end.position * 4.0 * (radius_ + glm::length(near.position))
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
        if (on(near, i) || on(end, i)) continue; // a line crosses a plane only once, here at the end
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
        if (on(near, index)) { // leaves the sphere, or crosses its inside to t = -2 half
            const double other = -2.0 * half;
            const bool ends_there = on(end, index);
            if (std::abs(other) < margin)
                answer = Answer::undecided;
            else if (other > 0.0 && !ends_there && judge_margin(std::min(other, 1.0 - other)))
                return Answer::yes;
            continue;
        }
        const double product = (glm::dot(o, o) - sphere.radius * sphere.radius) / dd;
        if (on(end, index)) { // one root is 1, so the other is their product
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
    const Vec3 w = is_infinite(place) ? place.position : place.position - camera.eye;
    const double ahead = -glm::dot(w, camera.backward);
    if (ahead <= 0.0) return -1;
    const double x = (1.0 + glm::dot(w, camera.right) / ahead / tan_x_) * 0.5 * width_;
    const double y = (1.0 - glm::dot(w, camera.up) / ahead / tan_y_) * 0.5 * height_;
    if (std::abs(x - std::round(x)) < 1e-9 || std::abs(y - std::round(y)) < 1e-9) return -2;
    if (x < 0.0 || y < 0.0 || x > width_ || y > height_) return -1;
    return static_cast<int>(y) * width_ + static_cast<int>(x);
}

} // namespace transport_test
