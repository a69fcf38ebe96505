#include "check/renderers/features.h"

#include <array>
#include <utility>

namespace check {

namespace {

// A word alone must be clear: a sphere may emit or not, a mesh is made of triangles.

Feature feature_of(scenes::Shape shape)
{
    switch (shape) {
    case scenes::Shape::triangle:
        return {name_of(shape), "triangles"};
    case scenes::Shape::sphere:
        return {name_of(shape), "spheres"};
    }
    return {};
}

Feature feature_of(scenes::Bsdf bsdf)
{
    switch (bsdf) {
    case scenes::Bsdf::lambertian:
        return {name_of(bsdf), "Lambertian surfaces"};
    case scenes::Bsdf::mirror:
        return {name_of(bsdf), "a mirror"};
    case scenes::Bsdf::glass:
        return {name_of(bsdf), "glass"};
    }
    return {};
}

Feature feature_of(scenes::EmitterKind kind)
{
    switch (kind) {
    case scenes::EmitterKind::triangle:
        return {"mesh_emitter", "a mesh that emits"};
    case scenes::EmitterKind::sphere:
        return {"sphere_emitter", "a sphere that emits"};
    case scenes::EmitterKind::point:
        return {"point", "a point light"};
    case scenes::EmitterKind::directional:
        return {"directional", "a directional light"};
    case scenes::EmitterKind::spot:
        return {"spot", "a spot light"};
    case scenes::EmitterKind::environment:
        return {"environment", "an environment"};
    }
    return {};
}

Feature feature_of(scenes::Strategy strategy)
{
    switch (strategy) {
    case scenes::Strategy::emission_hit:
        return {name_of(strategy), "emitters that a ray can hit"};
    case scenes::Strategy::next_event:
        return {name_of(strategy), "light that next-event estimation finds"};
    case scenes::Strategy::light_image:
        return {name_of(strategy), "light that paths from the emitters bring to the pinhole"};
    case scenes::Strategy::inner_connection:
        return {name_of(strategy), "light that connections of two subpaths find"};
    }
    return {};
}

Feature feature_of(scenes::FovAxis axis)
{
    return axis == scenes::FovAxis::horizontal
               ? Feature{"fov_horizontal", "a horizontal field of view (xfov)"}
               : Feature{"fov_vertical", "a vertical field of view (yfov)"};
}

template <class Enumeration>
void add_all(std::vector<Feature>& features)
{
    for (const Enumeration one : scenes::all_of<Enumeration>) features.push_back(feature_of(one));
}

template <class Enumeration>
void add_names(std::set<std::string>& names, const std::set<Enumeration>& required)
{
    for (const Enumeration one : required) names.emplace(feature_of(one).name);
}

} // namespace

std::vector<Feature> all_features()
{
    std::vector<Feature> features;
    add_all<scenes::Shape>(features);
    add_all<scenes::Bsdf>(features);
    add_all<scenes::EmitterKind>(features);
    add_all<scenes::Strategy>(features);
    add_all<scenes::FovAxis>(features);
    return features;
}

std::set<std::string> feature_names(const scenes::Requirements& required)
{
    std::set<std::string> names;
    add_names(names, required.shapes);
    add_names(names, required.bsdfs);
    add_names(names, required.emitters);
    add_names(names, required.strategies);
    add_names(names, required.fov_axes);
    return names;
}

} // namespace check
