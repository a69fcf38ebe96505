#pragma once

// Bytes as text, for pages and JSON [RFC 4648, sec. 4].

#include <string>
#include <string_view>

namespace images {

/// The bytes in base64, with padding.
std::string base64(std::string_view bytes);

/// The bytes of such a text. Throws std::invalid_argument for a text that base64 does not write.
std::string from_base64(std::string_view text);

} // namespace images
