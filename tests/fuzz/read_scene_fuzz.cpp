// Any bytes must give a valid scene or a SceneError of one line. Everything else, such as another
// exception, a crash or a report of a sanitizer, is a bug.

#include "scenes/bounds.h"
#include "scenes/read_scene.h"
#include "scenes/requirements.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace {

/// Like assert, but in every build.
void demand(bool promise)
{
    if (!promise) std::abort();
}

bool is_finite(const scenes::Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void demand_promises(const scenes::Scene& scene)
{
    demand(scene.material_names.size() == scene.materials.size());
    for (const scenes::Triangle& triangle : scene.triangles) {
        demand(triangle.material < scene.materials.size());
        for (const scenes::Vec3& vertex : triangle.vertices) demand(is_finite(vertex));
    }
    for (const scenes::Sphere& sphere : scene.spheres)
        demand(sphere.material < scene.materials.size() && is_finite(sphere.center) &&
               sphere.radius > 0 && std::isfinite(sphere.radius));
    for (const scenes::SpotLight& spot : scene.spot_lights)
        demand(is_finite(spot.position) && is_finite(spot.direction) && spot.cos_cutoff >= -1 &&
               spot.cos_cutoff < 1 && spot.exponent >= 0);
    for (const scenes::DirectionalLight& light : scene.directional_lights)
        demand(is_finite(light.direction));
    for (const scenes::PointLight& light : scene.point_lights) demand(is_finite(light.position));
    if (scene.environment) demand(is_finite(*scene.environment));
    if (scene.camera)
        demand(is_finite(scene.camera->eye) && is_finite(scene.camera->right) &&
               is_finite(scene.camera->up) && is_finite(scene.camera->backward) &&
               scene.camera->fov > 0 && scene.camera->fov < 3.1416);
    for (const std::string& notice : scene.notices) demand(notice.find('\n') == std::string::npos);
    (void)scenes::bounds(scene);
    (void)scenes::requirements(scene);
}

} // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    try {
        demand_promises(scenes::parse_scene({reinterpret_cast<const char*>(data), size}, "fuzz.dae"));
    } catch (const scenes::SceneError& error) {
        const std::string_view message = error.what();
        demand(message.find("fuzz.dae:") == 0 && message.find('\n') == std::string_view::npos);
    }
    return 0;
}
