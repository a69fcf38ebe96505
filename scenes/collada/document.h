#pragma once

// An XML document. Its elements have a file and a line, and can be found by their id.

#include <tinyxml2.h>

#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace scenes::collada {

using Element = tinyxml2::XMLElement;

/// The document and an index of its ids. The text must be well-formed XML in UTF-8. Throws SceneError if
/// it is not, for a document type declaration (with entities a small file could become large), for
/// elements nested deeper than 98 (tinyxml2 counts the document and stops at 100), and for an attribute
/// given twice. Several elements may have the same id if no reference to it is followed.
class Document {
public:
    Document(std::string_view xml, const std::string& file_name);

    [[nodiscard]] const Element& root() const { return *xml_->RootElement(); }

    /// The element that `attribute` of `from` refers to in the form "#id". Throws SceneError if the
    /// attribute is missing or malformed, if no <expected> element has that id, or if another element
    /// has it as well.
    [[nodiscard]] const Element& target(const Element& from, const char* attribute,
                                        std::string_view expected) const;

    /// The elements of that id, in the order of the file; none if `id` is empty.
    [[nodiscard]] const std::vector<const Element*>& with_id(std::string_view id) const;

    /// Whether target() has found `element` so far, or an element that contains it.
    [[nodiscard]] bool is_in_use(const Element& element) const;

private:
    std::unique_ptr<std::string> file_name_; // its address is known to the document
    std::unique_ptr<tinyxml2::XMLDocument> xml_;
    std::unordered_map<std::string_view, std::vector<const Element*>> elements_by_id_;
    mutable std::unordered_set<const Element*> targets_; // the elements that target() has found
};

/// `element` as messages show it: `<light id="Sun">`.
std::string describe(const Element& element);
/// The beginning of every message about `element`: `file.dae:12: <light id="Sun">: `.
std::string place(const Element& element);
/// Throws SceneError with place(at) and `what`.
[[noreturn]] void fail(const Element& at, const std::string& what);
/// `text` cut short, with control characters replaced, for a message of one line.
std::string legible(std::string_view text);
/// The same between quotation marks.
std::string in_quotes(std::string_view text);
/// The name of `element` between angle brackets: `<light>`.
std::string in_brackets(const Element& element);

/// The value of an attribute that must be there; fails otherwise.
std::string_view required_attribute(const Element& element, const char* name);
/// The text of an element that holds nothing else (comments do not count).
std::string text_of(const Element& element);

/// All children of that name, in order.
std::vector<const Element*> children(const Element& parent, const char* name);
/// The only child of that name, or null; fails if there are several.
const Element* optional_child(const Element& parent, const char* name);
/// The only child of that name; fails unless there is exactly one.
const Element& required_child(const Element& parent, const char* name);

/// Whether the CMU462 profile may describe an element.
enum class Cmu462 { refused, understood };
/// Fails at the first child of `parent` that is not one of `known`, where "library_*" stands for every
/// name that begins with "library_". <asset> and <extra> are always known, but an <extra> in the CMU462
/// profile is allowed only if `profile` is `understood`. A <technique> of that profile in any other
/// place would be overlooked, so it fails.
void check_children(const Element& parent, std::initializer_list<std::string_view> known,
                    Cmu462 profile = Cmu462::refused);
/// The <technique profile="CMU462"> in an <extra> of `owner`, or null if there is none or it is empty.
const Element* cmu462_technique(const Element& owner);

} // namespace scenes::collada
