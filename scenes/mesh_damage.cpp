#include "scenes/mesh_damage.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace scenes {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

struct PlyType {
    std::size_t bytes;
    bool is_signed;
    bool is_whole;
};

std::optional<PlyType> type_named(std::string_view name)
{
    constexpr std::array<std::pair<std::string_view, PlyType>, 16> types = {
        {{"char", {1, true, true}},
         {"int8", {1, true, true}},
         {"uchar", {1, false, true}},
         {"uint8", {1, false, true}},
         {"short", {2, true, true}},
         {"int16", {2, true, true}},
         {"ushort", {2, false, true}},
         {"uint16", {2, false, true}},
         {"int", {4, true, true}},
         {"int32", {4, true, true}},
         {"uint", {4, false, true}},
         {"uint32", {4, false, true}},
         {"float", {4, true, false}},
         {"float32", {4, true, false}},
         {"double", {8, true, false}},
         {"float64", {8, true, false}}}};
    for (const auto& [known, type] : types)
        if (name == known) return type;
    return std::nullopt;
}

struct PlyProperty {
    std::optional<PlyType> count; // of a list
    PlyType type;
};

struct PlyElement {
    std::string name;
    std::uint64_t count;
    std::vector<PlyProperty> properties;
};

enum class PlyFormat { ascii, little_endian, big_endian };

struct PlyHeader {
    std::optional<PlyFormat> format;
    std::vector<PlyElement> elements;
};

/// Reads the words of one line of the header into `header`; returns false for a line that is not valid.
bool read_line(const std::vector<std::string>& words, PlyHeader& header)
{
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return true;
    if (words[0] == "format" && words.size() == 3) {
        if (words[1] == "ascii") header.format = PlyFormat::ascii;
        if (words[1] == "binary_little_endian") header.format = PlyFormat::little_endian;
        if (words[1] == "binary_big_endian") header.format = PlyFormat::big_endian;
        return header.format.has_value();
    }
    if (words[0] == "element" && words.size() == 3) {
        std::uint64_t count = 0;
        const char* const end = words[2].data() + words[2].size();
        const auto [rest, error] = std::from_chars(words[2].data(), end, count);
        header.elements.push_back({words[1], count, {}});
        return error == std::errc() && rest == end;
    }
    if (words[0] != "property" || header.elements.empty()) return false;
    const bool list = words.size() == 5 && words[1] == "list";
    if (!list && words.size() != 3) return false;
    const auto type = type_named(words[list ? 3 : 1]);
    const auto count = list ? type_named(words[2]) : std::nullopt;
    if (!type || (list && (!count || !count->is_whole))) return false;
    header.elements.back().properties.push_back({count, *type});
    return true;
}

/// The body of the file, after the header, number by number.
class PlyBody {
public:
    PlyBody(std::string_view bytes, PlyFormat format) : bytes_(bytes), format_(format) {}

    /// Skips one number; false if it is missing.
    bool skip(const PlyType& type)
    {
        if (format_ == PlyFormat::ascii) return number().has_value();
        if (bytes_.size() < type.bytes) return false;
        bytes_.remove_prefix(type.bytes);
        return true;
    }

    /// The length of a list; std::nullopt if it is missing or not a whole number >= 0.
    std::optional<std::uint64_t> length(const PlyType& type)
    {
        if (format_ == PlyFormat::ascii) {
            const auto value = number();
            if (!value || !(*value >= 0 && *value < 4294967296.0)) return std::nullopt;
            const auto whole = static_cast<std::uint64_t>(*value);
            return static_cast<double>(whole) == *value ? std::optional(whole) : std::nullopt;
        }
        if (bytes_.size() < type.bytes) return std::nullopt;
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < type.bytes; ++i) {
            const std::size_t at = format_ == PlyFormat::big_endian ? i : type.bytes - 1 - i;
            value = value << 8U | static_cast<unsigned char>(bytes_[at]);
        }
        bytes_.remove_prefix(type.bytes);
        const bool negative = type.is_signed && (value >> (8 * type.bytes - 1) & 1U) != 0;
        return negative ? std::nullopt : std::optional(value);
    }

    [[nodiscard]] std::size_t left() const { return bytes_.size(); }

private:
    std::optional<double> number()
    {
        const std::size_t begin = bytes_.find_first_not_of(blanks);
        if (begin == std::string_view::npos) return std::nullopt;
        const std::size_t end = std::min(bytes_.find_first_of(blanks, begin), bytes_.size());
        const std::string word(bytes_.substr(begin, end - begin));
        bytes_.remove_prefix(end);
        char* rest = nullptr;
        const double value = std::strtod(word.c_str(), &rest);
        return rest == word.c_str() + word.size() ? std::optional(value) : std::nullopt;
    }

    std::string_view bytes_;
    PlyFormat format_;
};

