#include "images/exr_checksum.h"

#include "images/exr_format.h"

#include <xxhash.h>

#include <cstdint>
#include <cstdio>

namespace images {

namespace {

constexpr std::size_t checksum_digits = 16;

/// The place of the digits; npos if the bytes have no such attribute. It is written as its name and its
/// type, each with a zero byte, the size as four bytes, and the digits.
std::size_t place_of_checksum(std::string_view bytes)
{
    const std::string head = std::string(exr_format::checksum_attribute) + '\0' + "string" + '\0' +
                             static_cast<char>(checksum_digits) + std::string(3, '\0');
    const std::size_t place = bytes.find(head);
    if (place == std::string_view::npos || bytes.size() - place < head.size() + checksum_digits)
        return std::string_view::npos;
    return place + head.size();
}

/// Of the bytes with a blank in its place.
std::string checksum_of(std::string_view bytes, std::size_t place)
{
    XXH3_state_t* const state = XXH3_createState();
    XXH3_64bits_reset(state);
    const std::string blank = blank_checksum();
    const std::string_view rest = bytes.substr(place + checksum_digits);
    XXH3_64bits_update(state, bytes.data(), place);
    XXH3_64bits_update(state, blank.data(), blank.size());
    XXH3_64bits_update(state, rest.data(), rest.size());
    char text[checksum_digits + 1];
    std::snprintf(text, sizeof text, "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits_digest(state)));
    XXH3_freeState(state);
    return text;
}

} // namespace

std::string blank_checksum()
{
    return std::string(checksum_digits, '0');
}

void add_checksum(std::string& bytes)
{
    const std::size_t place = place_of_checksum(bytes);
    if (place != std::string::npos) bytes.replace(place, checksum_digits, checksum_of(bytes, place));
}

bool has_right_checksum(std::string_view bytes)
{
    const std::size_t place = place_of_checksum(bytes);
    return place == std::string_view::npos ||
           bytes.substr(place, checksum_digits) == checksum_of(bytes, place);
}

} // namespace images
