#pragma once

// A scene in one number format, for the usual tricks: all primitives are tested, without a tree, by the
// tests of our own two implementations.

#include "cuda/trees/intersect.h"
#include "cuda/trees/sphere.h"
#include "ref/trees/intersect_primitive.h"
#include "scenes/scene.h"

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace extremes {

/// The determinant of [Moeller and Trumbore 1997]: the volume of the direction and the two edges.
template <class Vec3>
auto determinant(const Vec3& v0, const Vec3& v1, const Vec3& v2, const Vec3& direction)
{
    return glm::dot(v1 - v0, glm::cross(direction, v2 - v0));
}

/// What a ray does not hit: a primitive that it leaves, and triangles with a small determinant.
template <class F>
struct Left {
    std::optional<std::uint32_t> primitive;
    F least_determinant = 0;
};

/// A hit on a primitive of a scene in the format F.
template <class F>
struct TrickHit {
    F t;
    std::uint32_t primitive;
};

/// The scene in one format: a list of primitives that are all tested, without a tree.
template <class F>
class RoundedScene;

template <>
class RoundedScene<double> {
public:
    using Vec3 = glm::dvec3;

    explicit RoundedScene(const scenes::Scene& scene) : scene_(&scene) {}
    /// The first hit.
    [[nodiscard]] std::optional<TrickHit<double>> intersect(const Vec3& origin, const Vec3& direction,
                                                            const Left<double>& left) const
    {
        ref::Ray ray{origin, direction};
        const std::array<std::uint32_t, 1> on{left.primitive.value_or(0)};
        if (left.primitive) ray.on = on;
        const ref::ShearedRay sheared(ray);
        std::optional<ref::Hit> closest;
        for (std::uint32_t i = 0; i < primitive_count(*scene_); ++i) {
            if (i < scene_->triangles.size() &&
                std::abs(determinant(corner(i, 0), corner(i, 1), corner(i, 2), direction)) <
                    left.least_determinant)
                continue;
            if (const auto hit = ref::intersect_primitive(*scene_, ray, sheared, i))
                if (!closest || hit->t < closest->t) closest = hit;
        }
        if (!closest) return std::nullopt;
        return TrickHit<double>{closest->t, closest->primitive};
    }
    [[nodiscard]] Vec3 corner(std::uint32_t triangle, std::size_t i) const
    {
        return scene_->triangles[triangle].vertices[i];
    }
    [[nodiscard]] Vec3 center(std::uint32_t sphere) const { return scene_->spheres[sphere].center; }

private:
    const scenes::Scene* scene_;
};

template <>
class RoundedScene<float> {
public:
    using Vec3 = glm::vec3;

    explicit RoundedScene(const scenes::Scene& scene)
    {
        for (const scenes::Triangle& t : scene.triangles)
            triangles_.push_back({{Vec3(t.vertices[0]), Vec3(t.vertices[1]), Vec3(t.vertices[2])}});
        for (const scenes::Sphere& s : scene.spheres)
            spheres_.push_back({Vec3(s.center), static_cast<float>(s.radius)});
    }
    [[nodiscard]] std::optional<TrickHit<float>> intersect(const Vec3& origin, const Vec3& direction,
                                                           const Left<float>& left) const
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        const fast::Ray ray{origin, infinity, direction};
        const fast::ShearedRay sheared(ray);
        std::optional<TrickHit<float>> closest;
        const auto add = [&](float t, std::uint32_t primitive) {
            if (t > 0 && (!closest || t < closest->t)) closest = TrickHit<float>{t, primitive};
        };
        fast::Hit hit{};
        for (std::uint32_t i = 0; i < triangles_.size(); ++i)
            if (left.primitive != i &&
                std::abs(determinant(corner(i, 0), corner(i, 1), corner(i, 2), direction)) >=
                    left.least_determinant &&
                fast::intersect_triangle(sheared, triangles_[i], infinity, hit))
                add(hit.t, i);
        for (std::uint32_t i = 0; i < spheres_.size(); ++i) {
            const auto primitive = static_cast<std::uint32_t>(triangles_.size()) + i;
            if (left.primitive == primitive) // one root is 0, the other is this
                add(-2 * glm::dot(origin - spheres_[i].center, direction) /
                        glm::dot(direction, direction),
                    primitive);
            else if (fast::intersect_sphere(ray, spheres_[i], infinity, hit))
                add(hit.t, primitive);
        }
        return closest;
    }
    [[nodiscard]] Vec3 corner(std::uint32_t triangle, std::size_t i) const
    {
        return triangles_[triangle].vertices[i];
    }
    [[nodiscard]] Vec3 center(std::uint32_t sphere) const { return spheres_[sphere].center; }

private:
    std::vector<fast::Triangle> triangles_;
    std::vector<fast::Sphere> spheres_;
};

} // namespace extremes
