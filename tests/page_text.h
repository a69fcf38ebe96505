#pragma once

// HTML pages as text: what tests of all pages look for.

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <string>

namespace page_text {

/// The page without the content of its scripts and comments: what the browser would look into for other
/// files.
inline std::string markup(const std::string& page)
{
    std::string out;
    std::size_t at = 0;
    while (at < page.size()) {
        const bool comment = page.compare(at, 4, "<!--") == 0;
        const bool script = page.compare(at, 7, "<script") == 0;
        if (!comment && !script) {
            out += page[at++];
            continue;
        }
        const std::string end = comment ? "-->" : "</script>";
        if (script) out += page.substr(at, page.find('>', at) + 1 - at);
        at = std::min(page.find(end, at), page.size() - end.size()) + end.size();
    }
    return out;
}

inline std::size_t count(const std::string& text, const std::string& part)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
    return n;
}

inline nlohmann::ordered_json data_of(const std::string& page)
{
    const std::string tag = R"(<script id="data" type="application/json">)";
    const std::size_t begin = page.find(tag) + tag.size();
    return nlohmann::ordered_json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// The first piece of markup that names another file or address, or "".
inline std::string reference_to_a_file(const std::string& page)
{
    std::string plain; // in lower case, each white space a blank, none before "="
    for (const char c : markup(page)) {
        const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
        while (c == '=' && plain.ends_with(' ')) plain.pop_back();
        plain += blank ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    for (const char* reference :
         {" src=", " href=", " srcset=", " action=", " data=", " poster=", "<link", "<base", "<iframe",
          "<object", "<embed", "@import", "url(", "http"})
        if (plain.find(reference) != std::string::npos) return reference;
    return "";
}

/// The first mark of the template that stands in the page still, as "@DATA@", or "".
inline std::string unfilled_mark(const std::string& page)
{
    const std::string capitals = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
    for (std::size_t at = page.find('@'); at != std::string::npos; at = page.find('@', at + 1)) {
        const std::size_t end = page.find_first_not_of(capitals, at + 1);
        if (end != std::string::npos && end > at + 1 && page[end] == '@')
            return page.substr(at, end - at + 1);
    }
    return "";
}

} // namespace page_text
