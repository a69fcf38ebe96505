#pragma once

// Writes files as other programs do: by OpenEXR itself, without any of our code.

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfTiledOutputFile.h>
#include <half.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace images_test {

/// By name: the values of the data window, row by row from the top.
using ForeignChannels = std::map<std::string, std::vector<float>>;

inline Imath::Box2i box(int left, int top, int right, int bottom)
{
    return {Imath::V2i(left, top), Imath::V2i(right, bottom)};
}

/// Channels as they lie in memory for OpenEXR, as `type`.
class ForeignPixels {
public:
    ForeignPixels(Imf::Header& header, const ForeignChannels& channels, Imf::PixelType type)
    {
        const Imath::Box2i window = header.dataWindow();
        const std::size_t size = type == Imf::HALF ? 2 : 4;
        for (const auto& [name, values] : channels) {
            header.channels().insert(name, Imf::Channel(type));
            std::vector<char>& bytes = bytes_[name];
            bytes.resize(values.size() * size);
            for (std::size_t i = 0; i < values.size(); ++i) {
                if (type == Imf::HALF) put(bytes, i, half(values[i]));
                if (type == Imf::FLOAT) put(bytes, i, values[i]);
                if (type == Imf::UINT) put(bytes, i, static_cast<std::uint32_t>(values[i]));
            }
            const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
            buffer.insert(name, Imf::Slice::Make(type, bytes.data(), window, size, size * width));
        }
    }
    Imf::FrameBuffer buffer;

private:
    template <class Value>
    static void put(std::vector<char>& bytes, std::size_t index, Value value)
    {
        std::memcpy(bytes.data() + index * sizeof(Value), &value, sizeof(Value));
    }
    std::map<std::string, std::vector<char>> bytes_;
};

inline void write_foreign(const std::filesystem::path& path, Imf::Header header,
                          const ForeignChannels& channels, Imf::PixelType type = Imf::FLOAT)
{
    const ForeignPixels pixels(header, channels, type);
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(pixels.buffer);
    file.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
}

/// A file of several parts, each a header, with its name, and its channels.
inline void write_foreign_parts(const std::filesystem::path& path, std::vector<Imf::Header> headers,
                                const std::vector<ForeignChannels>& channels)
{
    std::vector<ForeignPixels> pixels;
    pixels.reserve(headers.size());
    for (std::size_t i = 0; i < headers.size(); ++i) {
        headers[i].setType(Imf::SCANLINEIMAGE);
        pixels.emplace_back(headers[i], channels[i], Imf::FLOAT);
    }
    Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
    for (std::size_t i = 0; i < headers.size(); ++i) {
        Imf::OutputPart part(file, static_cast<int>(i));
        part.setFrameBuffer(pixels[i].buffer);
        part.writePixels(headers[i].dataWindow().max.y - headers[i].dataWindow().min.y + 1);
    }
}

} // namespace images_test
