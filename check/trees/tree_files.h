#pragma once

// The files of docs/own-code.md: primitives, and a tree over them.

#include "check/trees/neutral_tree.h"

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace check {

/// How primitives stand in a file.
struct PrimitiveFormat {
    bool triangles = false;       // an array of shape (n, 3, 3), else boxes of shape (n, 6)
    bool single_precision = true; // float32, else float64
};

struct Primitives {
    std::vector<ref::Aabb> boxes; // of triangles: the box of the three vertices
    PrimitiveFormat format;
};

/// Reads a `.npy` file, or a `.json` one ({"boxes": [[...], ...]} or {"triangles": [...]}). Coordinates
/// may be NaN, and boxes empty. Throws images::ImageError that names the file, and the primitive if it
/// is one that cannot be read.
Primitives read_primitives(const std::filesystem::path& path);

/// Throws images::ImageError that names the file and the first primitive that has no place in a tree: a
/// coordinate is NaN or infinite, or its lower end is above the upper one.
void expect_legal(const Primitives& primitives, const std::filesystem::path& path);

/// The bytes of a `.npy` file of boxes, or of triangles with these bounding boxes.
std::string primitives_bytes(std::span<const ref::Aabb> boxes, const PrimitiveFormat& format);

/// Reads a folder with `nodes.npy`, `boxes.npy`, `primitives.npy` and perhaps `parents.npy`, or a
/// `.json` file. Nothing but types and shapes is checked. Throws images::ImageError that names the file.
NeutralTree read_tree(const std::filesystem::path& path);

// From the text of a JSON file; `path` is for messages.
Primitives primitives_of_json(const std::string& text, const std::filesystem::path& path);
NeutralTree tree_of_json(const std::string& text, const std::filesystem::path& path);

} // namespace check
