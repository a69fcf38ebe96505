#pragma once

// The materials that one instance of a geometry binds to the symbols of the geometry.

#include "scenes/collada/document.h"

#include <string_view>
#include <unordered_map>
#include <vector>

namespace scenes::collada {

/// The <bind_material> of an <instance_geometry>. The material bound to a symbol is read when a surface
/// needs it.
class MaterialBinding {
public:
    MaterialBinding(const Document& document, const Element& instance);

    /// The <material> for `part`, a <triangles>, <polylist> or <polygons> of the geometry; null if the
    /// part names no symbol or the instance does not bind it. Fails if it binds the symbol twice.
    [[nodiscard]] const Element* material_of(const Element& part) const;
    /// The only <material> bound, for any symbol; null if there is none. Fails if there are several.
    [[nodiscard]] const Element* only_material() const;

private:
    using Bound = std::vector<const Element*>; // <instance_material>s of one symbol

    [[nodiscard]] const Element& material_in(const Bound& bound) const;

    const Document* document_;
    const Element* instance_;
    std::unordered_map<std::string_view, Bound> bound_; // by symbol
};

} // namespace scenes::collada
