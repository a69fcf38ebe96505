#include "scenes/collada/bind_material.h"

#include <string>

namespace scenes::collada {

MaterialBinding::MaterialBinding(const Document& document, const Element& instance)
    : instance_(&instance)
{
    const Element* bind_material = optional_child(instance, "bind_material");
    if (bind_material == nullptr) return;
    check_children(*bind_material, {"param", "technique_common", "technique"});
    const Element& technique = required_child(*bind_material, "technique_common");
    check_children(technique, {"instance_material"});
    for (const Element* bound : children(technique, "instance_material")) {
        check_children(*bound, {"bind", "bind_vertex_input"}); // these feed textures, which are refused
        const bool is_new = materials_
                                .emplace(required_attribute(*bound, "symbol"),
                                         &document.target(*bound, "target", "material"))
                                .second;
        if (!is_new) fail(*bound, "binds its symbol a second time");
    }
}

const Element& MaterialBinding::material_of(const Element& part) const
{
    const char* symbol = part.Attribute("material");
    if (symbol == nullptr) fail(part, "no material: attribute \"material\" is missing");
    const auto bound = materials_.find(symbol);
    if (bound == materials_.end())
        fail(*instance_, "no material: it binds none to the symbol " + in_quotes(symbol) + " of line " +
                             std::to_string(part.GetLineNum()));
    return *bound->second;
}

const Element& MaterialBinding::only_material() const
{
    if (materials_.size() != 1)
        fail(*instance_, "a sphere takes one material, not " + std::to_string(materials_.size()));
    return *materials_.begin()->second;
}

} // namespace scenes::collada
