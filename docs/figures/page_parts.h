#pragma once

// The parts of a page that a program writes. A part stands between two lines:
//
//     <!-- PROGRAM: NAME -->
//     ...
//     <!-- PROGRAM: end -->

#include <map>
#include <stdexcept>
#include <string>

namespace figures {

/// `page` with the text of each part in its place, between two empty lines. Throws std::invalid_argument
/// if the page lacks a part or an end, has one twice, or names one that is not in `parts`.
inline std::string with_parts(const std::string& page, const std::string& program,
                              std::map<std::string, std::string> parts)
{
    const std::string open = "<!-- " + program + ": ";
    const std::string close = " -->\n";
    const std::string end = open + "end" + close;
    std::string out;
    std::size_t at = 0;
    for (;;) {
        const std::size_t begin = page.find(open, at);
        if (begin == std::string::npos) break;
        const std::size_t name_at = begin + open.size();
        const std::size_t name_end = page.find(close, name_at);
        const std::size_t after = page.find(end, begin);
        if (begin == after)
            throw std::invalid_argument("an end without a beginning, after " + std::to_string(begin) +
                                        " bytes");
        if (name_end == std::string::npos || after == std::string::npos || after < name_end)
            throw std::invalid_argument(
                "the mark in \"" + page.substr(begin, page.find('\n', begin) - begin) + "\" has no end");
        const auto part = parts.extract(page.substr(name_at, name_end - name_at));
        if (part.empty())
            throw std::invalid_argument("no part of the page, or one twice: " +
                                        page.substr(name_at, name_end - name_at));
        out += page.substr(at, name_end + close.size() - at) + "\n" + part.mapped() + "\n" + end;
        at = after + end.size();
    }
    if (!parts.empty()) throw std::invalid_argument("the page has no mark for " + parts.begin()->first);
    return out + page.substr(at);
}

} // namespace figures
