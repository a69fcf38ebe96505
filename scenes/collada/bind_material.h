#pragma once

// Which material each symbol of a geometry stands for in one instance of it.

#include "scenes/collada/document.h"

#include <string_view>
#include <unordered_map>

namespace scenes::collada {

/// The <bind_material> of an <instance_geometry>.
class MaterialBinding {
public:
    MaterialBinding(const Document& document, const Element& instance);

    /// The <material> for `part`, a <triangles>, <polylist> or <polygons> of the geometry. Fails if the
    /// part names no symbol, or if the instance does not bind it.
    [[nodiscard]] const Element& material_of(const Element& part) const;
    /// The one <material> bound, whatever its symbol; fails unless there is exactly one.
    [[nodiscard]] const Element& only_material() const;

private:
    const Element* instance_;
    std::unordered_map<std::string_view, const Element*> materials_; // by symbol
};

} // namespace scenes::collada
