#pragma once

// Closed meshes with difficult triangles, and random points on and around them.

#include "scenes/scene.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace trees_test {

using scenes::Vec3;

/// Uniform doubles and numbers computed from them; the same on every machine.
class Random {
public:
    explicit Random(std::uint64_t seed) : bits_(seed) {}
    double uniform() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
    double uniform(double from, double to) { return from + (to - from) * uniform(); }
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits_() % n); }
    Vec3 in_cube() { return {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}; }
    /// 10^x with x uniform: every order of magnitude is equally likely.
    double magnitude(double from, double to) { return std::pow(10.0, uniform(from, to)); }
    Vec3 direction()
    {
        for (;;) {
            const Vec3 v = in_cube();
            const double square = glm::dot(v, v);
            if (square > 0.01 && square <= 1) return v / std::sqrt(square);
        }
    }
    /// Weights of three vertices, sum 1.
    Vec3 barycentric()
    {
        const double root = std::sqrt(uniform());
        const double b = uniform() * root;
        return {1 - root, b, root - b};
    }
    std::uint64_t bits() { return bits_(); }

private:
    std::mt19937_64 bits_;
};

/// A mesh of vertices and of triangles by index; closed, star-shaped around `inside`.
struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<std::array<std::size_t, 3>> triangles;
    Vec3 inside = Vec3(0);
};

inline Mesh tetrahedron(Random& random)
{
    Mesh mesh;
    // One corner near each of four alternate corners of a cube: the centre is inside.
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
        mesh.vertices.push_back(corner + 0.3 * random.in_cube());
    mesh.triangles = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
    return mesh;
}

/// A sphere made from an icosahedron by splitting edges, and `squash` times flatter along z. For small
/// `squash`, all triangles are slivers when seen from the side.
inline Mesh icosphere(int levels, double squash)
{
    const double g = (1 + std::sqrt(5.0)) / 2;
    Mesh mesh;
    mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                     {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> middles;
        const auto middle = [&](std::size_t a, std::size_t b) {
            const auto [entry, is_new] = middles.try_emplace(std::minmax(a, b), mesh.vertices.size());
            if (is_new) mesh.vertices.push_back(mesh.vertices[a] + mesh.vertices[b]);
            return entry->second;
        };
        std::vector<std::array<std::size_t, 3>> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const std::size_t ab = middle(a, b);
            const std::size_t bc = middle(b, c);
            const std::size_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        mesh.triangles = std::move(finer);
        for (Vec3& v : mesh.vertices) v = glm::normalize(v);
    }
    for (Vec3& v : mesh.vertices) v = glm::normalize(v) * Vec3(1, 1, squash);
    return mesh;
}

/// The surface of the cube [-1, 1]^3 divided into n x n cells per face, with all grid lines moved to
/// -1 + 2 (i/n)^power: long slivers for a large power. The centre is inside.
inline Mesh tessellated_box(std::size_t n, double power)
{
    Mesh mesh;
    const auto cut = [&](std::size_t i) {
        return i == n ? 1 : -1 + 2 * std::pow(static_cast<double>(i) / static_cast<double>(n), power);
    };
    std::map<std::array<std::size_t, 3>, std::size_t> numbers;
    const auto vertex = [&](std::array<std::size_t, 3> at) {
        const auto [entry, is_new] = numbers.try_emplace(at, mesh.vertices.size());
        if (is_new) mesh.vertices.emplace_back(cut(at[0]), cut(at[1]), cut(at[2]));
        return entry->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const std::size_t side : {std::size_t{0}, n})
            for (std::size_t i = 0; i < n; ++i)
                for (std::size_t j = 0; j < n; ++j) {
                    const auto corner = [&](std::size_t u, std::size_t v) {
                        std::array<std::size_t, 3> at{};
                        at[axis] = side;
                        at[(axis + 1) % 3] = u;
                        at[(axis + 2) % 3] = v;
                        return vertex(at);
                    };
                    const std::size_t a = corner(i, j);
                    const std::size_t b = corner(i + 1, j);
                    const std::size_t c = corner(i + 1, j + 1);
                    const std::size_t d = corner(i, j + 1);
                    if (side == 0) {
                        mesh.triangles.push_back({a, c, b});
                        mesh.triangles.push_back({a, d, c});
                    } else {
                        mesh.triangles.push_back({a, b, c});
                        mesh.triangles.push_back({a, c, d});
                    }
                }
    return mesh;
}

/// The mesh with every vertex v replaced by scale * v + offset.
inline Mesh moved(Mesh mesh, double scale, const Vec3& offset)
{
    for (Vec3& v : mesh.vertices) v = scale * v + offset;
    mesh.inside = scale * mesh.inside + offset;
    return mesh;
}

inline scenes::Scene scene_of(const Mesh& mesh)
{
    scenes::Scene scene;
    scene.materials.emplace_back(scenes::Lambertian{scenes::Rgb(0.5)});
    scene.material_names.emplace_back("grey");
    for (const auto& [a, b, c] : mesh.triangles)
        scene.triangles.push_back({{mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, 0});
    return scene;
}

} // namespace trees_test
