#include "cuda/scene/scene_arrays.h"

#include "cuda/scene/coincident_arrays.h"
#include "cuda/scene/end_contacts.h"
#include "cuda/transport/emitter_choice.h"
#include "scenes/bounds.h"
#include "scenes/for_each_light.h"
#include "scenes/is_emitter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace fast {

namespace {

/// Collects emitters with their power, and gives them their probabilities in the end.
class EmitterList {
public:
    explicit EmitterList(SceneArrays& arrays) : arrays_(arrays) {}

    void add(EmitterKind kind, std::size_t index, double area, double power, const scenes::Rgb& emitted,
             const Light& light = {})
    {
        arrays_.emitters.push_back(
            {kind, static_cast<std::uint32_t>(index), static_cast<float>(area), 0.0f, Rgb(emitted)});
        arrays_.lights.push_back(light);
        powers_.push_back(power);
    }
    /// Such an emitter cannot be chosen; finish() throws if it would be missed.
    void add_collapsed(EmitterKind kind, std::size_t index, double power)
    {
        add(kind, index, 0, 0, scenes::Rgb(0.0));
        collapsed_power_ += power;
        ++collapsed_;
    }
    /// The number of the emitter that comes next.
    [[nodiscard]] std::uint32_t next() const { return static_cast<std::uint32_t>(powers_.size()); }
    void finish()
    {
        double total = 0;
        for (const double power : powers_) total += power;
        // 2^-20 is far less than any picture shows.
        if (collapsed_power_ > 0x1p-20 * total)
            throw std::invalid_argument(
                std::to_string(collapsed_) +
                " emitting triangle(s) are too small or too thin for single precision, and " +
                std::to_string(100 * collapsed_power_ / (total + collapsed_power_)) +
                "% of the light comes from there");
        arrays_.cumulative = summed_probabilities(powers_);
        if (arrays_.cumulative.empty()) {
            // Nothing can be chosen; but a sky over no surfaces, on which nothing of it falls, is seen.
            for (Surface& surface : arrays_.surfaces) surface.emitter = no_emitter;
            return;
        }
        for (std::size_t i = 0; i < powers_.size(); ++i)
            arrays_.emitters[i].probability =
                arrays_.cumulative[i] - (i > 0 ? arrays_.cumulative[i - 1] : 0.0f);
    }

private:
    SceneArrays& arrays_;
    std::vector<double> powers_;
    double collapsed_power_ = 0;
    std::size_t collapsed_ = 0;
};

/// In the order of the reference, so that the same number chooses the same emitter.
void add_emitters(SceneArrays& arrays, const scenes::Scene& scene, double radius)
{
    EmitterList list(arrays);
    // Intensities are measured by the square of a length.
    const double square = arrays.place.scale * arrays.place.scale;
    const auto emission = [&](std::uint32_t material) {
        return std::get_if<scenes::Emission>(&scene.materials[material]);
    };
    for (std::size_t i = 0; i < scene.triangles.size(); ++i)
        if (const auto* emits = emission(scene.triangles[i].material)) {
            const auto& v = scene.triangles[i].vertices;
            const scenes::Vec3 e1 = arrays.place.scale * (v[1] - v[0]);
            const scenes::Vec3 e2 = arrays.place.scale * (v[2] - v[0]);
            const double area = glm::length(glm::cross(e1, e2)) / 2.0;
            const double power = std::numbers::pi * area * average(emits->radiance);
            arrays.surfaces[i].emitter = list.next();
            if (has_area(scene.triangles[i], arrays.place))
                list.add(EmitterKind::triangle, i, area, power, emits->radiance);
            else
                list.add_collapsed(EmitterKind::triangle, i, power);
        }
    for (std::size_t i = 0; i < scene.spheres.size(); ++i)
        if (const auto* emits = emission(scene.spheres[i].material)) {
            const std::size_t primitive = scene.triangles.size() + i;
            const double radius_here = arrays.place.scale * scene.spheres[i].radius;
            const double area = 4.0 * std::numbers::pi * radius_here * radius_here;
            arrays.surfaces[primitive].emitter = list.next();
            list.add(EmitterKind::sphere, primitive, area,
                     std::numbers::pi * area * average(emits->radiance), emits->radiance);
        }
    // Of light from infinity, the power is that which falls on a sphere around the scene.
    const double disc_area = std::numbers::pi * radius * radius;
    scenes::for_each_light(scene, [&](const auto& light, std::size_t i) {
        if constexpr (scenes::has_position<decltype(light)>)
            list.add(kind_of(light), i, 0, square * power(light), square * light.intensity,
                     as_floats(light, i, arrays.place(light.position)));
        else
            list.add(kind_of(light), i, 0, power(light, disc_area), light.irradiance, as_floats(light));
    });
    arrays.has_environment = scenes::has_environment(scene);
    if (scene.environment)
        list.add(EmitterKind::environment, 0, 0, power_of_environment(*scene.environment, disc_area),
                 *scene.environment);
    list.finish();
}

} // namespace

