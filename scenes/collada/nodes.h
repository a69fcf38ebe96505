#pragma once

// The tree of nodes: walks from the visual scene down to every instance and composes the transforms.

#include "scenes/collada/document.h"
#include "scenes/collada/instances.h"
#include "scenes/collada/transform.h"

#include <cstddef>
#include <vector>

namespace scenes::collada {

/// Walks a <visual_scene> and gives each instance in it to an Instances. Fails for nodes that instance
/// themselves, for nodes nested deeper than 200, and for more than 2^20 elements in nodes, each counted
/// as often as it is instanced: with <instance_node> a small file could describe a scene of any size.
class NodeWalk {
public:
    NodeWalk(const Document& document, Instances& instances)
        : document_(&document), instances_(&instances)
    {}

    void visit_scene(const Element& visual_scene);

private:
    void visit_node(const Element& node, const Matrix& parent_to_world);

    const Document* document_;
    Instances* instances_;
    std::vector<const Element*> path_; // from the visual scene down to the node being visited
    std::size_t visits_ = 0;
};

} // namespace scenes::collada
