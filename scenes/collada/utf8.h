#pragma once

// Checks that bytes are text of an XML 1.0 document in UTF-8.

#include <cstddef>
#include <string_view>

namespace scenes::collada {

/// Offset of the first byte that does not belong to a well-formed UTF-8 sequence [Unicode 15, table 3-7]
/// or begins a control character that XML 1.0 excludes (all below U+0020 but tab, line feed and carriage
/// return, so also NUL); text.size() if there is none.
std::size_t first_bad_byte(std::string_view text);

} // namespace scenes::collada
