#include "cuda/trees/scene_geometry.h"

#include "cuda/parallel/executor.h"

namespace gpu {

std::vector<Triangle> triangles_of(const scenes::Scene& scene, const Placement& place)
{
    std::vector<Triangle> triangles;
    triangles.reserve(scene.triangles.size());
    for (const scenes::Triangle& triangle : scene.triangles) {
        const auto& v = triangle.vertices;
        triangles.push_back({{place(v[0]), place(v[1]), place(v[2])}});
    }
    return triangles;
}

std::vector<Sphere> spheres_of(const scenes::Scene& scene, const Placement& place)
{
    std::vector<Sphere> spheres;
    spheres.reserve(scene.spheres.size());
    for (const scenes::Sphere& sphere : scene.spheres)
        spheres.push_back({place(sphere.center), static_cast<float>(sphere.radius * place.scale)});
    return spheres;
}

std::vector<Box> boxes_of(const scenes::Scene& scene, const Placement& place)
{
    const std::vector<Triangle> triangles = triangles_of(scene, place);
    const std::vector<Sphere> spheres = spheres_of(scene, place);
    std::vector<Box> boxes(triangles.size() + spheres.size());
    const std::span<Box> all(boxes);
    SerialExecutor executor;
    executor(static_cast<std::uint32_t>(triangles.size()),
             BoundTriangles{triangles, all.first(triangles.size())});
    executor(static_cast<std::uint32_t>(spheres.size()),
             BoundSpheres{spheres, all.subspan(triangles.size())});
    return boxes;
}

} // namespace gpu
