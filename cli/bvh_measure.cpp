#include "cli/bvh_measure.h"

#include "cli/repetitions.h"
#include "cli/resources.h"
#include "ref/transport/camera.h"
#include "ref/transport/random.h"
#include "ref/transport/sampling.h"
#include "ref/trees/geometry.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace cli {

namespace {

/// CPU time of `work` in seconds. Everything here runs on one thread, so on an idle machine this is the
/// elapsed time; on a busy one it excludes the time of other processes.
template <typename Function>
double cpu_seconds_of(Function work)
{
    const double start = cpu_seconds();
    work();
    return cpu_seconds() - start;
}

RayCost measure(const ref::Geometry& geometry, const std::vector<ref::Ray>& rays)
{
    if (rays.empty()) return {};
    ref::TraversalCounts counts;
    std::uint64_t hits = 0;
    const Repetitions timed = repeat_until_precise(cpu_seconds, [&] {
        counts = {};
        hits = 0;
        for (const ref::Ray& ray : rays) hits += intersect(geometry, ray, &counts) ? 1 : 0;
    });
    if (hits > rays.size())
        throw std::logic_error(
            "more hits than rays"); // uses the hits, so that the loop is not optimised away
    const auto count = static_cast<double>(rays.size());
    return {count / timed.seconds * 1e-6, timed.relative_standard_error,
            static_cast<double>(counts.nodes) / count, static_cast<double>(counts.primitives) / count};
}

struct Rays {
    std::vector<ref::Ray> camera;
    std::vector<ref::Ray> diffuse;
};

/// A ray through the middle of every pixel, and from where it hits one in a cosine-distributed
/// direction.
Rays make_rays(const ref::Geometry& geometry, const Size& size)
{
    Rays rays;
    const ref::Camera camera(*geometry.scene().camera, size.width, size.height);
    std::uint32_t pixel = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x, ++pixel) {
            const ref::Ray ray = camera.ray({x + 0.5, y + 0.5});
            rays.camera.push_back(ray);
            const auto hit = intersect(geometry, ray);
            if (!hit) continue;
            const ref::SurfacePoint point = surface_point(geometry, ray, *hit);
            const bool front = glm::dot(ray.direction, point.normal) < 0;
            const ref::Uniforms u = ref::uniforms({0, pixel, 0}, ref::Event::eye_bounce);
            const ref::Vec3 local = ref::sample_cosine_hemisphere(u[0], u[1]);
            const ref::Vec3 direction = ref::Frame(front ? point.normal : -point.normal).to_world(local);
            rays.diffuse.push_back({leave_surface(point, direction), direction});
        }
    return rays;
}

double median_build_ms(const std::vector<ref::Aabb>& boxes, ref::Builder builder, int repeats)
{
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i)
        times.push_back(1e3 * cpu_seconds_of([&] { ref::build(boxes, builder); }));
    std::nth_element(times.begin(), times.begin() + repeats / 2, times.end());
    return times[static_cast<std::size_t>(repeats) / 2];
}

} // namespace

MeasuredBuilder measure_builder(const scenes::Scene& scene, const NamedBuilder& named, const Size& size,
                                int repeats)
{
    const std::vector<ref::Aabb> boxes = ref::primitive_bounds(scene);
    const ref::Geometry geometry(scene, named.builder);
    const Rays rays = make_rays(geometry, size);
    const RayCost camera = measure(geometry, rays.camera);
    const RayCost diffuse = measure(geometry, rays.diffuse);
    return {named.name,
            median_build_ms(boxes, named.builder, repeats),
            ref::quality(geometry.tree()),
            geometry.tree().nodes.size(),
            camera,
            diffuse};
}

} // namespace cli
