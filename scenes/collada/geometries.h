#pragma once

// Geometries in their local frame: a mesh, or a sphere of the CMU462 profile.

#include "scenes/collada/document.h"
#include "scenes/polygons/triangulate.h"

#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

namespace scenes::collada {

using polygons::Corners;

/// Triangles that share a material, named by a symbol that each instance of the geometry binds.
struct Part {
    const Element* element; // <triangles>, <polylist> or <polygons>
    std::vector<Corners> triangles;
};

using Mesh = std::vector<Part>;

/// A sphere around the local origin.
struct LocalSphere {
    double radius;
};

using Geometry = std::variant<Mesh, LocalSphere>;

/// Reads a <geometry>. <extra><technique profile="CMU462"><sphere> takes the place of a mesh. Normals
/// are ignored: surfaces are shaded with their geometric normal. Lines have no area and are ignored with
/// a notice. Polygon faults are reported in `notices`, one line per geometry and fault.
Geometry read_geometry(const Document& document, const Element& geometry,
                       std::vector<std::string>& notices);

/// The geometries of a scene: each is read once, when first used.
class Geometries {
public:
    Geometries(const Document& document, std::vector<std::string>& notices)
        : document_(&document), notices_(&notices)
    {}

    /// The content of the <geometry> element. The reference stays valid.
    const Geometry& get(const Element& geometry);

private:
    const Document* document_;
    std::vector<std::string>* notices_;
    std::unordered_map<const Element*, Geometry> read_;
};

} // namespace scenes::collada
