#pragma once

// The start of a light walk: a point on an emitter, then a direction from it, each with its density.

#include "ref/transport/vertex.h"

#include <optional>

namespace ref {

/// The start of a light walk.
struct SampledEmission {
    Vertex y0;
    Ray ray;   // from y0 (or from far outside the scene) into the scene
    Rgb alpha; // emitted / density, of the position and of the direction: weight of the next vertex
};

/// Draws an emitter and a point of it by the first three numbers of `position`, a direction by the first
/// two of `direction`. An emitter at infinity first draws its direction, then a point of a disc that
/// covers the scene. None if no emitter has power.
std::optional<SampledEmission> sample_emission(const World& world, const Uniforms& position,
                                               const Uniforms& direction);

/// The density with which sample_emission draws the emitter and the point y0: per area on a surface, per
/// solid angle for the environment, a probability for an emitter that is certain once it is chosen.
double pdf_emission_position(const Vertex& y0);

/// The density of the next vertex, given y0: per area at `y1`.
double pdf_area_emission_direction(const World& world, const Vertex& y0, const Vertex& y1);

/// The light that y0 emits towards `y1` (which is not at infinity): radiance (W m^-2 sr^-1) of a surface
/// or the environment, intensity (W sr^-1) of a point or spot light, irradiance (W m^-2) of a
/// directional one.
Rgb emitted(const World& world, const Vertex& y0, const Vertex& y1);

/// Whether the eye walk can hit the emitter, and a pinhole see it.
inline bool can_be_hit(const Emitter& emitter)
{
    return can_be_hit(emitter.kind);
}

} // namespace ref
