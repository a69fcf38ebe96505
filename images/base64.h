#pragma once

// Bytes as text, for pictures in pages and in JSON.

#include <string>
#include <string_view>

namespace images {

/// `bytes` in base64, padded with "=" [RFC 4648, sec. 4].
std::string base64(std::string_view bytes);

} // namespace images
