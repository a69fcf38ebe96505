#pragma once

// The checksum of our EXR files with a state: an attribute, which is found in the bytes of the file.

#include <string>
#include <string_view>

namespace images {

/// What the attribute holds until the checksum is known.
std::string blank_checksum();

/// Writes the checksum of all bytes in the place of blank_checksum(), if it is there.
void add_checksum(std::string& bytes);

/// Whether the bytes have the checksum that they state; true if they state none.
bool has_right_checksum(std::string_view bytes);

} // namespace images
