#include "ref/trees/bvh.h"

#include "ref/trees/morton.h"
#include "ref/trees/radix_sort.h"
#include "ref/trees/radix_tree.h"
#include "ref/trees/refit.h"
#include "ref/trees/sah.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace ref {

namespace {

[[noreturn]] void reject(std::size_t primitive, const std::string& what)
{
    throw std::invalid_argument("primitive " + std::to_string(primitive) + ": " + what);
}

void check(std::span<const Aabb> boxes)
{
    if (boxes.size() > most_primitives)
        throw std::invalid_argument("a tree may have " + std::to_string(most_primitives) +
                                    " primitives, not " + std::to_string(boxes.size()));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (is_empty(boxes[i])) reject(i, "its box is empty");
        if (!is_finite(boxes[i].lower) || !is_finite(boxes[i].upper))
            reject(i, "a coordinate of its box is NaN or infinite");
    }
}

/// Sorts the Morton codes, builds the radix tree over them, and computes all boxes from those of the
/// primitives.
Tree build_lbvh(std::span<const Aabb> boxes, int bits_per_axis)
{
    std::vector<std::uint64_t> codes = morton_codes(boxes, bits_per_axis);
    Tree tree;
    tree.primitives.resize(boxes.size());
    std::iota(tree.primitives.begin(), tree.primitives.end(), 0);
    radix_sort(codes, tree.primitives, 3 * bits_per_axis);
    tree.nodes = radix_tree(codes);
    tree.leaf_begin.resize(boxes.size() + 1);
    std::iota(tree.leaf_begin.begin(), tree.leaf_begin.end(), 0);
    refit(tree, boxes);
    return tree;
}

} // namespace

std::vector<Aabb> primitive_bounds(const scenes::Scene& scene)
{
    std::vector<Aabb> boxes;
    boxes.reserve(scenes::primitive_count(scene));
    for (const scenes::Triangle& triangle : scene.triangles) {
        Aabb box;
        for (const Vec3& vertex : triangle.vertices) {
            if (!is_finite(vertex))
                reject(boxes.size(), "a coordinate of the triangle is NaN or infinite");
            box = unite(box, {vertex, vertex});
        }
        boxes.push_back(box);
    }
    for (const scenes::Sphere& sphere : scene.spheres) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const auto outwards = [](const Vec3& v, double to) {
            return Vec3(std::nextafter(v.x, to), std::nextafter(v.y, to), std::nextafter(v.z, to));
        };
        const Aabb box{outwards(sphere.center - sphere.radius, -infinity),
                       outwards(sphere.center + sphere.radius, infinity)};
        if (!is_finite(box.lower) || !is_finite(box.upper))
            reject(boxes.size(), "a coordinate of the sphere is NaN or infinite");
        boxes.push_back(box);
    }
    return boxes;
}

std::vector<std::uint64_t> morton_codes(std::span<const Aabb> boxes, int bits_per_axis)
{
    // The grid spans the box of the centroids, not the box of the scene, so that all of its cells can
    // be used.
    Aabb grid;
    for (const Aabb& box : boxes) grid = unite(grid, {centroid(box), centroid(box)});
    std::vector<std::uint64_t> codes;
    codes.reserve(boxes.size());
    for (const Aabb& box : boxes) codes.push_back(morton_code(centroid(box), grid, bits_per_axis));
    return codes;
}

Tree build(std::span<const Aabb> boxes, const BuildOptions& options)
{
    check(boxes);
    if (options.max_leaf_size < 1) throw std::invalid_argument("a leaf has at least one primitive");
    switch (options.builder) {
    case Builder::morton30:
        return build_lbvh(boxes, 10);
    case Builder::morton63:
        return build_lbvh(boxes, 21);
    case Builder::sah:
        return build_sah(boxes);
    case Builder::sah_leaf:
        return build_sah(boxes, options.max_leaf_size);
    }
    throw std::invalid_argument("no such builder");
}

} // namespace ref
