#include "scenes/export/ply.h"

#include "scenes/export/little_endian.h"

namespace scenes::exports {

std::string ply_of(const Mesh& mesh)
{
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.points.size()) +
        "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
        std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& point : mesh.points)
        for (int i = 0; i < 3; ++i) append_little_endian(bytes, point[i]);
    for (const auto& triangle : mesh.triangles) {
        bytes += '\3';
        for (const std::uint32_t corner : triangle) append_little_endian(bytes, corner);
    }
    return bytes;
}

} // namespace scenes::exports
