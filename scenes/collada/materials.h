#pragma once

// Materials: the CMU462 profile of an effect, or else the diffuse colour of the common profile.

#include "scenes/collada/document.h"
#include "scenes/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>

namespace scenes::collada {

/// Reads a <material>. In this order:
///
/// 1. <extra><technique profile="CMU462"> in its effect: <mirror>, <glass> or <emission>. A rough glass
///    and <refraction> are errors.
/// 2. A non-zero <emission> of the common profile, if <diffuse> is black or absent: emission. With both,
///    the surface would emit and reflect, which no material here does: an error.
/// 3. The <diffuse> colour of the common profile: Lambertian.
///
/// Textures and transparency would change the picture and are errors. The other channels (ambient,
/// specular, shininess, reflective, reflectivity, index_of_refraction) are ignored. This is the
/// convention of the CMU462 files, whose exporter always fills them in.
Material read_material(const Document& document, const Element& material);

/// The materials of a scene: each is read once, when first used.
class Materials {
public:
    Materials(const Document& document, Scene& scene) : document_(&document), scene_(&scene) {}

    /// Index in Scene::materials of the <material> element.
    std::uint32_t index_of(const Element& material);
    /// The same for a luminaire that has no material of its own: the emission of a light element.
    std::uint32_t index_of(const Element& light, const Rgb& radiance);
    /// The same for surfaces without a bound material: Lambertian with albedo 0.5, named "default".
    std::uint32_t index_of_default();

private:
    std::uint32_t add(const Element& element, const Material& material);
    std::uint32_t append(const std::string& name, const Material& material);

    const Document* document_;
    Scene* scene_;
    std::unordered_map<const Element*, std::uint32_t> indices_;
    std::optional<std::uint32_t> default_;
};

} // namespace scenes::collada
