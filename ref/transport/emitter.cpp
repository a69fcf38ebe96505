#include "ref/transport/emitter.h"

#include "ref/transport/emitter_choice.h"
#include "ref/trees/scaled_length.h"
#include "scenes/bounds.h"
#include "scenes/contacts.h"

#include <algorithm>
#include <cmath>

namespace ref {

namespace {

constexpr std::uint32_t not_an_emitter = ~0u;

double average(const Rgb& v)
{
    return (v.x + v.y + v.z) / 3.0;
}

const Rgb* emission_of(const scenes::Scene& scene, std::uint32_t material)
{
    const auto* emission = std::get_if<scenes::Emission>(&scene.materials[material]);
    return emission != nullptr ? &emission->radiance : nullptr;
}

/// Integral of cos^exponent over the cone: 2 pi (1 - c^(n+1)) / (n+1), where the lobe ends at the
/// horizon at the latest unless it is constant.
double spot_solid_angle(const scenes::SpotLight& light)
{
    const double c = light.exponent > 0.0 ? std::max(0.0, light.cos_cutoff) : light.cos_cutoff;
    return 2.0 * pi * (1.0 - std::pow(c, light.exponent + 1.0)) / (light.exponent + 1.0);
}

} // namespace

Emitters::Emitters(const Geometry& geometry) : geometry_(&geometry)
{
    const scenes::Scene& scene = geometry.scene();
    std::vector<double> powers; // W
    const auto add = [&](EmitterKind kind, std::size_t index, double area, double power) {
        all_.push_back({kind, static_cast<std::uint32_t>(index), area, 0.0, {}});
        powers.push_back(power);
    };

    if (const auto box = scenes::bounds(scene)) {
        center_ = (box->min + box->max) / 2.0;
        radius_ = glm::length(box->max - box->min) / 2.0;
    }

    // Power of a one-sided diffuse surface: pi A L.
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        if (const Rgb* radiance = emission_of(scene, scene.triangles[i].material)) {
            const auto& v = scene.triangles[i].vertices;
            const double area = scaled_length(glm::cross(v[1] - v[0], v[2] - v[0])) / 2.0;
            add(EmitterKind::triangle, i, area, pi * area * average(*radiance));
        }
    for (std::size_t i = 0; i < scene.spheres.size(); ++i)
        if (const Rgb* radiance = emission_of(scene, scene.spheres[i].material)) {
            const double area = 4.0 * pi * scene.spheres[i].radius * scene.spheres[i].radius;
            add(EmitterKind::sphere, i, area, pi * area * average(*radiance));
        }
    for (std::size_t i = 0; i < scene.point_lights.size(); ++i)
        add(EmitterKind::point, i, 0.0, 4.0 * pi * average(scene.point_lights[i].intensity));
    for (std::size_t i = 0; i < scene.spot_lights.size(); ++i)
        add(EmitterKind::spot, i, 0.0,
            spot_solid_angle(scene.spot_lights[i]) * average(scene.spot_lights[i].intensity));
    // What comes from infinity counts as far as it falls on a sphere around the scene.
    const double disc = pi * radius_ * radius_;
    for (std::size_t i = 0; i < scene.directional_lights.size(); ++i)
        add(EmitterKind::directional, i, 0.0, disc * average(scene.directional_lights[i].irradiance));
    if (scene.environment)
        add(EmitterKind::environment, 0, 0.0, 4.0 * pi * disc * average(*scene.environment));

    for (Emitter& emitter : all_) {
        if (emitter.kind == EmitterKind::point)
            emitter.on = scenes::surfaces_at(scene, scene.point_lights[emitter.index].position);
        if (emitter.kind == EmitterKind::spot)
            emitter.on = scenes::surfaces_at(scene, scene.spot_lights[emitter.index].position);
    }

    borders_ = choice_borders(powers);
    by_primitive_.assign(scenes::primitive_count(scene), not_an_emitter);
    for (std::size_t i = 0; i < all_.size(); ++i) {
        Emitter& emitter = all_[i];
        emitter.probability = borders_[i] - (i > 0 ? borders_[i - 1] : 0.0);
        if (emitter.kind == EmitterKind::triangle)
            by_primitive_[emitter.index] = static_cast<std::uint32_t>(i);
        if (emitter.kind == EmitterKind::sphere)
            by_primitive_[scene.triangles.size() + emitter.index] = static_cast<std::uint32_t>(i);
    }
}

const Emitter* Emitters::choose(double u) const
{
    // The first border beyond u: never that of an emitter of no power, which is the one before it.
    const auto chosen = std::upper_bound(borders_.begin(), borders_.end(), u);
    return chosen != borders_.end() ? &all_[static_cast<std::size_t>(chosen - borders_.begin())]
                                    : nullptr;
}

const Emitter* Emitters::of_primitive(std::uint32_t primitive) const
{
    const std::uint32_t emitter = by_primitive_[primitive];
    return emitter != not_an_emitter ? &all_[emitter] : nullptr;
}

const Emitter* Emitters::environment() const
{
    return scene().environment ? &all_.back() : nullptr;
}

Rgb emitted_radiance(const scenes::Scene& scene, const SurfacePoint& point, const Vec3& wo)
{
    const Rgb* radiance = emission_of(scene, point.material);
    return radiance != nullptr && glm::dot(point.normal, wo) > 0.0 ? *radiance : Rgb(0.0);
}

Rgb spot_intensity(const scenes::SpotLight& light, const Vec3& w)
{
    const double cosine = glm::dot(light.direction, w);
    if (cosine <= light.cos_cutoff) return Rgb(0.0);
    if (light.exponent == 0.0) return light.intensity;
    return cosine > 0.0 ? light.intensity * std::pow(cosine, light.exponent) : Rgb(0.0);
}

SurfacePoint sample_surface(const Geometry& geometry, const Emitter& emitter, double u1, double u2)
{
    if (emitter.kind == EmitterKind::triangle)
        return triangle_point(geometry, emitter.index, sample_triangle(u1, u2));
    return sphere_point(geometry, emitter.index, sample_sphere(u1, u2));
}

std::optional<IncidentLight> sample_incident(const Emitters& emitters, const Vec3& from,
                                             const Uniforms& u)
{
    const scenes::Scene& scene = emitters.scene();
    const Emitter* emitter = emitters.choose(u[0]);
    if (emitter == nullptr) return std::nullopt;

    const auto towards_point = [&](const Vec3& position) {
        SurfacePoint end{};
        end.position = position;
        return IncidentLight{
            emitter, glm::normalize(position - from), Rgb(0.0), emitter->probability, true, end, false};
    };
    const auto distance2 = [&](const Vec3& position) {
        return glm::dot(position - from, position - from);
    };

    IncidentLight light{};
    switch (emitter->kind) {
    case EmitterKind::triangle:
    case EmitterKind::sphere: {
        const SurfacePoint end = sample_surface(emitters.geometry(), *emitter, u[1], u[2]);
        const Vec3 wi = glm::normalize(end.position - from);
        light = {emitter,
                 wi,
                 emitted_radiance(scene, end, -wi),
                 pdf_solid_angle_incident(emitters, from, end),
                 false,
                 end,
                 false};
        break;
    }
    case EmitterKind::point: {
        const auto& point = scene.point_lights[emitter->index];
        light = towards_point(point.position);
        light.radiance = point.intensity / distance2(point.position);
        break;
    }
    case EmitterKind::spot: {
        const auto& spot = scene.spot_lights[emitter->index];
        light = towards_point(spot.position);
        light.radiance = spot_intensity(spot, -light.wi) / distance2(spot.position);
        break;
    }
    case EmitterKind::directional: {
        const auto& sun = scene.directional_lights[emitter->index];
        light = {emitter, -sun.direction, sun.irradiance, emitter->probability, true, {}, true};
        break;
    }
    case EmitterKind::environment:
        light = {emitter,
                 sample_sphere(u[1], u[2]),
                 *scene.environment,
                 emitter->probability * pdf_solid_angle_sphere,
                 false,
                 {},
                 true};
        break;
    }
    if (light.radiance == Rgb(0.0) || !(light.pdf > 0.0)) return std::nullopt;
    return light;
}

double pdf_solid_angle_incident(const Emitters& emitters, const Vec3& from, const SurfacePoint& point)
{
    const Emitter* emitter = emitters.of_primitive(point.primitive);
    if (emitter == nullptr || emitter->area == 0.0) return 0.0;
    return area_to_solid_angle(emitter->probability / emitter->area, from, point.position, point.normal);
}

double pdf_solid_angle_environment(const Emitters& emitters)
{
    const Emitter* environment = emitters.environment();
    return environment != nullptr ? environment->probability * pdf_solid_angle_sphere : 0.0;
}

} // namespace ref
