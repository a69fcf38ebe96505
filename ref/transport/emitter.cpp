#include "ref/transport/emitter.h"

#include "ref/transport/emitter_choice.h"
#include "ref/trees/scaled_length.h"
#include "scenes/bounds.h"
#include "scenes/contacts.h"
#include "scenes/for_each_light.h"

#include <algorithm>
#include <cmath>

namespace ref {

namespace {

constexpr std::uint32_t not_an_emitter = ~0u;

const Rgb* emission_of(const scenes::Scene& scene, std::uint32_t material)
{
    const auto* emission = std::get_if<scenes::Emission>(&scene.materials[material]);
    return emission != nullptr ? &emission->radiance : nullptr;
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
    // Of light from infinity, the power is that which falls on a sphere around the scene.
    const double disc_area = pi * radius_ * radius_;
    scenes::for_each_light(scene, [&](const auto& light, std::size_t i) {
        if constexpr (scenes::has_position<decltype(light)>) {
            add(kind_of(light), i, 0.0, power(light));
            all_.back().on = scenes::surfaces_at(scene, light.position);
        } else {
            add(kind_of(light), i, 0.0, power(light, disc_area));
        }
    });
    if (scene.environment)
        add(EmitterKind::environment, 0, 0.0, power(Environment{*scene.environment}, disc_area));

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
    // map: emitted-radiance
    return radiance != nullptr && glm::dot(point.normal, wo) > 0.0 ? *radiance : Rgb(0.0);
}

SurfacePoint sample_surface(const Geometry& geometry, const Emitter& emitter, double u1, double u2)
{
    if (emitter.kind == EmitterKind::triangle)
        return triangle_point(geometry, emitter.index, sample_triangle(u1, u2));
    return sphere_point(geometry, emitter.index, sample_sphere(u1, u2)); // map: emission-sphere
}

std::optional<IncidentLight> sample_incident(const Emitters& emitters, const Vec3& from,
                                             const Uniforms& u)
{
    const scenes::Scene& scene = emitters.scene();
    const Emitter* emitter = emitters.choose(u[0]);
    if (emitter == nullptr) return std::nullopt;

    IncidentLight light{};
    if (is_surface(emitter->kind)) {
        const SurfacePoint end = sample_surface(emitters.geometry(), *emitter, u[1], u[2]);
        const Vec3 wi = glm::normalize(end.position - from);
        light = {emitter,
                 wi,
                 emitted_radiance(scene, end, -wi),
                 pdf_solid_angle_incident(emitters, from, end),
                 false,
                 end,
                 false};
    } else if (is_at_infinity(emitter->kind)) {
        visit_distant(scene, emitter->kind, emitter->index, [&](const auto& distant) {
            light = {emitter,
                     sample_towards(distant, u[1], u[2]),
                     emitted(distant),
                     emitter->probability * pdf_towards(emitter->kind),
                     !can_be_hit(emitter->kind),
                     {},
                     true};
        });
    } else {
        visit_source(scene, emitter->kind, emitter->index, [&](const auto& source) {
            const Vec3 d = source.position - from;
            SurfacePoint end{};
            end.position = source.position;
            const Vec3 wi = glm::normalize(d);
            const Rgb irradiance = intensity(source, -wi) / glm::dot(d, d);
            light = {emitter, wi, irradiance, emitter->probability, true, end, false};
        });
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