Placement placement_of(const scenes::Scene& scene)
{
    Placement place;
    if (const auto box = scenes::bounds(scene)) {
        place.origin = box->min / 2.0 + box->max / 2.0;
        const double diameter = glm::length(box->max - box->min);
        int exponent = 1;
        if (diameter > 0.0) std::frexp(diameter, &exponent); // diameter = f 2^exponent, 1/2 <= f < 1
        place.scale = std::ldexp(1.0, 1 - exponent);
    }
    return place;
}

SceneArrays scene_arrays(const scenes::Scene& scene, bool roulette)
{
    SceneArrays arrays;
    arrays.place = placement_of(scene);
    arrays.needs = needs_of(scenes::requirements(scene));
    double radius = 0;
    if (const auto box = scenes::bounds(scene))
        radius = glm::length(box->max - box->min) * arrays.place.scale / 2.0;
    arrays.radius =
        radius > 0.0 ? static_cast<float>(radius) : 1.0f; // without surfaces: any positive number
    arrays.diagonal = static_cast<float>(2.0 * radius);
    arrays.triangles = triangles_of(scene, arrays.place);
    arrays.spheres = spheres_of(scene, arrays.place);
    for (const scenes::Material& material : scene.materials)
        arrays.materials.push_back(material_of(material, roulette));
    for (std::uint32_t i = 0; i < scenes::primitive_count(scene); ++i) {
        const std::uint32_t material = scenes::material_of(scene, i);
        arrays.surfaces.push_back({material, no_emitter});
        if (arrays.materials[material].kind != MaterialKind::emission)
            arrays.largest_survival =
                std::max(arrays.largest_survival, arrays.materials[material].survival);
    }
    add_emitters(arrays, scene, radius);
    add_coincident(arrays, scene);
    arrays.needs.coincident = !arrays.coincident.empty();
    add_clearances(arrays);
    add_end_contacts(arrays, scene);
    return arrays;
}

Camera camera_of(const scenes::Scene& scene, const Placement& place, int width, int height)
{
    const scenes::Camera& source = scene.camera.value();
    const int across = source.fov_axis == scenes::FovAxis::horizontal ? width : height;
    const double pixel_size = 2.0 * std::tan(source.fov / 2.0) / across;
    return {place(source.eye),
            Vec3(source.right),
            Vec3(source.up),
            Vec3(source.backward),
            static_cast<float>(pixel_size),
            static_cast<float>(width * pixel_size * height * pixel_size),
            static_cast<std::uint32_t>(width),
            static_cast<std::uint32_t>(height)};
}

Needs needs_of(const scenes::Requirements& required)
{
    using scenes::Bsdf;
    std::set<scenes::EmitterKind> others = required.emitters;
    others.erase(scenes::EmitterKind::triangle);
    return {required.shapes.contains(scenes::Shape::sphere),
            required.bsdfs.contains(Bsdf::mirror) || required.bsdfs.contains(Bsdf::glass),
            !others.empty(), false};
}

int most_light_vertices(const SceneArrays& arrays, int max_edges)
{
    const double survival = arrays.largest_survival;
    if (!(survival < 1.0)) return max_edges;
    const double bounces = survival > 0.0 ? std::ceil(24.0 * std::log(2.0) / -std::log(survival)) : 0.0;
    return static_cast<int>(std::min<double>(max_edges, bounces_without_roulette + 1 + bounces));
}

} // namespace fast
