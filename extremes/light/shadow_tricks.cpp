#include "extremes/light/shadow_tricks.h"

#include "extremes/leave/moved_by_ulps.h"
#include "extremes/leave/rounded_scene.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <numbers>

namespace extremes {

namespace {

enum class ShadowTrick { fixed, relative, ulps, exclude };

/// The two ends of a shadow ray.
template <class Vec3>
struct ShadowEnds {
    Vec3 from, from_normal;
    std::uint32_t from_primitive;
    Vec3 to, to_normal;
    std::uint32_t to_primitive;
};

template <class F>
bool lit(const RoundedScene<F>& scene, const ShadowEnds<typename RoundedScene<F>::Vec3>& ends,
         ShadowTrick trick, F epsilon)
{
    auto from = ends.from;
    auto to = ends.to;
    if (trick == ShadowTrick::ulps) {
        from = point_moved_by_ulps(from, ends.from_normal);
        to = point_moved_by_ulps(to, ends.to_normal);
    }
    const F length = glm::length(to - from);
    const auto direction = (to - from) / length;
    const F off = trick == ShadowTrick::fixed      ? epsilon
                  : trick == ShadowTrick::relative ? epsilon * length
                                                   : 0;
    Left<F> left;
    if (trick == ShadowTrick::exclude) left.primitive = ends.from_primitive;
    const auto hit = scene.intersect(from + off * direction, direction, left);
    if (!hit || hit->t >= length - 2 * off) return true;
    return trick == ShadowTrick::exclude && hit->primitive == ends.to_primitive;
}

template <class F>
double radiance_by_trick(const UnderEmitter& under, ShadowTrick trick, double epsilon, int samples,
                         Random& random)
{
    using Vec3 = typename RoundedScene<F>::Vec3;
    const RoundedScene<F> scene(under.scene);
    const auto across = [&](std::uint32_t triangle) {
        const Vec3 v0 = scene.corner(triangle, 0);
        return glm::cross(scene.corner(triangle, 1) - v0, scene.corner(triangle, 2) - v0);
    };
    const Vec3 eye(under.scene.camera->eye);
    const Vec3 towards(-under.scene.camera->backward);
    const auto seen = scene.intersect(eye, towards, {});
    if (!seen || seen->primitive > 1) return 0;
    ShadowEnds<Vec3> ends{};
    ends.from = eye + seen->t * towards;
    ends.from_primitive = seen->primitive;
    ends.from_normal = glm::normalize(across(seen->primitive));
    const auto light = static_cast<F>(std::get<scenes::Emission>(under.scene.materials[1]).radiance.x);
    const F scale = static_cast<F>(albedo_under_emitter * std::numbers::inv_pi) * light;
    F sum = 0;
    for (int i = 0; i < samples; ++i) {
        ends.to_primitive = 2 + static_cast<std::uint32_t>(random.below(2));
        const auto root = static_cast<F>(std::sqrt(random.uniform()));
        const F b2 = root * static_cast<F>(random.uniform());
        const Vec3 v0 = scene.corner(ends.to_primitive, 0);
        ends.to = v0 + (root - b2) * (scene.corner(ends.to_primitive, 1) - v0) +
                  b2 * (scene.corner(ends.to_primitive, 2) - v0);
        const Vec3 twice_area = across(ends.to_primitive); // of one triangle: the area of the square
        ends.to_normal = glm::normalize(twice_area);
        const Vec3 d = ends.to - ends.from;
        const F d2 = glm::dot(d, d);
        const F projected = glm::dot(ends.from_normal, d) * -glm::dot(twice_area, d) / d2;
        if (lit<F>(scene, ends, trick, static_cast<F>(epsilon))) sum += scale * projected / d2;
    }
    return static_cast<double>(sum / static_cast<F>(samples));
}

template <class F>
void add_shadow_tricks(std::vector<Method>& methods, int samples)
{
    constexpr bool is_double = std::is_same_v<F, double>;
    const auto add = [&](const char* name, ShadowTrick trick, double epsilon) {
        methods.push_back({(is_double ? "double, " : "float, ") + std::string(name),
                           is_double ? Format::binary64 : Format::binary32,
                           [=](double size, Random& random, int cases, Tally& tally) {
                               for (int i = 0; i < cases; ++i) {
                                   const UnderEmitter under = under_square(size, random);
                                   Random of_samples(random.bits());
                                   const double value =
                                       radiance_by_trick<F>(under, trick, epsilon, samples, of_samples);
                                   if (value == 0)
                                       tally.add(Failure::missed);
                                   else
                                       tally.add(std::abs(value / under.radiance - 1));
                               }
                           }});
    };
    add("fixed 1e-3", ShadowTrick::fixed, 1e-3);
    add("fixed 1e-4", ShadowTrick::fixed, 1e-4);
    add("fixed 1e-6", ShadowTrick::fixed, 1e-6);
    add("relative 1e-3", ShadowTrick::relative, 1e-3);
    add("ulps", ShadowTrick::ulps, 0);
    add("exclude", ShadowTrick::exclude, 0);
}

} // namespace

std::vector<Method> shadow_tricks(int samples)
{
    std::vector<Method> methods;
    add_shadow_tricks<float>(methods, samples);
    add_shadow_tricks<double>(methods, samples);
    return methods;
}

} // namespace extremes
