#include "check/trees/tree_files.h"

#include "check/npy.h"
#include "check/trees/number_text.h"
#include "images/atomic_file.h"
#include "images/file_ending.h"
#include "images/image_error.h"

#include <array>
#include <system_error>

namespace check {

namespace {

using images::ImageError;

/// An array of the given extents in all axes but the first (0: any). One of a single axis may have a
/// second one of extent 1. One without elements may have any shape and type.
/// Throws ImageError.
NpyArray read_shaped(const std::filesystem::path& path, bool integers,
                     const std::vector<std::size_t>& extents, const char* expected)
{
    NpyArray array = read_npy(path);
    if (array.reals.empty() && array.integers.empty()) return array; // numpy.array([]) has any type
    if (array.is_integer() != integers)
        throw ImageError(
            path, "holds " + array.type +
                      (integers ? ": there must be integers" : ": there must be float32 or float64"));
    std::vector<std::size_t> shape = array.shape;
    if (extents.empty() && shape.size() == 2 && shape[1] == 1) shape.pop_back();
    bool fits = shape.size() == extents.size() + 1;
    for (std::size_t axis = 0; fits && axis < extents.size(); ++axis)
        fits = extents[axis] == 0 || shape[axis + 1] == extents[axis];
    if (!fits)
        throw ImageError(path, "has the shape " + shape_text(array.shape) + ": it must be " + expected);
    return array;
}

std::vector<ref::Aabb> boxes_of(const std::vector<double>& numbers)
{
    std::vector<ref::Aabb> boxes;
    for (std::size_t i = 0; i + 6 <= numbers.size(); i += 6)
        boxes.push_back({{numbers[i], numbers[i + 1], numbers[i + 2]},
                         {numbers[i + 3], numbers[i + 4], numbers[i + 5]}});
    return boxes;
}

/// The bounding boxes of triangles; a coordinate of a box is NaN if one of the vertices' is.
std::vector<ref::Aabb> boxes_of_triangles(const std::vector<double>& numbers)
{
    std::vector<ref::Aabb> boxes;
    for (std::size_t i = 0; i + 9 <= numbers.size(); i += 9) {
        ref::Aabb box;
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t vertex = 0; vertex < 3; ++vertex) {
                const double x = numbers[i + 3 * vertex + static_cast<std::size_t>(axis)];
                if (x < box.lower[axis] || x != x) box.lower[axis] = x;
                if (x > box.upper[axis] || x != x) box.upper[axis] = x;
            }
        boxes.push_back(box);
    }
    return boxes;
}

NeutralTree read_tree_folder(const std::filesystem::path& folder)
{
    NeutralTree tree;
    const NpyArray nodes =
        read_shaped(folder / "nodes.npy", true, {0}, "(m, 4), or (m, k + 2) for nodes of k children");
    if (!nodes.integers.empty() && nodes.shape[1] < 4)
        throw ImageError(folder / "nodes.npy",
                         "has the shape " + shape_text(nodes.shape) +
                             ": it must be (m, 4), or (m, k + 2) for nodes of k children");
    if (!nodes.integers.empty()) tree.width = nodes.shape[1] - 2;
    tree.nodes = nodes.integers;
    const NpyArray boxes = read_shaped(folder / "boxes.npy", false, {6}, "(m, 6)");
    tree.boxes = boxes_of(boxes.reals);
    tree.single_precision = boxes.type == "float32";
    tree.primitives = read_shaped(folder / "primitives.npy", true, {}, "(n,)").integers;
    if (std::filesystem::exists(folder / "parents.npy"))
        tree.parents = read_shaped(folder / "parents.npy", true, {}, "(m,)").integers;
    return tree;
}

} // namespace

Primitives read_primitives(const std::filesystem::path& path)
{
    if (images::has_ending(path, ".json")) return primitives_of_json(images::read_file(path), path);
    NpyArray array = read_npy(path);
    if (array.is_integer())
        throw ImageError(path, "holds " + array.type + ": there must be float32 or float64");
    const bool boxes = array.shape.size() == 2 && array.shape[1] == 6;
    const bool triangles = array.shape.size() == 3 && array.shape[1] == 3 && array.shape[2] == 3;
    if (!boxes && !triangles)
        throw ImageError(path, "has the shape " + shape_text(array.shape) +
                                   ": it must be (n, 6) for boxes, or (n, 3, 3) for triangles");
    return {boxes ? boxes_of(array.reals) : boxes_of_triangles(array.reals),
            {triangles, array.type == "float32"}};
}

void expect_legal(const Primitives& primitives, const std::filesystem::path& path)
{
    for (std::size_t i = 0; i < primitives.boxes.size(); ++i) {
        const ref::Aabb& box = primitives.boxes[i];
        for (int axis = 0; axis < 3; ++axis) {
            const double lower = box.lower[axis];
            const double upper = box.upper[axis];
            if (std::isfinite(lower) && std::isfinite(upper) && lower <= upper) continue;
            const std::string range = std::string(1, "xyz"[axis]) + " from " + number_text(lower) +
                                      " to " + number_text(upper);
            throw ImageError(path, "primitive " + std::to_string(i) + ": its box has " + range);
        }
    }
}

std::string primitives_bytes(std::span<const ref::Aabb> boxes, const PrimitiveFormat& format)
{
    std::vector<double> numbers;
    const auto append = [&](double x, double y, double z) { numbers.insert(numbers.end(), {x, y, z}); };
    for (const auto& [lower, upper] : boxes) {
        append(lower.x, lower.y, lower.z);
        if (format.triangles) append(upper.x, lower.y, upper.z); // a corner between: no area is lost
        append(upper.x, upper.y, upper.z);
    }
    const std::size_t n = boxes.size();
    if (format.triangles)
        return npy_bytes(std::array{n, std::size_t{3}, std::size_t{3}}, numbers,
                         format.single_precision);
    return npy_bytes(std::array{n, std::size_t{6}}, numbers, format.single_precision);
}

NeutralTree read_tree(const std::filesystem::path& path)
{
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) return read_tree_folder(path);
    if (images::has_ending(path, ".json")) return tree_of_json(images::read_file(path), path);
    if (!std::filesystem::exists(path, error)) throw ImageError(path, "does not exist");
    throw ImageError(path, "is neither a folder nor a .json file");
}

} // namespace check
