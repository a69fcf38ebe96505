// glTF 2.0 [https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html], with KHR_lights_punctual and the
// extensions of materials that are named below. Light has the same numbers as in the scene: 1 W counts
// as 1 lm (docs/export.md).

#include "scenes/export/gltf.h"

#include "scenes/export/gltf_materials.h"
#include "scenes/export/little_endian.h"
#include "scenes/export/surfaces.h"
#include "scenes/for_each_light.h"
#include "scenes/is_emitter.h"

#include <glm/common.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace scenes::exports {
namespace {

using Json = nlohmann::ordered_json;

// Numbers of the specification, which are those of OpenGL.
constexpr int kind_float = 5126;
constexpr int kind_unsigned = 5125;
constexpr int target_vertices = 34962;
constexpr int target_indices = 34963;

Json json_of(const Vec3& v)
{
    return {v.x, v.y, v.z};
}

/// The matrix with these columns, column by column.
Json matrix(const Vec3& x, const Vec3& y, const Vec3& z, const Vec3& origin)
{
    return {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, origin.x, origin.y, origin.z, 1};
}

class GltfWriter {
public:
    GltfWriter(const Scene& scene, const Options& options)
        : scene_(scene), options_(options), materials_(scene)
    {}

    /// The JSON for a buffer with this URI; for one without, if `uri` is empty.
    Json write(const std::string& uri)
    {
        expect_sayable();
        camera();
        surfaces();
        lights();
        Json root;
        root["asset"] = {{"version", "2.0"}, {"generator", "Plumbline"}};
        std::vector<std::string> used = materials_.extensions();
        if (!lights_.empty()) {
            used.emplace_back("KHR_lights_punctual");
            root["extensions"]["KHR_lights_punctual"]["lights"] = lights_;
        }
        if (!used.empty()) root["extensionsUsed"] = used;
        root["scene"] = 0;
        Json numbers = Json::array();
        for (std::size_t i = 0; i < nodes_.size(); ++i) numbers.push_back(i);
        root["scenes"] = Json::array({Json{{"name", scene_.name}, {"nodes", numbers}}});
        root["nodes"] = nodes_;
        root["cameras"] = cameras_;
        if (!primitives_.empty()) {
            root["meshes"] = Json::array({Json{{"name", "surfaces"}, {"primitives", primitives_}}});
            root["materials"] = materials_.json();
            root["accessors"] = accessors_;
            root["bufferViews"] = views_;
            Json buffer = {{"byteLength", bytes_.size()}};
            if (!uri.empty()) buffer["uri"] = uri;
            root["buffers"] = Json::array({buffer});
        }
        return root;
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

private:
    void expect_sayable() const
    {
        if (!scene_.spheres.empty())
            refuse(scene_, "sphere 1 of " + std::to_string(scene_.spheres.size()),
                   "glTF has no spheres, and a mesh would be another shape");
        for_each_light(scene_, [&](const auto& light, std::size_t index) {
            if constexpr (std::is_same_v<decltype(light), const SpotLight&>)
                if (is_emitter(light))
                    refuse(scene_, light_name(light, index),
                           "glTF's spot lights fade towards the edge of the cone in a way of the "
                           "reader's own");
        });
        if (has_environment(scene_))
            refuse(scene_, "the environment", "glTF has no light from every direction");
    }

    /// glTF's camera has the axes of Plumbline's; its angle is that of the height.
    void camera()
    {
        const Camera& camera = *scene_.camera;
        const double aspect = static_cast<double>(options_.width) / options_.height;
        const double height = camera.fov_axis == FovAxis::vertical
                                  ? camera.fov
                                  : 2.0 * std::atan(std::tan(camera.fov / 2.0) / aspect);
        constexpr double near_of_far = 1e-6;
        cameras_.push_back({{"type", "perspective"},
                            {"perspective",
                             {{"aspectRatio", aspect},
                              {"yfov", height},
                              {"znear", near_of_far * reach_of(scene_)},
                              {"zfar", reach_of(scene_)}}}});
        nodes_.push_back({{"name", "camera"},
                          {"camera", 0},
                          {"matrix", matrix(camera.right, camera.up, camera.backward, camera.eye)}});
    }

    /// Each emitter twice: the front shines, and the back is black, as in Plumbline. Neither is seen
    /// from behind (doubleSided is false).
    void surfaces()
    {
        const std::vector<Mesh> meshes = meshes_of(scene_);
        expect_single_precision(meshes);
        for (const Mesh& mesh : meshes) {
            const std::size_t points = add_points(mesh);
            add_primitive(points, mesh.triangles, materials_.add(mesh.material));
            if (!emits(scene_.materials[mesh.material])) continue;
            std::vector<std::array<std::uint32_t, 3>> back = mesh.triangles;
            for (auto& triangle : back) std::swap(triangle[1], triangle[2]);
            add_primitive(points, back, materials_.add_back());
        }
        if (!primitives_.empty()) nodes_.push_back({{"name", "surfaces"}, {"mesh", 0}});
    }

    /// Throws SceneError if coordinates as 32-bit floats would change the shape of the scene visibly.
    void expect_single_precision(const std::vector<Mesh>& meshes) const
    {
        constexpr double most_moved = 1e-5; // of the distance that the camera sees
        double moved = 0;
        for (const Mesh& mesh : meshes)
            for (const Vec3& point : mesh.points)
                for (int i = 0; i < 3; ++i)
                    moved = std::max(moved, std::abs(point[i]) > std::numeric_limits<float>::max()
                                                ? std::numeric_limits<double>::infinity()
                                                : std::abs(static_cast<float>(point[i]) - point[i]));
        if (moved > most_moved * reach_of(scene_))
            refuse(
                scene_, "the triangles",
                "glTF's coordinates are 32-bit floats, which would change their shape: move the scene "
                "towards the origin");
    }

    /// A view of the last `count` bytes of the buffer. Its number.
    std::size_t add_view(std::size_t count, int target)
    {
        views_.push_back({{"buffer", 0},
                          {"byteOffset", bytes_.size() - count},
                          {"byteLength", count},
                          {"target", target}});
        return views_.size() - 1;
    }

    /// The accessor of the points.
    std::size_t add_points(const Mesh& mesh)
    {
        glm::vec3 low(std::numeric_limits<float>::max());
        glm::vec3 high = -low;
        const std::size_t before = bytes_.size();
        for (const Vec3& point : mesh.points) {
            const glm::vec3 rounded(point);
            for (int i = 0; i < 3; ++i) append_little_endian(bytes_, rounded[i]);
            low = glm::min(low, rounded);
            high = glm::max(high, rounded);
        }
        accessors_.push_back({{"bufferView", add_view(bytes_.size() - before, target_vertices)},
                              {"componentType", kind_float},
                              {"count", mesh.points.size()},
                              {"type", "VEC3"},
                              {"min", json_of(low)},
                              {"max", json_of(high)}});
        return accessors_.size() - 1;
    }

    void add_primitive(std::size_t points, const std::vector<std::array<std::uint32_t, 3>>& triangles,
                       std::size_t material)
    {
        const std::size_t before = bytes_.size();
        for (const auto& triangle : triangles)
            for (const std::uint32_t corner : triangle) append_little_endian(bytes_, corner);
        accessors_.push_back({{"bufferView", add_view(bytes_.size() - before, target_indices)},
                              {"componentType", kind_unsigned},
                              {"count", 3 * triangles.size()},
                              {"type", "SCALAR"}});
        primitives_.push_back({{"attributes", {{"POSITION", points}}},
                               {"indices", accessors_.size() - 1},
                               {"material", material}});
    }

    static void place(Json& node, const PointLight& light)
    {
        node["translation"] = json_of(light.position);
    }
    /// A light shines along its local -z.
    static void place(Json& node, const DirectionalLight& light)
    {
        const auto [x, y, z] = frame_of(-light.direction);
        node["matrix"] = matrix(x, y, z, Vec3(0.0));
    }
    static void place(Json& /*node*/, const SpotLight& /*light*/) {} // refused before

    void lights()
    {
        for_each_light(scene_, [&](const auto& light, std::size_t index) {
            if (!is_emitter(light)) return;
            const ScaledColour scaled = split(emitted_by(light));
            lights_.push_back({{"name", light_name(light, index)},
                               {"type", name_of(kind_of(light))},
                               {"color", json_of(scaled.colour)},
                               {"intensity", scaled.scale}});
            Json node = {{"name", light_name(light, index)}};
            place(node, light);
            node["extensions"]["KHR_lights_punctual"]["light"] = lights_.size() - 1;
            nodes_.push_back(node);
        });
    }

    const Scene& scene_;
    const Options& options_;
    GltfMaterials materials_;
    Json nodes_ = Json::array();
    Json cameras_ = Json::array();
    Json lights_ = Json::array();
    Json primitives_ = Json::array();
    Json accessors_ = Json::array();
    Json views_ = Json::array();
    std::string bytes_;
};

/// A part of a binary file: length, type, and bytes up to a multiple of 4 [specification, section 4.4].
std::string chunk(const std::string& type, std::string bytes, char padding)
{
    bytes.resize((bytes.size() + 3) / 4 * 4, padding);
    std::string result;
    append_little_endian(result, static_cast<std::uint32_t>(bytes.size()));
    return result + type + bytes;
}

std::string binary_file(const Scene& scene, const std::string& json, const std::string& buffer)
{
    const std::string rest =
        chunk("JSON", json, ' ') + (buffer.empty() ? "" : chunk(std::string("BIN\0", 4), buffer, '\0'));
    constexpr std::size_t head = 12;
    if (rest.size() > std::numeric_limits<std::uint32_t>::max() - head)
        refuse(scene, "the triangles", "a .glb file holds at most 4 GiB");
    std::string bytes = "glTF";
    append_little_endian(bytes, std::uint32_t{2});
    append_little_endian(bytes, static_cast<std::uint32_t>(rest.size() + head));
    return bytes + rest;
}

/// The name of the file of numbers. It is also its URI, so it consists of characters that stand for
/// themselves in URIs: not every reader decodes others [RFC 3986, sec. 2.3].
std::string buffer_name(const std::string& file_name)
{
    std::string name = stem_of(file_name);
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) {
            return !(c < 128 && std::isalnum(c) != 0) && c != '-' && c != '.' && c != '_';
        },
        '_');
    return name + ".bin";
}

std::string text_of(const Json& json, int indent)
{
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace

Exported to_gltf(const Scene& scene, const Options& options, const std::string& file_name)
{
    GltfWriter writer(scene, options);
    std::string ending = file_name.substr(stem_of(file_name).size());
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (ending == ".glb") {
        const Json json = writer.write("");
        return {{{file_name, binary_file(scene, text_of(json, -1), writer.bytes())}}, {}};
    }
    const std::string buffer = buffer_name(file_name);
    const Json json = writer.write(buffer);
    Exported result;
    if (!writer.bytes().empty()) result.files.push_back({buffer, writer.bytes()});
    result.files.push_back({file_name, text_of(json, 1) + "\n"});
    return result;
}

} // namespace scenes::exports
