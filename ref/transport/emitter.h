#pragma once

// Emitters, and light drawn for a point (next event). Every emissive triangle, every emissive sphere,
// every point, directional and spot light, and the environment is one emitter. A sample chooses one of
// them (emitter_choice.h). How one kind differs from another is in emitter_kinds.h.

#include "ref/transport/emitter_kinds.h"
#include "ref/transport/random.h"
#include "ref/transport/sampling.h"
#include "ref/trees/geometry.h"
#include "scenes/scene.h"

#include <optional>
#include <vector>

namespace ref {

/// One emitter: the `index`-th of its kind in the scene.
struct Emitter {
    EmitterKind kind;
    std::uint32_t index;
    double area;        // of a surface, in the square of the scene's unit of length; else 0
    double probability; // of being chosen (emitter_choice.h); 0 if it has no power
    std::vector<std::uint32_t> on = {}; // of a source: the surfaces that it lies on
};

/// Light that may reach a point: the outcome of sampling an emitter for next-event estimation.
struct IncidentLight {
    const Emitter* emitter;
    Vec3 wi;          // unit direction from the point towards the light
    Rgb radiance;     // W m^-2 sr^-1; for a delta emitter its irradiance on a surface facing it (W m^-2)
    double pdf;       // per solid angle, choice of emitter included; of the choice alone if `delta`
    bool delta;       // no ray can meet this emitter by chance
    SurfacePoint end; // where the light leaves; of no meaning if the light is infinitely far away
    bool infinite;
};

/// The emitters of a scene. Keeps a reference to its geometry, which must outlive it.
class Emitters {
public:
    /// Throws std::invalid_argument as choice_borders does.
    explicit Emitters(const Geometry& geometry);

    [[nodiscard]] const std::vector<Emitter>& all() const { return all_; }
    [[nodiscard]] const Geometry& geometry() const { return *geometry_; }
    [[nodiscard]] const scenes::Scene& scene() const { return geometry_->scene(); }
    /// Centre and radius of a sphere around all geometry: what infinitely distant emitters shine on.
    [[nodiscard]] const Vec3& center() const { return center_; }
    [[nodiscard]] double radius() const { return radius_; }

    /// The emitter in whose part of (0, 1) `u` falls, or none if no emitter has any power.
    [[nodiscard]] const Emitter* choose(double u) const;
    /// The emitter that is primitive `primitive`, or none if it does not emit.
    [[nodiscard]] const Emitter* of_primitive(std::uint32_t primitive) const;
    /// The environment, or none.
    [[nodiscard]] const Emitter* environment() const;

private:
    const Geometry* geometry_;
    Vec3 center_{0.0};
    double radius_ = 0.0;
    std::vector<Emitter> all_;
    std::vector<double> borders_; // of the parts of (0, 1) that choose them
    std::vector<std::uint32_t> by_primitive_;
};

/// Radiance (W m^-2 sr^-1) that leaves `point` towards the unit direction `wo`: 0 unless its material
/// emits and wo is on the side of the normal.
Rgb emitted_radiance(const scenes::Scene& scene, const SurfacePoint& point, const Vec3& wo);

/// A uniform point on the surface of `emitter`, which must be a triangle or a sphere.
SurfacePoint sample_surface(const Geometry& geometry, const Emitter& emitter, double u1, double u2);

/// Draws light for the point `from`, by the first three numbers of `u`: emitter, then a point of its
/// surface uniform in area (environment: a direction uniform on the sphere). None if there is no power,
/// or the light would leave its emitter on the dark side.
std::optional<IncidentLight> sample_incident(const Emitters& emitters, const Vec3& from,
                                             const Uniforms& u);

/// The density (sr^-1, choice of emitter included) with which `sample_incident` at `from` would draw the
/// direction to `point`, which lies on an emissive surface.
double pdf_solid_angle_incident(const Emitters& emitters, const Vec3& from, const SurfacePoint& point);

/// The same for a direction in which a ray meets nothing but the environment.
double pdf_solid_angle_environment(const Emitters& emitters);

/// Converts a density on a surface to one of directions seen from `from` [Veach 1997, eq. 8.10].
inline double area_to_solid_angle(double pdf_area, const Vec3& from, const Vec3& point,
                                  const Vec3& normal)
{
    const Vec3 d = point - from;
    const double distance2 = glm::dot(d, d);
    const double cosine = std::abs(glm::dot(normal, d)) / std::sqrt(distance2);
    return cosine > 0.0 ? pdf_area * distance2 / cosine : 0.0; // map: area-conversion
}

} // namespace ref
