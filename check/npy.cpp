#include "check/npy.h"

#include "check/npy_format.h"
#include "images/atomic_file.h"
#include "images/image_error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

namespace check {

namespace {

using images::ImageError;

/// The value of `key` in the header, a literal of a Python dictionary: the text up to the next comma or
/// brace outside parentheses. Empty if there is none.
std::string_view value_of(std::string_view header, std::string_view key)
{
    for (const char quote : {'\'', '"'}) {
        const std::string quoted = quote + std::string(key) + quote;
        std::size_t at = header.find(quoted);
        if (at == std::string_view::npos) continue;
        at = header.find(':', at + quoted.size());
        if (at == std::string_view::npos) return {};
        at = header.find_first_not_of(" :", at);
        if (at == std::string_view::npos) return {};
        const std::string_view rest = header.substr(at);
        if (rest.front() == '(') return rest.substr(0, rest.find(')') + 1);
        return rest.substr(0, rest.find_first_of(",}"));
    }
    return {};
}

std::optional<std::vector<std::size_t>> parsed_shape(std::string_view text)
{
    if (text.size() < 2 || text.front() != '(' || text.back() != ')') return {};
    std::vector<std::size_t> shape;
    const char* at = text.data() + 1;
    const char* const end = text.data() + text.size() - 1;
    while (at != end) {
        if (*at == ' ' || *at == ',') {
            ++at;
            continue;
        }
        std::size_t extent = 0;
        const auto [next, error] = std::from_chars(at, end, extent);
        if (error != std::errc{}) return {};
        shape.push_back(extent);
        at = next;
    }
    return shape;
}

template <typename Number>
Number number_at(const char* bytes, bool swapped)
{
    std::array<char, sizeof(Number)> copy{};
    std::memcpy(copy.data(), bytes, sizeof(Number));
    if (swapped) std::ranges::reverse(copy);
    return std::bit_cast<Number>(copy);
}

template <typename Number>
void append(NpyArray& array, std::string_view bytes, bool swapped)
{
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(Number)) {
        const auto value = number_at<Number>(bytes.data() + i, swapped);
        if constexpr (std::is_floating_point_v<Number>)
            array.reals.push_back(value);
        else if constexpr (std::is_unsigned_v<Number> && sizeof(Number) >= 4)
            array.integers.push_back(
                value == std::numeric_limits<Number>::max() ? -1 : static_cast<std::int64_t>(value));
        else
            array.integers.push_back(value);
    }
}

/// A type of elements: its letters in the header, its name, its size, and how to read an array of it.
struct ElementType {
    const char* letters;
    const char* name;
    std::size_t bytes;
    void (*read)(NpyArray&, std::string_view, bool);
};

template <typename Number>
constexpr ElementType element_type(const char* letters, const char* name)
{
    return {letters, name, sizeof(Number), append<Number>};
}

constexpr std::array element_types = {
    element_type<float>("f4", "float32"),        element_type<double>("f8", "float64"),
    element_type<std::int8_t>("i1", "int8"),     element_type<std::int16_t>("i2", "int16"),
    element_type<std::int32_t>("i4", "int32"),   element_type<std::int64_t>("i8", "int64"),
    element_type<std::uint8_t>("u1", "uint8"),   element_type<std::uint16_t>("u2", "uint16"),
    element_type<std::uint32_t>("u4", "uint32"), element_type<std::uint64_t>("u8", "uint64"),
};

/// The elements of an array in Fortran order (the first index is the fastest), in C order.
template <typename Number>
std::vector<Number> in_c_order(const std::vector<Number>& values, std::span<const std::size_t> shape)
{
    std::vector<Number> result;
    result.reserve(values.size());
    std::vector<std::size_t> index(shape.size(), 0);
    while (result.size() < values.size()) {
        std::size_t at = 0;
        for (std::size_t axis = shape.size(); axis-- > 0;) at = at * shape[axis] + index[axis];
        result.push_back(values[at]);
        for (std::size_t axis = shape.size(); axis-- > 0;) {
            if (++index[axis] < shape[axis]) break;
            index[axis] = 0;
        }
    }
    return result;
}

/// Where the header of the file `bytes` is: its offset and length. Throws ImageError.
std::array<std::size_t, 2> header_of(const std::string& bytes, const std::filesystem::path& path)
{
    const auto byte = [&](std::size_t i) {
        return static_cast<std::size_t>(static_cast<unsigned char>(bytes[i]));
    };
    if (bytes.size() < 12 || !bytes.starts_with(npy_format::magic))
        throw ImageError(path, "is not a .npy file of NumPy");
    const bool long_header = bytes[6] != 1;
    const std::size_t begin = long_header ? 12 : 10;
    std::size_t length = byte(8) | byte(9) << 8;
    if (long_header) length |= byte(10) << 16 | byte(11) << 24;
    if (byte(6) < 1 || byte(6) > 3)
        throw ImageError(path, "has version " + std::to_string(byte(6)) + " of .npy, which is unknown");
    if (begin + length > bytes.size()) throw ImageError(path, "ends in its header");
    return {begin, length};
}

} // namespace

NpyArray read_npy(const std::filesystem::path& path)
{
    const std::string bytes = images::read_file(path);
    const auto [begin, length] = header_of(bytes, path);
    const std::string_view header = std::string_view(bytes).substr(begin, length);

    const std::string_view type = value_of(header, "descr");
    const std::string_view order = value_of(header, "fortran_order");
    const auto shape = parsed_shape(value_of(header, "shape"));
    if (type.starts_with('['))
        throw ImageError(path, "is a structured array: write an array of plain numbers");
    if (type.size() != 5 || !shape || (order != "True" && order != "False"))
        throw ImageError(path, "has a header that is not NumPy's");
    const auto known = std::ranges::find(element_types, type.substr(2, 2), &ElementType::letters);
    if (known == element_types.end())
        throw ImageError(path, "holds elements of type " + std::string(type) +
                                   ": there must be integers, float32 or float64");

    const std::optional<std::size_t> count = npy_format::element_count(*shape);
    const std::string_view data = std::string_view(bytes).substr(begin + length);
    if (!count || data.size() != *count * known->bytes)
        throw ImageError(path, "holds " + std::to_string(data.size()) +
                                   " bytes of elements: the shape " + shape_text(*shape) + " of " +
                                   known->name + " needs " +
                                   (count ? std::to_string(*count * known->bytes) : "more"));
    NpyArray array{*shape, known->name, {}, {}};
    known->read(array, data, type[1] == '>');
    if (order == "True") {
        array.reals = in_c_order(array.reals, array.shape);
        array.integers = in_c_order(array.integers, array.shape);
    }
    return array;
}

} // namespace check
