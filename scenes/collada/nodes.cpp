#include "scenes/collada/nodes.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace scenes::collada {
namespace {

constexpr std::size_t deepest = 200;
constexpr std::size_t most_visits = std::size_t{1} << 20U;

} // namespace

void NodeWalk::visit_scene(const Element& visual_scene)
{
    check_children(visual_scene, {"node"});
    for (const Element* node : children(visual_scene, "node")) visit_node(*node, Matrix(1.0));
}

void NodeWalk::visit_node(const Element& node, const Matrix& parent_to_world)
{
    if (std::find(path_.begin(), path_.end(), &node) != path_.end())
        fail(node, "contains an instance of itself");
    if (path_.size() == deepest) fail(node, "nested deeper than " + std::to_string(deepest) + " nodes");
    check_children(node, {"lookat", "matrix", "rotate", "scale", "skew", "translate", "instance_camera",
                          "instance_geometry", "instance_light", "instance_node", "node"});

    path_.push_back(&node);
    const Matrix to_world = parent_to_world * node_transform(node);
    for (const Element* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
        if (++visits_ > most_visits)
            fail(*e, "more than " + std::to_string(most_visits) + " elements of nodes");
        const std::string_view name = e->Name();
        if (name == "instance_geometry") instances_->add_geometry(*e, to_world);
        if (name == "instance_light") instances_->add_light(*e, to_world);
        if (name == "instance_camera") instances_->add_camera(*e, to_world);
        if (name == "instance_node") {
            check_children(*e, {});
            visit_node(document_->target(*e, "url", "node"), to_world);
        }
        if (name == "node") visit_node(*e, to_world);
    }
    path_.pop_back();
}

} // namespace scenes::collada
