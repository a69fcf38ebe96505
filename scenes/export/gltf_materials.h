#pragma once

// The materials of a glTF file.

#include "scenes/scene.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace scenes::exports {

/// Light as glTF writes it: a colour of components from 0 to 1, times `scale`, a power of two. Their
/// product is exact.
struct ScaledColour {
    Rgb colour;
    double scale;
};

/// `light` so split. It must not be black.
ScaledColour split(const Rgb& light);

/// Collects materials while meshes are written.
class GltfMaterials {
public:
    explicit GltfMaterials(const Scene& scene) : scene_(&scene) {}

    /// The index in the file of the material with the index `material` in the scene. Throws SceneError
    /// for one that glTF cannot say.
    std::size_t add(std::uint32_t material);

    /// The index in the file of the back of all emitters: black, one-sided.
    std::size_t add_back();

    /// The extensions that the materials use.
    [[nodiscard]] std::vector<std::string> extensions() const { return {used_.begin(), used_.end()}; }

    [[nodiscard]] const nlohmann::ordered_json& json() const { return json_; }

private:
    // `name` is for messages.
    nlohmann::ordered_json describe(const Lambertian& lambertian, const std::string& name);
    nlohmann::ordered_json describe(const Mirror& mirror, const std::string& name);
    nlohmann::ordered_json describe(const Glass& glass, const std::string& name);
    nlohmann::ordered_json describe(const Emission& emission, const std::string& name);
    nlohmann::ordered_json matt(const Rgb& albedo);
    void extend(nlohmann::ordered_json& material, const char* extension, const char* name, double value);

    const Scene* scene_;
    nlohmann::ordered_json json_ = nlohmann::ordered_json::array();
    std::optional<std::size_t> back_;
    std::set<std::string> used_;
};

} // namespace scenes::exports
