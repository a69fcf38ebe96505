#include "scenes/collada/document.h"

#include "scenes/collada/utf8.h"
#include "scenes/read_scene.h"

#include <algorithm>
#include <cctype>

namespace scenes::collada {
namespace {

using IdIndex = std::unordered_map<std::string_view, std::vector<const Element*>>;

[[noreturn]] void fail_at_line(const std::string& file_name, long line, const std::string& what)
{
    throw SceneError(file_name + ":" + std::to_string(line) + ": " + what);
}

const std::string& file_name_of(const tinyxml2::XMLNode& node)
{
    return *static_cast<const std::string*>(node.GetDocument()->GetUserData());
}

std::string lower_case(std::string_view text)
{
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

/// "XML_ERROR_MISMATCHED_ELEMENT" as "mismatched element".
std::string words_of(std::string_view error_name)
{
    constexpr std::string_view prefix = "XML_ERROR_";
    if (error_name.substr(0, prefix.size()) == prefix) error_name.remove_prefix(prefix.size());
    std::string words = lower_case(error_name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

/// Visits every node once: collects the ids, and refuses nodes that tinyxml2 accepts but XML or this
/// reader does not.
class Inspector : public tinyxml2::XMLVisitor {
public:
    explicit Inspector(IdIndex& elements_by_id) : elements_by_id_(&elements_by_id) {}

    bool VisitEnter(const Element& element, const tinyxml2::XMLAttribute* /*first*/) override
    {
        const char* id = element.Attribute("id");
        if (id != nullptr && *id != '\0') (*elements_by_id_)[id].push_back(&element);
        return true;
    }

    bool Visit(const tinyxml2::XMLDeclaration& declaration) override
    {
        const std::string value = lower_case(declaration.Value());
        const std::size_t encoding = value.find("encoding");
        if (encoding == std::string::npos) return true;
        const std::size_t open = value.find_first_of("\"'", encoding);
        const std::size_t close = open == std::string::npos ? open : value.find(value[open], open + 1);
        const std::string name =
            close == std::string::npos ? "" : value.substr(open + 1, close - open - 1);
        if (name != "utf-8" && name != "us-ascii")
            fail_at_line(file_name_of(declaration), declaration.GetLineNum(),
                         "<?xml>: encoding " + in_quotes(name) + " is not UTF-8");
        return true;
    }

    bool Visit(const tinyxml2::XMLUnknown& unknown) override
    {
        const std::string_view value = unknown.Value();
        fail_at_line(file_name_of(unknown), unknown.GetLineNum(),
                     "<!" + legible(value.substr(0, value.find_first_of(" \t\r\n"))) +
                         ">: declarations are not allowed");
    }

private:
    IdIndex* elements_by_id_;
};

void check_encoding(std::string_view xml, const std::string& file_name)
{
    const std::size_t bad = first_bad_byte(xml);
    if (bad == xml.size()) return;
    const auto line = 1 + std::count(xml.begin(), xml.begin() + static_cast<std::ptrdiff_t>(bad), '\n');
    fail_at_line(file_name, line, "byte " + std::to_string(bad) + " is not part of a text in UTF-8");
}

/// Checks for one COLLADA element, with only comments and the XML declaration beside it.
void check_top_level(const tinyxml2::XMLDocument& xml, const std::string& file_name)
{
    const Element* root = xml.RootElement();
    if (root == nullptr) fail_at_line(file_name, 1, "no <COLLADA> element in the file");
    for (const auto* node = xml.FirstChild(); node != nullptr; node = node->NextSibling()) {
        if (const Element* element = node->ToElement(); element != nullptr && element != root)
            fail(*element, "a second element beside " + describe(*root));
        if (node->ToText() != nullptr)
            fail_at_line(file_name, node->GetLineNum(), "text outside of " + describe(*root));
    }
}

std::string with_line(const Element& element)
{
    return "the " + in_brackets(element) + " in line " + std::to_string(element.GetLineNum());
}

/// "two elements have the id "x": the <node> in line 3 and the <node> in line 7".
std::string ambiguity(std::string_view id, const std::vector<const Element*>& elements)
{
    const std::string have = " elements have the id " + in_quotes(id) + ": " + with_line(*elements[0]);
    if (elements.size() == 2) return "two" + have + " and " + with_line(*elements[1]);
    return std::to_string(elements.size()) + have + ", " + with_line(*elements[1]) + " and so on";
}

} // namespace

Document::Document(std::string_view xml, const std::string& file_name)
    : file_name_(std::make_unique<std::string>(legible(file_name))),
      xml_(std::make_unique<tinyxml2::XMLDocument>())
{
    if (xml.empty()) fail_at_line(*file_name_, 1, "the file is empty");
    check_encoding(xml, *file_name_);
    xml_->SetUserData(file_name_.get());
    xml_->Parse(xml.data(), xml.size());
    if (xml_->ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
        fail_at_line(*file_name_, xml_->ErrorLineNum(), "elements nested deeper than 98");
    if (xml_->Error())
        fail_at_line(*file_name_, std::max(1, xml_->ErrorLineNum()),
                     "not well-formed XML: " + words_of(xml_->ErrorName()));
    Inspector inspector(elements_by_id_);
    xml_->Accept(&inspector);
    check_top_level(*xml_, *file_name_);
}

const Element& Document::target(const Element& from, const char* attribute,
                                std::string_view expected) const
{
    const std::string_view url = required_attribute(from, attribute);
    if (url.size() < 2 || url[0] != '#')
        fail(from, std::string(attribute) + " " + in_quotes(url) +
                       " is not of the form \"#id\": other files are not read");
    const std::string_view id = url.substr(1);
    const std::vector<const Element*>& found = with_id(id);
    if (found.empty()) fail(from, "nothing has the id " + in_quotes(id));
    if (found.size() > 1) fail(from, ambiguity(id, found));
    const Element& element = *found.front();
    if (element.Name() != expected)
        fail(from, in_quotes(url) + " is a " + in_brackets(element) + ", not a <" +
                       std::string(expected) + ">");
    targets_.insert(&element);
    return element;
}

const std::vector<const Element*>& Document::with_id(std::string_view id) const
{
    static const std::vector<const Element*> none;
    const auto found = elements_by_id_.find(id);
    return found == elements_by_id_.end() ? none : found->second;
}

bool Document::is_in_use(const Element& element) const
{
    for (const tinyxml2::XMLNode* node = &element; node != nullptr; node = node->Parent())
        if (const Element* around = node->ToElement(); around != nullptr && targets_.contains(around))
            return true;
    return false;
}

} // namespace scenes::collada
