#include "scenes/export/surfaces.h"

#include "scenes/bounds.h"
#include "scenes/export/exact.h"
#include "scenes/for_each_light.h"
#include "scenes/read_scene.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace scenes::exports {
namespace {

using Key = std::tuple<double, double, double>;

/// The index in `mesh.points` of a point that may be new.
std::uint32_t index_of(const Vec3& point, Mesh& mesh, std::map<Key, std::uint32_t>& known)
{
    const auto next = static_cast<std::uint32_t>(mesh.points.size());
    const auto [found, added] = known.try_emplace(Key{point.x, point.y, point.z}, next);
    if (added) mesh.points.push_back(point);
    return found->second;
}

bool is_word(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
}

} // namespace

std::vector<Mesh> meshes_of(const Scene& scene)
{
    std::map<std::uint32_t, Mesh> meshes;
    std::map<std::uint32_t, std::map<Key, std::uint32_t>> known;
    for (const Triangle& triangle : scene.triangles) {
        const auto& v = triangle.vertices;
        if (glm::cross(v[1] - v[0], v[2] - v[0]) == Vec3(0.0)) continue;
        Mesh& mesh =
            meshes.try_emplace(triangle.material, Mesh{triangle.material, {}, {}}).first->second;
        auto& points = known[triangle.material];
        std::array<std::uint32_t, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) corners[i] = index_of(v[i], mesh, points);
        mesh.triangles.push_back(corners);
    }
    std::vector<Mesh> result;
    for (auto& [material, mesh] : meshes) result.push_back(std::move(mesh));
    return result;
}

bool emits(const Material& material)
{
    const auto* emission = std::get_if<Emission>(&material);
    return emission != nullptr && emission->radiance != Rgb(0.0);
}

std::string unique_name(const Scene& scene, std::uint32_t material)
{
    std::string name = scene.material_names[material];
    std::replace_if(
        name.begin(), name.end(), [](char c) { return !is_word(c); }, '_');
    return name + "_" + std::to_string(material);
}

std::array<Vec3, 3> frame_of(const Vec3& z)
{
    const Vec3 size = glm::abs(z);
    const Vec3 other = size.x <= size.y && size.x <= size.z ? Vec3(1, 0, 0)
                       : size.y <= size.z                   ? Vec3(0, 1, 0)
                                                            : Vec3(0, 0, 1);
    const Vec3 x = glm::normalize(glm::cross(other, z));
    return {x, glm::cross(z, x), z};
}

double reach_of(const Scene& scene)
{
    const auto box = bounds(scene);
    if (!box) return 1.0;
    const Vec3& eye = scene.camera->eye;
    const Vec3 farthest = glm::max(glm::abs(box->min - eye), glm::abs(box->max - eye));
    const double distance = glm::length(farthest);
    return distance > 0 ? 2.0 * distance : 1.0;
}

std::string stem_of(std::string_view file_name)
{
    const std::size_t dot = file_name.rfind('.');
    return std::string(file_name.substr(0, dot == 0 ? std::string_view::npos : dot));
}

void refuse(const Scene& scene, const std::string& thing, const std::string& why)
{
    throw SceneError(scene.name + ": " + thing + ": " + why);
}

void expect_constant(const Scene& scene, const SpotLight& light, std::size_t index,
                     const std::string& format)
{
    if (light.exponent == 0.0) return;
    refuse(scene, light_name(light, index),
           format + " has no spot light that fades by a power of the cosine (exponent " +
               exact(light.exponent) + ")");
}

std::string material_name(const Scene& scene, std::uint32_t material)
{
    return "material \"" + scene.material_names[material] + "\"";
}

} // namespace scenes::exports