/// The 32-bit little-endian number at the start of `bytes`, which has at least four bytes.
std::size_t little_endian(std::string_view bytes)
{
    std::size_t value = 0;
    for (std::size_t i = 4; i-- > 0;) value = value << 8U | static_cast<unsigned char>(bytes[i]);
    return value;
}

/// Whether the next words of `text` are `expected`, where "#" stands for any number.
bool takes(std::istream& text, const std::vector<std::string_view>& expected)
{
    std::string word;
    for (const std::string_view one : expected) {
        if (!(text >> word)) return false;
        if (one != "#" && word != one) return false;
        if (one != "#") continue;
        char* rest = nullptr;
        (void)std::strtod(word.c_str(), &rest);
        if (rest != word.c_str() + word.size()) return false;
    }
    return true;
}

/// The damage in a text file: one solid or several, each of facets of three vertices.
std::string damage_of_stl_text(const std::string& bytes)
{
    std::istringstream text(bytes);
    std::string word;
    for (std::size_t facets = 0; text >> word;) {
        if (word != "solid") return "the word \"" + word.substr(0, 40) + "\" is not \"solid\"";
        for (std::getline(text, word);; ++facets) { // the first line ends with a name
            if (!(text >> word)) return "cut short: no \"endsolid\"";
            if (word == "endsolid") break;
            if (word != "facet" ||
                !takes(text, {"normal", "#", "#", "#",      "outer",   "loop",    "vertex",
                              "#",      "#", "#", "vertex", "#",       "#",       "#",
                              "vertex", "#", "#", "#",      "endloop", "endfacet"}))
                return "damaged or cut short: facet " + std::to_string(facets + 1) + " is not whole";
        }
        std::getline(text, word);
    }
    return "";
}

/// Skips one element; false if a part of it is missing.
bool skip(PlyBody& body, const PlyElement& element)
{
    for (const PlyProperty& property : element.properties) {
        std::uint64_t numbers = 1;
        if (property.count) {
            const auto length = body.length(*property.count);
            if (!length || *length > body.left()) return false; // each takes a byte or more
            numbers = *length;
        }
        for (std::uint64_t i = 0; i < numbers; ++i)
            if (!body.skip(property.type)) return false;
    }
    return true;
}

} // namespace

std::string damage_of_ply(std::string_view bytes)
{
    PlyHeader header;
    std::size_t at = 0;
    for (std::size_t line = 1;; ++line) {
        const std::size_t end = bytes.find('\n', at);
        if (end == std::string_view::npos) return "the header has no end_header";
        std::istringstream text{std::string(bytes.substr(at, end - at))};
        at = end + 1;
        std::vector<std::string> words;
        for (std::string word; text >> word;) words.push_back(word);
        if (line == 1) {
            if (words != std::vector<std::string>{"ply"}) return "the first line is not \"ply\"";
            continue;
        }
        if (words == std::vector<std::string>{"end_header"}) break;
        if (!read_line(words, header))
            return "line " + std::to_string(line) + " of the header is not understood";
    }
    if (!header.format) return "the header has no format";
    PlyBody body(bytes.substr(at), *header.format);
    for (const PlyElement& element : header.elements)
        for (std::uint64_t i = 0; i < element.count && !element.properties.empty(); ++i)
            if (!skip(body, element))
                return "damaged or cut short: element " + std::to_string(i + 1) + " of " +
                       std::to_string(element.count) + " (\"" + element.name + "\") is not whole";
    return "";
}

std::string damage_of_stl(std::string_view bytes)
{
    constexpr std::size_t header = 80;
    constexpr std::size_t triangle = 50;
    if (bytes.size() >= header + 4 &&
        bytes.size() == header + 4 + little_endian(bytes.substr(header)) * triangle)
        return "";
    const std::size_t first = bytes.find_first_not_of(blanks);
    if (first == std::string_view::npos || !bytes.substr(first).starts_with("solid"))
        return "damaged or cut short: neither a text that begins with \"solid\", nor as long as a "
               "binary "
               "file with its number of triangles";
    return damage_of_stl_text(std::string(bytes));
}

std::string damage_of_glb(std::string_view bytes)
{
    constexpr std::size_t header = 12;
    constexpr std::size_t chunk_header = 8;
    if (bytes.size() < header || !bytes.starts_with("glTF")) return "does not begin with \"glTF\"";
    if (little_endian(bytes.substr(8)) != bytes.size())
        return "damaged or cut short: has " + std::to_string(bytes.size()) + " bytes, not the " +
               std::to_string(little_endian(bytes.substr(8))) + " of its header";
    for (bytes.remove_prefix(header); !bytes.empty();) {
        const std::size_t room = bytes.size() < chunk_header ? 0 : bytes.size() - chunk_header;
        if (bytes.size() < chunk_header || little_endian(bytes) > room)
            return "damaged or cut short: a chunk reaches beyond the end of the file";
        bytes.remove_prefix(chunk_header + little_endian(bytes));
    }
    return "";
}

} // namespace scenes
