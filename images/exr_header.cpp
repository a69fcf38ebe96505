#include "images/exr_header.h"

#include "images/exr_stream.h"
#include "images/image_error.h"
#include "images/picture_size.h"

#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfPartType.h>
#include <ImfTestFile.h>
#include <ImfTileDescription.h>
#include <ImfVersion.h>

#include <algorithm>
#include <string>

namespace images {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t first_header = 8; // behind the magic number and the version

/// A little-endian word, which must lie within the file.
std::uint32_t word_at(std::string_view bytes, std::size_t place)
{
    std::uint32_t word = 0;
    for (unsigned i = 0; i < 4; ++i)
        word |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[place + i])) << (8 * i);
    return word;
}

/// The number of headers. Throws unless each attribute ends within the file: OpenEXR allocates a string
/// of the size that its attribute states before it reads it.
int count_headers(const fs::path& path, std::string_view bytes, bool parts)
{
    std::size_t place = first_header;
    const auto text = [&] { // a name, ended by a zero
        const std::size_t end = bytes.find('\0', place);
        if (end == std::string_view::npos) throw ImageError(path, "truncated or damaged in its header");
        const std::string_view name = bytes.substr(place, end - place);
        place = end + 1;
        return name;
    };
    int headers = 0;
    bool begun = false; // an attribute of the present header was read
    for (;;) {
        const std::string_view name = text();
        if (name.empty()) {
            headers += begun ? 1 : 0;
            if (!begun || !parts) return headers; // an empty header ends those of several parts
            begun = false;
            continue;
        }
        begun = true;
        text(); // the type
        if (bytes.size() - place < 4) throw ImageError(path, "truncated or damaged in its header");
        const std::size_t size = word_at(bytes, place);
        place += 4;
        if (size > bytes.size() - place)
            throw ImageError(path, "truncated or damaged: attribute " + std::string(name.substr(0, 40)) +
                                       " of " + std::to_string(size) + " bytes");
        place += size;
    }
}

struct Size {
    long long width, height;
    [[nodiscard]] double pixels() const
    {
        return static_cast<double>(width) * static_cast<double>(height);
    }
    [[nodiscard]] std::string text() const
    {
        return std::to_string(width) + "x" + std::to_string(height);
    }
};

Size size_of(const Imath::Box2i& window)
{
    return {static_cast<long long>(window.max.x) - window.min.x + 1,
            static_cast<long long>(window.max.y) - window.min.y + 1};
}

double bytes_per_pixel(const Imf::ChannelList& channels)
{
    double bytes = 0.0;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel)
        bytes += (channel.channel().type == Imf::HALF ? 2.0 : 4.0) /
                 (static_cast<double>(channel.channel().xSampling) * channel.channel().ySampling);
    return bytes;
}

/// The most bytes of pixels that one byte of a file can stand for. Deflate: 1032, and PXR24 has dropped
/// a quarter of each float before; run lengths and Huffman codes: less. DWA writes for 64 pixels of
/// equal value one coefficient and one end of block, both of two bytes, and deflates those.
double best_ratio(Imf::Compression method)
{
    return method == Imf::DWAA_COMPRESSION || method == Imf::DWAB_COMPRESSION ? 64.0 * 1032.0 : 1376.0;
}

/// Throws unless the file is long enough for the pixels and for the table of chunks, 8 bytes each, and
/// a tile is not far larger than the picture.
void check_pixels(const fs::path& path, const Imf::Header& header, bool tiled, double file_bytes)
{
    const Size size = size_of(header.dataWindow());
    const double raw = size.pixels() * bytes_per_pixel(header.channels());
    double chunks = header.hasChunkCount() ? header.chunkCount() : 0.0;
    if (tiled) {
        const double width = header.tileDescription().xSize;
        const double height = header.tileDescription().ySize;
        chunks = std::max(chunks, size.pixels() / (width * height));
        // OpenEXR allocates a tile, and a row of tiles.
        constexpr double always_allowed = 1 << 28;
        if (std::max(width, static_cast<double>(size.width)) * height *
                bytes_per_pixel(header.channels()) >
            always_allowed + 4.0 * raw)
            throw ImageError(path, "absurd tiles of " + std::to_string(header.tileDescription().xSize) +
                                       "x" + std::to_string(header.tileDescription().ySize) + " pixels");
    }
    if (raw > best_ratio(header.compression()) * file_bytes || 8.0 * chunks > file_bytes)
        throw ImageError(path,
                         "truncated or damaged: " + std::to_string(static_cast<long long>(file_bytes)) +
                             " bytes cannot hold " + size.text() + " pixels");
}

/// Throws if the pictures of this part would be far larger than its pixels: a small file can state a
/// display window of any size.
void check_display(const fs::path& path, const Imf::Header& header)
{
    constexpr double always_allowed = 1 << 24; // pixels of all pictures together
    double pictures = 1.0;                     // the mean, then its standard error and layers
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
        pictures += std::string_view(channel.name()).ends_with(".R") ? 1.0 : 0.0;
    const Size data = size_of(header.dataWindow());
    const Size display = size_of(header.displayWindow());
    check_size(path, display.width, display.height);
    if (pictures * display.pixels() > always_allowed + 4.0 * pictures * data.pixels())
        throw ImageError(path, "absurd display window of " + display.text() + " pixels around " +
                                   data.text() + " pixels");
}

} // namespace

bool is_flat(const Imf::Header& header)
{
    return !header.hasType() || !Imf::isDeepData(header.type());
}

std::vector<Imf::Header> read_headers(const fs::path& path, std::string_view bytes)
{
    MemoryInput stream(path.filename().string(), bytes);
    bool tiled = false;
    bool deep = false;
    bool parts = false;
    if (!Imf::isOpenExrFile(stream, tiled, deep, parts)) throw ImageError(path, "not an OpenEXR file");
    if (deep && !parts) throw ImageError(path, "holds deep data; only flat pictures can be read");
    const int count = count_headers(path, bytes, parts);
    if (count == 0) throw ImageError(path, "has an empty header");
    auto version = static_cast<int>(word_at(bytes, 4));
    stream.seekg(first_header);
    std::vector<Imf::Header> headers;
    for (int i = 0; i < count; ++i) {
        Imf::Header header;
        header.readFrom(stream, version);
        const Size size = size_of(header.dataWindow());
        check_size(path, size.width, size.height);
        check_display(path, header);
        const bool part_tiled = parts ? header.hasType() && Imf::isTiled(header.type()) : tiled;
        header.sanityCheck(part_tiled, parts);
        check_pixels(path, header, part_tiled, static_cast<double>(bytes.size()));
        headers.push_back(std::move(header));
    }
    if (std::none_of(headers.begin(), headers.end(), is_flat))
        throw ImageError(path, "holds deep data; only flat pictures can be read");
    return headers;
}

} // namespace images
