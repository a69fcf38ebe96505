#include "scenes/collada/bind_material.h"

#include <string>

namespace scenes::collada {

MaterialBinding::MaterialBinding(const Document& document, const Element& instance)
    : document_(&document), instance_(&instance)
{
    const Element* bind_material = optional_child(instance, "bind_material");
    if (bind_material == nullptr) return;
    check_children(*bind_material, {"param", "technique_common", "technique"});
    const Element& technique = required_child(*bind_material, "technique_common");
    check_children(technique, {"instance_material"});
    for (const Element* bound : children(technique, "instance_material"))
        bound_[required_attribute(*bound, "symbol")].push_back(bound);
}

const Element& MaterialBinding::material_in(const Bound& bound) const
{
    if (bound.size() > 1) fail(*bound[1], "binds its symbol a second time");
    check_children(*bound[0], {"bind", "bind_vertex_input"}); // these feed textures, which are refused
    return document_->target(*bound[0], "target", "material");
}

const Element* MaterialBinding::material_of(const Element& part) const
{
    const char* symbol = part.Attribute("material");
    if (symbol == nullptr) return nullptr;
    const auto bound = bound_.find(symbol);
    return bound == bound_.end() ? nullptr : &material_in(bound->second);
}

const Element* MaterialBinding::only_material() const
{
    if (bound_.empty()) return nullptr;
    if (bound_.size() > 1)
        fail(*instance_, "a sphere takes one material, not " + std::to_string(bound_.size()));
    return &material_in(bound_.begin()->second);
}

} // namespace scenes::collada
