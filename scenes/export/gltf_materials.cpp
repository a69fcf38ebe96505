// glTF's material is a metal, or a dielectric under a reflecting surface [glTF 2.0, appendix B].
// KHR_materials_specular removes the surface, which leaves a Lambertian; KHR_materials_transmission and
// KHR_materials_volume make a smooth dielectric that refracts.

#include "scenes/export/gltf_materials.h"

#include "scenes/export/surfaces.h"
#include "scenes/largest_component.h"

#include <cmath>

namespace scenes::exports {
namespace {

using Json = nlohmann::ordered_json;

Json base(const Rgb& colour, double metallic, double roughness)
{
    return {{"pbrMetallicRoughness",
             {{"baseColorFactor", {colour.x, colour.y, colour.z, 1}},
              {"metallicFactor", metallic},
              {"roughnessFactor", roughness}}}};
}

} // namespace

ScaledColour split(const Rgb& light)
{
    int exponent = 0;
    const double largest = largest_component(light);
    // frexp gives [1/2, 1): a power of two itself needs no larger scale.
    if (std::frexp(largest, &exponent) == 0.5) --exponent;
    const double scale = std::ldexp(1.0, exponent);
    return {light / scale, scale};
}

void GltfMaterials::extend(Json& material, const char* extension, const char* name, double value)
{
    material["extensions"][extension][name] = value;
    used_.insert(extension);
}

Json GltfMaterials::matt(const Rgb& albedo)
{
    Json material = base(albedo, 0, 1);
    extend(material, "KHR_materials_specular", "specularFactor", 0);
    return material;
}

Json GltfMaterials::describe(const Lambertian& lambertian, const std::string& /*name*/)
{
    return matt(lambertian.albedo);
}

Json GltfMaterials::describe(const Mirror& mirror, const std::string& name)
{
    if (mirror.reflectance != Rgb(1.0))
        refuse(*scene_, name,
               "glTF has no mirror that absorbs: its metals reflect everything at grazing angles");
    return base(Rgb(1.0), 1, 0);
}

Json GltfMaterials::describe(const Glass& glass, const std::string& name)
{
    if (glass.reflectance != Rgb(1.0))
        refuse(*scene_, name, "glTF has no glass with a reflectance other than 1");
    if (glass.ior < 1.0) refuse(*scene_, name, "glTF has no index of refraction below 1");
    Json json = base(glass.transmittance, 0, 0);
    extend(json, "KHR_materials_transmission", "transmissionFactor", 1);
    extend(json, "KHR_materials_ior", "ior", glass.ior);
    // Any thickness above 0 says that the surface bounds a volume, in which rays are refracted.
    extend(json, "KHR_materials_volume", "thicknessFactor", 1);
    return json;
}

Json GltfMaterials::describe(const Emission& emission, const std::string& /*name*/)
{
    Json json = matt(Rgb(0.0));
    if (!emits(emission)) return json;
    const ScaledColour light = split(emission.radiance);
    json["emissiveFactor"] = {light.colour.x, light.colour.y, light.colour.z};
    if (light.scale != 1.0)
        extend(json, "KHR_materials_emissive_strength", "emissiveStrength", light.scale);
    return json;
}

std::size_t GltfMaterials::add(std::uint32_t material)
{
    const Material& kind = scene_->materials[material];
    const std::string name = material_name(*scene_, material);
    Json json = std::visit([&](const auto& each) { return describe(each, name); }, kind);
    json["doubleSided"] = !emits(kind);
    json["name"] = scene_->material_names[material];
    json_.push_back(std::move(json));
    return json_.size() - 1;
}

std::size_t GltfMaterials::add_back()
{
    if (!back_) {
        Json back = matt(Rgb(0.0));
        back["doubleSided"] = false;
        back["name"] = "back of emitters";
        json_.push_back(back);
        back_ = json_.size() - 1;
    }
    return *back_;
}

} // namespace scenes::exports
