#include "cuda/trees/scene_geometry.h"

#include "cuda/parallel/executor.h"

#include <cmath>

namespace gpu {

namespace {

/// The nearest float that is beyond `x` on the side of `towards`.
float rounded(double x, float towards)
{
    return std::nextafter(static_cast<float>(x), towards);
}

} // namespace

std::vector<Triangle> triangles_of(const scenes::Scene& scene)
{
    std::vector<Triangle> triangles;
    triangles.reserve(scene.triangles.size());
    for (const scenes::Triangle& triangle : scene.triangles) {
        const auto& v = triangle.vertices;
        triangles.push_back({{Vec3(v[0]), Vec3(v[1]), Vec3(v[2])}});
    }
    return triangles;
}

std::vector<Box> boxes_of(const scenes::Scene& scene)
{
    const std::vector<Triangle> triangles = triangles_of(scene);
    std::vector<Box> boxes(triangles.size());
    SerialExecutor{}(static_cast<std::uint32_t>(triangles.size()), BoundTriangles{triangles, boxes});
    for (const scenes::Sphere& sphere : scene.spheres) {
        Box box{};
        for (int axis = 0; axis < 3; ++axis) {
            constexpr float infinity = std::numeric_limits<float>::infinity();
            box.lower[axis] = rounded(sphere.center[axis] - sphere.radius, -infinity);
            box.upper[axis] = rounded(sphere.center[axis] + sphere.radius, infinity);
        }
        boxes.push_back(box);
    }
    return boxes;
}

} // namespace gpu
