#include "scenes/collada/materials.h"

#include "scenes/collada/numbers.h"

#include <string_view>

namespace scenes::collada {
namespace {

Glass read_glass(const Element& glass)
{
    check_children(glass, {"reflectance", "transmittance", "roughness", "ior"});
    if (const Element* roughness = optional_child(glass, "roughness");
        roughness && number(*roughness) != 0)
        fail(*roughness, "only smooth glass (roughness 0) is supported");
    const Element& ior = required_child(glass, "ior");
    if (!(number(ior) > 0)) fail(ior, "an index of refraction is positive");
    return {reflection_color(required_child(glass, "reflectance")),
            reflection_color(required_child(glass, "transmittance")), number(ior)};
}

Material read_cmu462(const Element& technique)
{
    check_children(technique, {"mirror", "glass", "emission", "refraction"});
    const Element& kind = *technique.FirstChildElement();
    if (const Element* second = kind.NextSiblingElement())
        fail(*second, "a second material beside " + describe(kind));
    const std::string_view name = kind.Name();
    if (name == "refraction")
        fail(kind, "a boundary that only refracts is not supported: <glass> reflects as well");
    if (name == "glass") return read_glass(kind);
    if (name == "mirror") {
        check_children(kind, {"reflectance"});
        return Mirror{reflection_color(required_child(kind, "reflectance"))};
    }
    check_children(kind, {"radiance"});
    return Emission{emission_color(required_child(kind, "radiance"))};
}

/// The <color> of a channel such as <diffuse>; null if the shader has no such channel.
const Element* channel_color(const Element& shader, const char* channel)
{
    const Element* element = optional_child(shader, channel);
    if (element == nullptr) return nullptr;
    if (const Element* texture = element->FirstChildElement("texture"))
        fail(*texture, "textures are not supported");
    check_children(*element, {"color"});
    return &required_child(*element, "color");
}

/// Many files contain <transparent> and <transparency> only to state that the surface is opaque.
void refuse_transparency(const Element& shader)
{
    const Element* color = channel_color(shader, "transparent");
    const Element* factor = optional_child(shader, "transparency");
    if (color == nullptr) return; // a factor alone has nothing to scale
    const char* opaque = color->Parent()->ToElement()->Attribute("opaque");
    const bool alpha_counts = opaque == nullptr || std::string_view(opaque) == "A_ONE";
    const bool alpha_is_one = numbers(*color, 4)[3] == 1;
    const bool factor_is_one = factor == nullptr || number(required_child(*factor, "float")) == 1;
    if (!(alpha_counts && alpha_is_one && factor_is_one))
        fail(*color->Parent()->ToElement(),
             "transparency is not supported: use <glass> of the CMU462 profile");
}

Material read_common(const Element& effect)
{
    const Element& profile = required_child(effect, "profile_COMMON");
    check_children(profile, {"image", "newparam", "technique"});
    const Element& technique = required_child(profile, "technique");
    check_children(technique, {"image", "newparam", "phong", "lambert", "blinn", "constant"});
    const Element* shader = nullptr;
    for (const char* name : {"phong", "lambert", "blinn", "constant"})
        if (const Element* found = optional_child(technique, name)) {
            if (shader != nullptr) fail(*found, "a second shader beside " + describe(*shader));
            shader = found;
        }
    if (shader == nullptr) fail(technique, "no <phong>, <lambert>, <blinn> or <constant> in it");
    check_children(*shader, {"emission", "ambient", "diffuse", "specular", "shininess", "reflective",
                             "reflectivity", "transparent", "transparency", "index_of_refraction"});
    refuse_transparency(*shader);

    const Element* diffuse = channel_color(*shader, "diffuse");
    const Rgb albedo = diffuse ? reflection_color(*diffuse, Alpha::ignored) : Rgb(0.0);
    if (const Element* emission = channel_color(*shader, "emission")) {
        const Rgb radiance = emission_color(*emission, Alpha::ignored);
        if (radiance != Rgb(0.0)) {
            if (albedo != Rgb(0.0))
                fail(*emission, "a surface that emits and reflects is not supported");
            return Emission{radiance};
        }
    }
    if (diffuse == nullptr) fail(*shader, "no <diffuse> in it, and no material of the CMU462 profile");
    return Lambertian{albedo};
}

} // namespace

Material read_material(const Document& document, const Element& material)
{
    check_children(material, {"instance_effect"});
    const Element& instance = required_child(material, "instance_effect");
    check_children(instance, {"technique_hint"}); // <setparam> would change a parameter
    const Element& effect = document.target(instance, "url", "effect");
    check_children(effect,
                   {"annotate", "image", "newparam", "profile_COMMON", "profile_BRIDGE", "profile_CG",
                    "profile_GLES", "profile_GLES2", "profile_GLSL"},
                   Cmu462::understood);
    const Element* technique = cmu462_technique(effect);
    return technique ? read_cmu462(*technique) : read_common(effect);
}

std::uint32_t Materials::index_of(const Element& material)
{
    const auto known = indices_.find(&material);
    return known != indices_.end() ? known->second : add(material, read_material(*document_, material));
}

std::uint32_t Materials::index_of(const Element& light, const Rgb& radiance)
{
    const auto known = indices_.find(&light);
    return known != indices_.end() ? known->second : add(light, Emission{radiance});
}

std::uint32_t Materials::index_of_default()
{
    if (!default_) default_ = append("default", Lambertian{Rgb(0.5)});
    return *default_;
}

std::uint32_t Materials::add(const Element& element, const Material& material)
{
    const char* id = element.Attribute("id");
    return indices_.emplace(&element, append(id ? id : "", material)).first->second;
}

std::uint32_t Materials::append(const std::string& name, const Material& material)
{
    const auto index = static_cast<std::uint32_t>(scene_->materials.size());
    scene_->materials.push_back(material);
    scene_->material_names.push_back(name);
    return index;
}

} // namespace scenes::collada
