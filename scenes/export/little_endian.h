#pragma once

// Numbers as bytes, the least significant byte first, as binary PLY and glTF want them.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

namespace scenes::exports {

inline void append_little_endian(std::string& bytes, std::uint64_t bits, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xffU);
}
inline void append_little_endian(std::string& bytes, std::uint32_t number)
{
    append_little_endian(bytes, number, sizeof number);
}
inline void append_little_endian(std::string& bytes, float number)
{
    append_little_endian(bytes, std::bit_cast<std::uint32_t>(number), sizeof number);
}
inline void append_little_endian(std::string& bytes, double number)
{
    append_little_endian(bytes, std::bit_cast<std::uint64_t>(number), sizeof number);
}

} // namespace scenes::exports
