#pragma once

// What a scene asks of a renderer. The fast path compiles kernels for what is asked and drops the rest.

#include "scenes/scene.h"

#include <array>
#include <set>
#include <string_view>

namespace scenes {

enum class Shape { triangle, sphere };
enum class Bsdf { lambertian, mirror, glass };
enum class Emitter { mesh, sphere, point, directional, spot, environment };

// Enumerators are numbered from 0 in the order of all_of, which name_of relies on.

/// The four families of bidirectional strategies, s vertices on the light subpath and t on the eye
/// subpath [Veach 1997, sec. 10.2]:
///   emission_hit      s = 0, t >= 2   the eye walk runs into an emitter
///   next_event        s = 1, t >= 2   an eye vertex is joined to a fresh point on an emitter
///   light_image       s >= 1, t = 1   a light vertex is joined to the pinhole
///   inner_connection  s >= 2, t >= 2  an eye vertex is joined to a light vertex
enum class Strategy { emission_hit, next_event, light_image, inner_connection };

/// All enumerators of an enumeration, in order: all_of<Shape>.
template <class Enumeration>
constexpr std::array<Enumeration, 0> all_of{};
template <>
inline constexpr std::array all_of<Shape>{Shape::triangle, Shape::sphere};
template <>
inline constexpr std::array all_of<Bsdf>{Bsdf::lambertian, Bsdf::mirror, Bsdf::glass};
template <>
inline constexpr std::array all_of<Emitter>{Emitter::mesh,        Emitter::sphere, Emitter::point,
                                            Emitter::directional, Emitter::spot,   Emitter::environment};
template <>
inline constexpr std::array all_of<Strategy>{Strategy::emission_hit, Strategy::next_event,
                                             Strategy::light_image, Strategy::inner_connection};
template <>
inline constexpr std::array all_of<FovAxis>{FovAxis::horizontal, FovAxis::vertical};

/// The enumerator as it is written in this file: name_of(Bsdf::mirror) is "mirror".
std::string_view name_of(Shape shape);
std::string_view name_of(Bsdf bsdf);
std::string_view name_of(Emitter emitter);
std::string_view name_of(Strategy strategy);
std::string_view name_of(FovAxis axis);

/// What a scene uses. `strategies` holds those that can carry light for some path in it, as far as
/// materials and emitters alone can tell (see requirements.cpp); visibility is not considered.
struct Requirements {
    std::set<Shape> shapes;
    std::set<Bsdf> bsdfs;
    std::set<Emitter> emitters;
    std::set<Strategy> strategies;
    std::set<FovAxis> fov_axes; // empty without a camera
};

/// What `scene` requires.
Requirements requirements(const Scene& scene);

} // namespace scenes
