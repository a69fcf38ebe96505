#include "scenes/read_mesh.h"

#include "scenes/file_bytes.h"
#include "scenes/mesh_damage.h"
#include "scenes/plain_material.h"
#include "scenes/polygons/triangulate.h"
#include "scenes/read_scene.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/DefaultLogger.hpp>
#include <assimp/Importer.hpp>
#include <assimp/LogStream.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace scenes {
namespace {

constexpr std::size_t most_triangles = std::size_t{1} << 24U; // as in a COLLADA file
constexpr std::size_t deepest = 200;

/// Row by row in Assimp, column by column in glm.
glm::dmat4 matrix_of(const aiMatrix4x4& m)
{
    return glm::transpose(glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2, m.c3,
                                     m.c4, m.d1, m.d2, m.d3, m.d4));
}

bool is_finite(const Vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Transforms the meshes of a file to world coordinates, node by node.
class Collector {
public:
    Collector(const aiScene& file, std::string name, Scene& scene)
        : file_(&file), name_(std::move(name)), scene_(&scene)
    {}

    void visit(const aiNode& node, const glm::dmat4& parent_to_world, std::size_t depth = 0)
    {
        if (depth == deepest) fail("nodes nested deeper than " + std::to_string(deepest));
        const glm::dmat4 to_world = parent_to_world * matrix_of(node.mTransformation);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*file_->mMeshes[node.mMeshes[i]], to_world);
        for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], to_world, depth + 1);
    }

    /// To be called after the last node.
    void finish() const
    {
        if (scene_->triangles.empty()) fail("no triangles in the file");
        const auto note = [&](std::size_t count, const char* what) {
            if (count > 0) scene_->notices.push_back(std::to_string(count) + what);
        };
        note(lines_, " line(s) and point(s): ignored, they have no area");
        note(faults_.zero_area, " triangle(s) of zero area: kept, but they do not stop a ray");
        note(faults_.non_planar,
             " polygon(s) are not planar: cut into triangles as their projection on the mean plane");
        note(faults_.crossed,
             " polygon(s) cross themselves: cut into triangles around the first corner, "
             "which cover a different area");
    }

private:
    [[noreturn]] void fail(const std::string& what) const { throw SceneError(name_ + ": " + what); }

    void add(const aiMesh& mesh, const glm::dmat4& to_world)
    {
        polygons::Polygons faces;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            if (face.mNumIndices < 3) {
                ++lines_;
                continue;
            }
            faces.sizes.push_back(face.mNumIndices);
            faces.corners.insert(faces.corners.end(), face.mIndices, face.mIndices + face.mNumIndices);
        }
        for (const std::uint32_t corner : faces.corners)
            if (corner >= mesh.mNumVertices)
                fail("a face has the vertex " + std::to_string(corner) + ", of " +
                     std::to_string(mesh.mNumVertices) + " (counted from 0)");
        const std::vector<Vec3> positions = positions_of(mesh);
        std::vector<polygons::Corners> triangles;
        polygons::triangulate(faces, positions, triangles, faults_);
        if (faults_.too_large > 0)
            fail("a polygon that is not convex has more corners than can be cut into triangles");
        place(triangles, to_world);
    }

    [[nodiscard]] std::vector<Vec3> positions_of(const aiMesh& mesh) const
    {
        std::vector<Vec3> positions;
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const aiVector3D& v = mesh.mVertices[i];
            positions.emplace_back(v.x, v.y, v.z);
            if (!is_finite(positions.back()))
                fail("the coordinates of vertex " + std::to_string(i) +
                     " (counted from 0) are not all finite");
        }
        return positions;
    }

    /// A mirroring transform also reverses the winding, as in a COLLADA file.
    void place(const std::vector<polygons::Corners>& triangles, const glm::dmat4& to_world)
    {
        if (scene_->triangles.size() + triangles.size() > most_triangles)
            fail("more than " + std::to_string(most_triangles) + " triangles");
        const bool mirrored = glm::determinant(glm::dmat3(to_world)) < 0;
        for (const polygons::Corners& corners : triangles) {
            polygons::Corners world{};
            for (std::size_t i = 0; i < 3; ++i) {
                world[i] = Vec3(to_world * glm::dvec4(corners[i], 1.0));
                if (!is_finite(world[i])) fail("the transform of a node takes a vertex to infinity");
            }
            if (mirrored) std::swap(world[1], world[2]);
            scene_->triangles.push_back({world, 0});
        }
    }

    const aiScene* file_;
    std::string name_;
    Scene* scene_;
    polygons::PolygonFaults faults_;
    std::size_t lines_ = 0;
};

/// Collects the messages that Assimp has dropped triangles: these messages appear only in its log, and a
/// process has only one log.
class DropListener {
public:
    DropListener()
    {
        // The logger deletes the stream.
        Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0)
            ->attachStream(new Stream(dropped_), Assimp::Logger::Warn | Assimp::Logger::Err);
    }
    ~DropListener() { Assimp::DefaultLogger::kill(); }
    DropListener(const DropListener&) = delete;
    DropListener& operator=(const DropListener&) = delete;

    [[nodiscard]] bool dropped() const { return dropped_; }

private:
    class Stream : public Assimp::LogStream {
    public:
        explicit Stream(bool& dropped) : dropped_(&dropped) {}
        void write(const char* message) override
        {
            if (std::string_view(message).find("dropped") != std::string_view::npos) *dropped_ = true;
        }

    private:
        bool* dropped_;
    };
    bool dropped_ = false;
};

/// The first line of a message of Assimp.
std::string first_line(const std::string& text)
{
    return text.substr(0, text.find_first_of("\r\n"));
}

} // namespace

Scene read_mesh(const std::filesystem::path& path)
{
    const std::string name = path.filename().string();
    const std::string bytes = file_bytes(path);
    Scene scene;
    scene.name = path.stem().string();
    scene.hash = hash_of(bytes);
    add_plain_material(scene);

    const std::string ending = lower_case_ending(path);
    const std::string damage = ending == ".ply"   ? damage_of_ply(bytes)
                               : ending == ".stl" ? damage_of_stl(bytes)
                               : ending == ".glb" ? damage_of_glb(bytes)
                                                  : "";
    if (!damage.empty()) throw SceneError(name + ": " + damage);

    const DropListener listener;
    Assimp::Importer importer;
    // No step that joins, drops or reorders triangles: this one only checks them.
    const aiScene* file = importer.ReadFile(path.string(), aiProcess_ValidateDataStructure);
    if (file == nullptr) throw SceneError(name + ": " + first_line(importer.GetErrorString()));
    if (listener.dropped())
        throw SceneError(name +
                         ": some faces are damaged: a vertex that is not there, or too few corners");
    Collector collector(*file, name, scene);
    collector.visit(*file->mRootNode, glm::dmat4(1.0));
    collector.finish();
    return scene;
}

} // namespace scenes
