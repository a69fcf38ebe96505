#include "scenes/collada/animations.h"

#include <algorithm>
#include <string_view>
#include <unordered_set>

namespace scenes::collada {
namespace {

/// The elements whose id `target` begins with: "id/sid", "id/sid.member", "id/sid(i)", "id.member",
/// "id(i)" or "id". An id may contain dots, but no parentheses; only the last dot can begin a member.
const std::vector<const Element*>& targets_of(const Document& document, std::string_view target)
{
    const std::string_view first = target.substr(0, target.find('/'));
    if (const auto& found = document.with_id(first); !found.empty() || first.size() < target.size())
        return found;
    const std::size_t index = first.find('(');
    return document.with_id(first.substr(0, index != first.npos ? index : first.rfind('.')));
}

/// Whether `element` is the transform of a node, or lies inside one.
bool is_of_node(const Element& element)
{
    for (const tinyxml2::XMLNode* node = &element; node->ToElement() != nullptr; node = node->Parent())
        if (const std::string_view name = node->Value(); name == "node" || name == "visual_scene")
            return true;
    return false;
}

class AnimationWalk {
public:
    AnimationWalk(const Document& document, std::vector<std::string>& notices)
        : document_(&document), notices_(&notices)
    {}

    /// `parent` is a <library_animations> or an <animation>: they can be nested.
    void visit(const Element& parent) // NOLINT(misc-no-recursion): a document is at most 98 deep
    {
        for (const Element* channel : children(parent, "channel"))
            if (const char* target = channel->Attribute("target"))
                notice(*channel, targets_of(*document_, target));
        for (const Element* animation : children(parent, "animation")) visit(*animation);
    }

private:
    /// `elements` have the id that `channel` targets. Of several, one in use is enough.
    void notice(const Element& channel, const std::vector<const Element*>& elements)
    {
        const auto found = std::find_if(elements.begin(), elements.end(), [&](const Element* element) {
            return document_->is_in_use(*element);
        });
        if (found == elements.end() || !noticed_.insert(*found).second) return;
        const Element& element = **found;
        notices_->push_back(place(channel) + "the animation is not followed: " +
                            (is_of_node(element) ? "the nodes' own transforms are used"
                                                 : "the values in " + describe(element) + " are used"));
    }

    const Document* document_;
    std::vector<std::string>* notices_;
    std::unordered_set<const Element*> noticed_;
};

} // namespace

void notice_animations(const Document& document, std::vector<std::string>& notices)
{
    AnimationWalk walk(document, notices);
    for (const Element* library : children(document.root(), "library_animations")) walk.visit(*library);
}

} // namespace scenes::collada
