#pragma once

// HTML pages that are made from a template: text with marks such as @TITLE@.

#include <span>
#include <string>
#include <string_view>

namespace images {

/// `text` for a place between tags, where it cannot begin a tag or an entity. Not for attributes: quotes
/// stay.
std::string html_text(std::string_view text);

/// The JSON text `json` for a script element of the type application/json: the same values, but no "<",
/// the only character with which the element could end.
std::string script_data(std::string_view json);

/// A mark of a template, with both "@", and what replaces it.
struct Mark {
    std::string_view mark;
    std::string_view content;
};

/// The template `page` with every mark replaced. Marks within a content are not replaced, and other "@"
/// stay.
std::string fill(std::string_view page, std::span<const Mark> marks);

} // namespace images
