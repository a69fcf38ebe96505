#include "scenes/collada/instances.h"

#include "scenes/collada/bind_material.h"
#include "scenes/collada/cameras.h"
#include "scenes/collada/lights.h"
#include "scenes/is_emitter.h"

#include <glm/geometric.hpp>

#include <string>
#include <variant>

namespace scenes::collada {
namespace {

// 80 bytes each: 1.3 GB. Instances of instances could ask for any number in a file of any size.
constexpr std::size_t most_primitives = std::size_t{1} << 24U;

/// Counter-clockwise seen from the side that it emits to, that of local -z.
const std::vector<Corners> area_light_square = {
    {Vec3(-0.5, -0.5, 0), Vec3(-0.5, 0.5, 0), Vec3(0.5, 0.5, 0)},
    {Vec3(-0.5, -0.5, 0), Vec3(0.5, 0.5, 0), Vec3(0.5, -0.5, 0)},
};

Vec3 world_position(const Matrix& to_world, const Element& instance)
{
    const Vec3 position = transform_point(to_world, Vec3(0.0));
    if (!is_finite(position)) fail(instance, "the transform of its node takes it to infinity");
    return position;
}

Vec3 world_direction(const Matrix& to_world, const Vec3& local, const Element& instance)
{
    const Vec3 direction = unit(transform_direction(to_world, local));
    if (!is_finite(direction)) fail(instance, "the transform of its node leaves it no direction");
    return direction;
}

LinearPart invertible_part(const Matrix& to_world, const Element& instance)
{
    LinearPart linear(to_world);
    if (linear.singular) fail(instance, "the transform of its node has no inverse");
    return linear;
}

std::string instance_with_line(const Element& instance)
{
    return "the instance in line " + std::to_string(instance.GetLineNum());
}

/// Why `part` has no material in `instance`; nothing to add if it names no symbol.
std::string why_unbound(const Part& part, const Element& instance)
{
    if (part.element->Attribute("material") == nullptr) return "";
    return instance_with_line(instance) + " binds none to its symbol: ";
}

} // namespace

void Instances::add_geometry(const Element& instance, const Matrix& to_world)
{
    check_children(instance, {"bind_material"});
    const Element& element = document_->target(instance, "url", "geometry");
    const Geometry& geometry = geometries_.get(element);
    if (const auto* sphere = std::get_if<LocalSphere>(&geometry))
        add_sphere(*sphere, element, instance, to_world);
    else
        add_mesh(std::get<Mesh>(geometry), instance, to_world);
}

void Instances::add_mesh(const Mesh& mesh, const Element& instance, const Matrix& to_world)
{
    if (parts_ == Parts::geometry) {
        for (const Part& part : mesh)
            if (!part.triangles.empty()) add_triangles(part.triangles, 0, instance, to_world);
        return;
    }
    const MaterialBinding binding(*document_, instance);
    for (const Part& part : mesh) {
        if (part.triangles.empty()) continue;
        const Element* const bound = binding.material_of(*part.element);
        const std::uint32_t material =
            bound ? materials_.index_of(*bound)
                  : default_material(*part.element, why_unbound(part, instance));
        add_triangles(part.triangles, material, instance, to_world);
    }
}

std::uint32_t Instances::default_material(const Element& surface, const std::string& why)
{
    if (noticed_without_material_.insert(&surface).second)
        scene_->notices.push_back(place(surface) + "no material: " + why +
                                  "the default, Lambertian with albedo 0.5, is used");
    return materials_.index_of_default();
}

void Instances::add_triangles(const std::vector<Corners>& triangles, std::uint32_t material,
                              const Element& instance, const Matrix& to_world)
{
    const LinearPart linear = invertible_part(to_world, instance);
    check_room(triangles.size(), instance);
    for (const Corners& corners : triangles) {
        std::array<Vec3, 3> world{};
        for (std::size_t i = 0; i < 3; ++i) {
            world[i] = transform_point(to_world, corners[i]);
            if (!is_finite(world[i]))
                fail(instance, "the transform of its node takes a vertex to infinity");
        }
        if (linear.mirrored) std::swap(world[1], world[2]);
        scene_->triangles.push_back({world, material});
    }
}

void Instances::add_sphere(const LocalSphere& sphere, const Element& geometry, const Element& instance,
                           const Matrix& to_world)
{
    const LinearPart linear = invertible_part(to_world, instance);
    if (!linear.uniform || !linear.orthogonal)
        fail(instance, "an ellipsoid: the transform of its node stretches a sphere by " +
                           std::to_string(linear.lengths.x) + ", " + std::to_string(linear.lengths.y) +
                           ", " + std::to_string(linear.lengths.z) +
                           (linear.orthogonal ? "" : " and shears it"));
    check_room(1, instance);
    const double scale = (linear.lengths.x + linear.lengths.y + linear.lengths.z) / 3;
    const std::uint32_t material = sphere_material(geometry, instance);
    const Sphere world{world_position(to_world, instance), scale * sphere.radius, material};
    if (!(world.radius > 0) || !is_finite(Vec3(world.radius)))
        fail(instance, "the transform of its node leaves the sphere no finite radius");
    scene_->spheres.push_back(world);
}

std::uint32_t Instances::sphere_material(const Element& geometry, const Element& instance)
{
    if (parts_ == Parts::geometry) return 0;
    const Element* const bound = MaterialBinding(*document_, instance).only_material();
    return bound ? materials_.index_of(*bound)
                 : default_material(geometry, instance_with_line(instance) + " binds none: ");
}

void Instances::check_room(std::size_t more, const Element& instance) const
{
    if (primitive_count(*scene_) + more > most_primitives)
        fail(instance, "more than " + std::to_string(most_primitives) + " triangles and spheres");
}

void Instances::add_light(const Element& instance, const Matrix& to_world)
{
    if (parts_ == Parts::geometry) return;
    check_children(instance, {});
    const Element& element = document_->target(instance, "url", "light");
    const Light light = read_light(element);
    if (const auto* area = std::get_if<AreaLight>(&light)) {
        area_lights_.push_back({&instance, &element, area->radiance, to_world});
    } else if (const auto* ambient = std::get_if<AmbientLight>(&light)) {
        scene_->environment = scene_->environment.value_or(Rgb(0.0)) + ambient->radiance;
        if (!is_finite(*scene_->environment)) fail(instance, "the ambient lights add up to infinity");
    } else if (const auto* point = std::get_if<PointLight>(&light)) {
        scene_->point_lights.push_back({world_position(to_world, instance), point->intensity});
    } else if (const auto* directional = std::get_if<DirectionalLight>(&light)) {
        const Vec3 direction = world_direction(to_world, directional->direction, instance);
        scene_->directional_lights.push_back({direction, directional->irradiance});
    } else {
        SpotLight spot = std::get<SpotLight>(light);
        spot.position = world_position(to_world, instance);
        spot.direction = world_direction(to_world, spot.direction, instance);
        scene_->spot_lights.push_back(spot);
    }
}

void Instances::add_camera(const Element& instance, const Matrix& to_world)
{
    if (parts_ == Parts::all) {
        place_camera(instance, to_world);
        return;
    }
    try {
        place_camera(instance, to_world);
    } catch (const SceneError& error) { // trees need no camera
        scene_->notices.push_back(error.what() + std::string(": this camera is not used"));
    }
}

void Instances::place_camera(const Element& instance, const Matrix& to_world)
{
    if (!scene_->camera) {
        check_children(instance, {});
        const Element& camera = document_->target(instance, "url", "camera");
        scene_->camera = read_camera(camera, instance, to_world, scene_->notices);
    } else if (!other_cameras_noticed_) {
        scene_->notices.push_back(place(instance) + "ignored, like every camera but the first");
        other_cameras_noticed_ = true;
    }
}

void Instances::finish()
{
    if (parts_ == Parts::geometry) return;
    if (has_emissive_geometry(*scene_)) {
        if (!area_lights_.empty())
            scene_->notices.push_back(
                place(*area_lights_.front().instance) +
                "skipped, like every area light: the scene has emissive geometry, of which "
                "they are a second description");
    } else {
        for (const AreaLightInstance& area : area_lights_)
            add_triangles(area_light_square, materials_.index_of(*area.light, area.radiance),
                          *area.instance, area.to_world);
    }
    if (!has_emitter(*scene_))
        scene_->notices.push_back(place(document_->root()) + "no emitter: the picture will be black");
}

} // namespace scenes::collada
