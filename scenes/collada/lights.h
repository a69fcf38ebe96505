#pragma once

// Light elements: what kind of light, and how strong.

#include "scenes/collada/document.h"
#include "scenes/scene.h"

#include <variant>

namespace scenes::collada {

/// The square [-1/2, 1/2]^2 in the local xy plane, emitting along local -z.
struct AreaLight {
    Rgb radiance;
};

/// Constant radiance from every direction.
struct AmbientLight {
    Rgb radiance;
};

/// In the local frame: at the origin, along -z.
using Light = std::variant<AreaLight, AmbientLight, PointLight, DirectionalLight, SpotLight>;

/// The meaning of a <light>: <point>, <directional>, <spot> or <ambient> of the common profile, or one
/// of these or <area> in the CMU462 profile, which has priority.
///   - A spot's <falloff_angle> is the full angle of its cone in degrees, in (0, 360] (180 if absent);
///     its <falloff_exponent> is 0 if absent.
///   - <constant_attenuation> and so on are ignored: light falls off with the inverse square of the
///     distance, as the files of the CMU462 profile require for any value of these elements.
Light read_light(const Element& light);

} // namespace scenes::collada
