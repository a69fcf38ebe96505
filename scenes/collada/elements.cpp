// The functions of document.h that look at one element and its children.

#include "scenes/collada/document.h"
#include "scenes/read_scene.h"

#include <algorithm>

namespace scenes::collada {
namespace {

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view white_space = " \t\n\r";
    text.remove_prefix(std::min(text.find_first_not_of(white_space), text.size()));
    return text.substr(0, text.find_last_not_of(white_space) + 1);
}

/// Whether `name` equals `known`, or begins with the part of `known` before a final star.
bool matches(std::string_view name, std::string_view known)
{
    return known.ends_with('*') ? name.starts_with(known.substr(0, known.size() - 1)) : name == known;
}

} // namespace

std::string legible(std::string_view text)
{
    constexpr std::size_t longest = 60;
    std::string result(text.substr(0, longest));
    std::replace_if(
        result.begin(), result.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, '?');
    if (text.size() > longest) {
        // A UTF-8 sequence that would be cut in the middle is removed as a whole.
        const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
        if (continues(text[longest])) {
            while (continues(result.back())) result.pop_back();
            result.pop_back();
        }
        result += "...";
    }
    return result;
}

std::string in_quotes(std::string_view text)
{
    return "\"" + legible(text) + "\"";
}

std::string in_brackets(const Element& element)
{
    return "<" + legible(element.Name()) + ">";
}

std::string describe(const Element& element)
{
    for (const char* attribute : {"id", "url", "target", "material", "semantic", "source", "name"})
        if (const char* value = element.Attribute(attribute))
            return "<" + legible(element.Name()) + " " + attribute + "=" + in_quotes(value) + ">";
    return in_brackets(element);
}

std::string place(const Element& element)
{
    const auto& file_name = *static_cast<const std::string*>(element.GetDocument()->GetUserData());
    return file_name + ":" + std::to_string(element.GetLineNum()) + ": " + describe(element) + ": ";
}

void fail(const Element& at, const std::string& what)
{
    throw SceneError(place(at) + what);
}

std::string_view required_attribute(const Element& element, const char* name)
{
    const char* value = element.Attribute(name);
    if (value == nullptr) fail(element, "attribute \"" + std::string(name) + "\" is missing");
    return value;
}

std::string text_of(const Element& element)
{
    std::string text;
    for (const auto* node = element.FirstChild(); node != nullptr; node = node->NextSibling()) {
        if (const Element* child = node->ToElement())
            fail(*child, "not known inside " + describe(element));
        if (node->ToText() != nullptr) text += node->Value();
    }
    return text;
}

std::vector<const Element*> children(const Element& parent, const char* name)
{
    std::vector<const Element*> result;
    for (const auto* e = parent.FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name))
        result.push_back(e);
    return result;
}

const Element* optional_child(const Element& parent, const char* name)
{
    const Element* child = parent.FirstChildElement(name);
    if (child == nullptr) return nullptr;
    if (const Element* second = child->NextSiblingElement(name))
        fail(*second, "a second <" + std::string(name) + "> in " + describe(parent));
    return child;
}

const Element& required_child(const Element& parent, const char* name)
{
    const Element* child = optional_child(parent, name);
    if (child == nullptr) fail(parent, "no <" + std::string(name) + "> in it");
    return *child;
}

void check_children(const Element& parent, std::initializer_list<std::string_view> known, Cmu462 profile)
{
    for (const auto* node = parent.FirstChild(); node != nullptr; node = node->NextSibling()) {
        if (node->ToText() != nullptr)
            fail(parent, "text " + in_quotes(trimmed(node->Value())) + " is not known here");
        const Element* child = node->ToElement();
        if (child == nullptr) continue;
        const std::string_view name = child->Name();
        if (name == "technique" && child->Attribute("profile", "CMU462"))
            fail(*child, "the CMU462 profile belongs in an <extra>");
        if (name != "extra" && name != "asset" &&
            std::none_of(known.begin(), known.end(),
                         [&](std::string_view one) { return matches(name, one); }))
            fail(*child, "not known inside " + describe(parent));
    }
    if (profile == Cmu462::understood) return;
    if (const Element* technique = cmu462_technique(parent))
        fail(*technique->FirstChildElement(),
             "the CMU462 profile does not apply to " + describe(parent));
}

const Element* cmu462_technique(const Element& owner)
{
    const Element* found = nullptr;
    for (const Element* extra : children(owner, "extra"))
        for (const Element* technique : children(*extra, "technique")) {
            if (!technique->Attribute("profile", "CMU462") || technique->FirstChildElement() == nullptr)
                continue;
            if (found != nullptr) fail(*technique, "a second CMU462 profile for " + describe(owner));
            found = technique;
        }
    return found;
}

} // namespace scenes::collada
