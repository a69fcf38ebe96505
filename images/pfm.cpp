#include "images/pfm.h"
#include "images/atomic_file.h"
#include "images/image_error.h"
#include "images/picture_size.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>
#include <string_view>

namespace images {

namespace fs = std::filesystem;

namespace {

struct Header {
    int width, height;
    int channels;
    double scale;
    bool little_endian;
};

bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

/// Removes the word at the head of `bytes` and the white space behind it: one character if `last`, since
/// the data that follow may begin with bytes of white space.
std::string_view take_word(const fs::path& path, std::string_view& bytes, bool last = false)
{
    constexpr std::size_t longest = 32;
    std::size_t length = 0;
    while (length < bytes.size() && length <= longest && !is_space(bytes[length])) ++length;
    if (length == 0 || length > longest || length == bytes.size())
        throw ImageError(path, "the PFM header is not complete");
    const std::string_view word = bytes.substr(0, length);
    bytes.remove_prefix(length + 1);
    while (!last && !bytes.empty() && is_space(bytes.front())) bytes.remove_prefix(1);
    return word;
}

template <class Number>
Number parse(const fs::path& path, std::string_view word)
{
    Number number{};
    const char* const end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(word.data(), end, number);
    if (error != std::errc() || rest != end)
        throw ImageError(path, "'" + std::string(word) + "' in the PFM header is no number");
    return number;
}

Header take_header(const fs::path& path, std::string_view& bytes)
{
    if (!bytes.starts_with("PF") && !bytes.starts_with("Pf"))
        throw ImageError(path, "not a PFM file: it does not begin with PF or Pf");
    Header header{};
    const std::string_view kind = take_word(path, bytes);
    if (kind.size() != 2) throw ImageError(path, "not a PFM file: it does not begin with PF or Pf");
    header.channels = kind == "PF" ? 3 : 1;
    header.width = parse<int>(path, take_word(path, bytes));
    header.height = parse<int>(path, take_word(path, bytes));
    const std::string_view word = take_word(path, bytes, true);
    const auto scale = parse<double>(path, word);
    check_size(path, header.width, header.height);
    if (scale == 0.0 || !std::isfinite(scale))
        throw ImageError(path, "the PFM scale is " + std::string(word) +
                                   ", and must be a finite number other than 0");
    header.scale = std::abs(scale);
    header.little_endian = scale < 0.0;
    return header;
}

float take_float(std::string_view& bytes, bool little_endian)
{
    std::uint32_t bits = 0;
    for (unsigned i = 0; i < 4; ++i) {
        const auto byte = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i]));
        bits |= byte << (8 * (little_endian ? i : 3 - i));
    }
    bytes.remove_prefix(4);
    return std::bit_cast<float>(bits);
}

void append_float(std::string& bytes, double value)
{
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (unsigned i = 0; i < 4; ++i) bytes += static_cast<char>(bits >> (8 * i) & 0xff);
}

} // namespace

void write_pfm(const fs::path& path, const Image& image)
{
    check_size(path, image);
    std::string bytes =
        "PF\n" + std::to_string(image.width) + " " + std::to_string(image.height) + "\n-1.0\n";
    bytes.reserve(bytes.size() + image.pixels.size() * 3 * sizeof(float));
    for (int y = image.height - 1; y >= 0; --y)
        for (int x = 0; x < image.width; ++x)
            for (int channel = 0; channel < 3; ++channel) append_float(bytes, image.at(x, y)[channel]);
    write_atomically(path, bytes);
}

Image read_pfm(const fs::path& path)
{
    const std::string file = read_file(path);
    std::string_view bytes = file;
    const Header header = take_header(path, bytes);
    const std::size_t values = static_cast<std::size_t>(header.width) *
                               static_cast<std::size_t>(header.height) *
                               static_cast<std::size_t>(header.channels);
    if (bytes.size() != values * sizeof(float))
        throw ImageError(path,
                         std::string(bytes.size() < values * sizeof(float) ? "truncated" : "too long") +
                             ": " + std::to_string(bytes.size()) + " bytes of pixels instead of " +
                             std::to_string(values * sizeof(float)));
    Image image(header.width, header.height);
    for (int y = header.height - 1; y >= 0; --y)
        for (int x = 0; x < header.width; ++x) {
            Rgb& pixel = image.at(x, y);
            pixel = Rgb(take_float(bytes, header.little_endian));
            for (int channel = 1; channel < header.channels; ++channel)
                pixel[channel] = take_float(bytes, header.little_endian);
            if (header.scale != 1.0) pixel *= header.scale; // NaNs keep their bits otherwise
        }
    return image;
}

} // namespace images
