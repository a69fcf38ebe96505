#pragma once

// The kinds of things that a scene can contain. Both wings, and requirements.h, use these enumerations.

#include "scenes/scene.h"

#include <array>
#include <string_view>

namespace scenes {

enum class Shape { triangle, sphere };
enum class Bsdf { lambertian, mirror, glass };
/// A triangle or a sphere whose material is Emission, a light of for_each_light.h, or the environment.
enum class EmitterKind { triangle, sphere, point, directional, spot, environment };

/// The four families of bidirectional strategies, s vertices on the light subpath and t on the eye
/// subpath [Veach 1997, sec. 10.2]:
///   emission_hit      s = 0, t >= 2   the eye walk runs into an emitter
///   next_event        s = 1, t >= 2   an eye vertex is joined to a fresh point on an emitter
///   light_image       s >= 1, t = 1   a light vertex is joined to the pinhole
///   inner_connection  s >= 2, t >= 2  an eye vertex is joined to a light vertex
enum class Strategy { emission_hit, next_event, light_image, inner_connection };

// Enumerators are numbered from 0 in the order of all_of, which name_of relies on.

/// All enumerators of an enumeration, in order: all_of<Shape>.
template <class Enumeration>
constexpr std::array<Enumeration, 0> all_of{};
template <>
inline constexpr std::array all_of<Shape>{Shape::triangle, Shape::sphere};
template <>
inline constexpr std::array all_of<Bsdf>{Bsdf::lambertian, Bsdf::mirror, Bsdf::glass};
template <>
inline constexpr std::array all_of<EmitterKind>{EmitterKind::triangle, EmitterKind::sphere,
                                                EmitterKind::point,    EmitterKind::directional,
                                                EmitterKind::spot,     EmitterKind::environment};
template <>
inline constexpr std::array all_of<Strategy>{Strategy::emission_hit, Strategy::next_event,
                                             Strategy::light_image, Strategy::inner_connection};
template <>
inline constexpr std::array all_of<FovAxis>{FovAxis::horizontal, FovAxis::vertical};

/// The enumerator as it is written above: name_of(Bsdf::mirror) is "mirror". Exception: an emitting
/// triangle is a "mesh".
std::string_view name_of(Shape shape);
std::string_view name_of(Bsdf bsdf);
std::string_view name_of(EmitterKind kind);
std::string_view name_of(Strategy strategy);
std::string_view name_of(FovAxis axis);

} // namespace scenes
