#include "images/page_template.h"

#include <algorithm>

namespace images {

std::string html_text(std::string_view text)
{
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else
            out += c;
    }
    return out;
}

std::string script_data(std::string_view json)
{
    std::string text;
    text.reserve(json.size());
    for (const char c : json)
        if (c == '<')
            text += "\\u003c"; // "<" occurs in JSON within strings only
        else
            text += c;
    return text;
}

std::string fill(std::string_view page, std::span<const Mark> marks)
{
    std::string filled;
    while (!page.empty()) {
        const auto mark = std::find_if(marks.begin(), marks.end(),
                                       [&](const Mark& m) { return page.starts_with(m.mark); });
        if (mark != marks.end()) {
            filled += mark->content;
            page.remove_prefix(mark->mark.size());
            continue;
        }
        const std::size_t next = page.find('@', 1);
        filled += page.substr(0, next);
        page.remove_prefix(std::min(next, page.size()));
    }
    return filled;
}

} // namespace images
