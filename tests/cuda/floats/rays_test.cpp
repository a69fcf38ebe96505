// Many rays at once (cuda/stages/floats_trace_rays.h) find what each alone would find, bit for bit, also
// where several surfaces are hit at the same t.

#include "cuda/stages/floats_trace_rays.h"
#include "tests/ref/trees/boxes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <vector>

namespace {

using fast::Floats;
using fast::floats_at_once;
using fast::Mask;
using fast::Vec3;
using trees_test::Random;

constexpr int lanes = static_cast<int>(floats_at_once);
constexpr fast::Needs with_spheres{true, true, false};

/// Random triangles, one in four the same as an earlier one, and some spheres.
struct Scene {
    Scene(std::size_t count, Random& random)
    {
        for (std::size_t i = 0; i < count; ++i) {
            if (i > 0 && random.below(4) == 0) {
                triangles.push_back(triangles[random.below(i)]);
                continue;
            }
            const trees_test::Vec3 at = random.in_cube();
            const double size = random.magnitude(-2, 0);
            fast::Triangle triangle{};
            for (Vec3& vertex : triangle.vertices) vertex = Vec3(at + size * random.in_cube());
            triangles.push_back(triangle);
        }
        for (auto i = random.below(4); i > 0; --i)
            spheres.push_back({Vec3(random.in_cube()), static_cast<float>(random.magnitude(-2, 0))});
    }
    std::vector<fast::Triangle> triangles;
    std::vector<fast::Sphere> spheres;
};

/// A ray from anywhere to a corner, to the inside of a triangle or anywhere; now and then none.
fast::Ray ray_in(const Scene& scene, Random& random)
{
    const Vec3 origin(2.0 * random.in_cube());
    const float t_max = random.below(3) == 0 ? 1.0f : std::numeric_limits<float>::infinity();
    if (random.below(20) == 0) return {origin, t_max, Vec3(0.0f)};
    if (scene.triangles.empty() || random.below(4) == 0)
        return {origin, t_max, Vec3(random.direction())};
    const auto& v = scene.triangles[random.below(scene.triangles.size())].vertices;
    const trees_test::Vec3 b = random.barycentric();
    const Vec3 inside = static_cast<float>(b[0]) * v[0] + static_cast<float>(b[1]) * v[1] +
                        static_cast<float>(b[2]) * v[2];
    return {origin, t_max, (random.below(3) == 0 ? v[0] : inside) - origin};
}

RC_GTEST_PROP(RaysTogether, FindWhatEachAloneFinds, ())
{
    Random random(*rc::gen::arbitrary<std::uint64_t>());
    const std::size_t sizes[] = {0, 1, 8, 30, 100, 2000};
    const Scene scene(sizes[random.below(6)], random);
    fast::HostMemory memory;
    const fast::SerialExecutor serial;
    const fast::SurfaceTree tree(memory, serial, scene.triangles, scene.spheres);
    fast::SceneView<with_spheres> view{};
    view.geometry = tree.view<true>();
    view.triangles = scene.triangles;
    for (int i = 0; i < 20; ++i) {
        std::vector<fast::Ray> rays;
        fast::RayOf<Floats> together{};
        for (int lane = 0; lane < lanes; ++lane) {
            rays.push_back(ray_in(scene, random));
            put_lane(together, lane, rays.back());
        }
        const std::uint32_t active =
            random.below(2) == 0 ? ~0u : static_cast<std::uint32_t>(random.bits());
        const Mask mask = fast::mask_of_bits(active & ((1u << lanes) - 1));
        const fast::HitOf<Floats> hits = closest_hits(view, together, mask);
        const std::uint32_t occluded_lanes = bits_of(occluded_rays(view, together, mask));
        for (int lane = 0; lane < lanes; ++lane) {
            if ((active >> lane & 1) == 0) continue;
            const fast::Ray& ray = rays[static_cast<std::size_t>(lane)];
            using Bits = std::array<std::uint32_t, 4>;
            RC_ASSERT(std::bit_cast<Bits>(lane_of(hits, lane)) ==
                      std::bit_cast<Bits>(intersect(view.geometry, ray)));
            RC_ASSERT((occluded_lanes >> lane & 1) == (occluded(view.geometry, ray) ? 1u : 0u));
        }
    }
}

} // namespace
