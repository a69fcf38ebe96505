#include "check/npy.h"
#include "check/npy_format.h"

#include <bit>
#include <cstring>
#include <stdexcept>

namespace check {

namespace {

constexpr std::size_t written_header = 128; // a multiple of 64, as the format asks for

std::string with_header(const char* letters, std::span<const std::size_t> shape)
{
    std::string header = std::string("{'descr': '<") + letters +
                         "', 'fortran_order': False, 'shape': " + shape_text(shape) + ", }";
    constexpr std::size_t prefix = npy_format::magic.size() + 4;
    if (prefix + header.size() + 1 > written_header) throw std::invalid_argument("too many axes");
    header.resize(written_header - prefix - 1, ' ');
    header += '\n';
    const auto low = static_cast<char>(header.size() & 0xff);
    const auto high = static_cast<char>(header.size() >> 8);
    return std::string(npy_format::magic) + '\x01' + '\x00' + low + high + header;
}

template <typename Stored, typename Number>
void append_bytes(std::string& bytes, std::span<const Number> values)
{
    static_assert(std::endian::native == std::endian::little);
    const std::size_t begin = bytes.size();
    bytes.resize(begin + values.size() * sizeof(Stored));
    char* at = bytes.data() + begin;
    for (const Number value : values) {
        const auto stored = static_cast<Stored>(value);
        std::memcpy(at, &stored, sizeof(Stored));
        at += sizeof(Stored);
    }
}

} // namespace

std::string shape_text(std::span<const std::size_t> shape)
{
    std::string text = "(";
    for (std::size_t axis = 0; axis < shape.size(); ++axis)
        text += (axis > 0 ? ", " : "") + std::to_string(shape[axis]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

std::string npy_bytes(std::span<const std::size_t> shape, std::span<const double> reals,
                      bool single_precision)
{
    if (npy_format::element_count(shape) != reals.size())
        throw std::invalid_argument("shape and numbers disagree");
    std::string bytes = with_header(single_precision ? "f4" : "f8", shape);
    if (single_precision)
        append_bytes<float>(bytes, reals);
    else
        append_bytes<double>(bytes, reals);
    return bytes;
}

std::string npy_bytes(std::span<const std::size_t> shape, std::span<const std::int64_t> integers)
{
    if (npy_format::element_count(shape) != integers.size())
        throw std::invalid_argument("shape and numbers disagree");
    std::string bytes = with_header("i4", shape);
    append_bytes<std::int32_t>(bytes, integers);
    return bytes;
}

} // namespace check
