#pragma once

// Lights that are not surfaces: a loop over all of them and what they have in common. Code that treats
// all kinds alike uses this, so a new kind of light is added to scene.h and here, and not in every loop.

#include "scenes/kinds.h"
#include "scenes/scene.h"

#include <cstddef>
#include <string>

namespace scenes {

/// Calls visit(light, index) for every point, spot and directional light, in this order; `index` counts
/// the lights of each kind from 0. `scene` is a Scene or a const Scene.
template <class AnyScene, class Visit>
void for_each_light(AnyScene& scene, const Visit& visit)
{
    const auto visit_all = [&](auto& lights) {
        std::size_t index = 0;
        for (auto& light : lights) visit(light, index++);
    };
    visit_all(scene.point_lights);
    visit_all(scene.spot_lights);
    visit_all(scene.directional_lights);
}

/// The name of a light for messages: "spot light 2" for index 1.
inline std::string light_name(const PointLight& /*light*/, std::size_t index)
{
    return "point light " + std::to_string(index + 1);
}
inline std::string light_name(const SpotLight& /*light*/, std::size_t index)
{
    return "spot light " + std::to_string(index + 1);
}
inline std::string light_name(const DirectionalLight& /*light*/, std::size_t index)
{
    return "directional light " + std::to_string(index + 1);
}

constexpr EmitterKind kind_of(const PointLight& /*light*/)
{
    return EmitterKind::point;
}
constexpr EmitterKind kind_of(const SpotLight& /*light*/)
{
    return EmitterKind::spot;
}
constexpr EmitterKind kind_of(const DirectionalLight& /*light*/)
{
    return EmitterKind::directional;
}

/// Whether the light is at a point; if not, it is infinitely far away.
template <class Light>
constexpr bool has_position = requires(Light light)
{
    light.position;
};

/// The emission of the light: intensity (W sr^-1) of a light at a point, irradiance (W m^-2) of one at
/// infinity.
template <class Light>
auto& emitted_by(Light& light)
{
    if constexpr (has_position<Light>)
        return light.intensity;
    else
        return light.irradiance;
}

/// Calls visit(position, name) for every light that is at a point.
template <class AnyScene, class Visit>
void for_each_light_position(AnyScene& scene, const Visit& visit)
{
    for_each_light(scene, [&](auto& light, std::size_t index) {
        if constexpr (requires { light.position; }) visit(light.position, light_name(light, index));
    });
}

} // namespace scenes
