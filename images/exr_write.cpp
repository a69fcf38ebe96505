#include "images/atomic_file.h"
#include "images/exr.h"
#include "images/exr_checksum.h"
#include "images/exr_format.h"
#include "images/image_error.h"
#include "images/picture_size.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <half.h>

#include <deque>
#include <stdexcept>
#include <utility>
#include <vector>

namespace images {

namespace fs = std::filesystem;
using namespace exr_format;

namespace {

/// An EXR file in memory: it is written to the disk when it is complete.
class MemoryOutput : public Imf::OStream {
public:
    MemoryOutput() : OStream("memory") {}
    void write(const char data[], int size) override
    {
        const auto count = static_cast<std::size_t>(size);
        if (bytes_.size() < position_ + count) bytes_.resize(position_ + count);
        bytes_.replace(position_, count, data, count);
        position_ += count;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }
    [[nodiscard]] std::string take_bytes() { return std::move(bytes_); }

private:
    std::string bytes_;
    std::size_t position_ = 0;
};

/// The channels of a picture and the memory behind them.
class Channels {
public:
    Channels(int width, int height) : width_(width), height_(height), header_(width, height)
    {
        header_.compression() = Imf::ZIP_COMPRESSION;
    }
    [[nodiscard]] Imf::Header& header() { return header_; }

    void add_layer(const std::string& name, const Image& image)
    {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            auto& values = floats_.emplace_back();
            values.reserve(image.pixels.size());
            for (const Rgb& pixel : image.pixels)
                values.push_back(static_cast<float>(pixel[static_cast<int>(channel)]));
            add(channel_name(name, channel), Imf::FLOAT, values.data());
        }
    }

    void add_half_layer(const std::string& name, const Image& image)
    {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            auto& values = halves_.emplace_back();
            values.reserve(image.pixels.size());
            for (const Rgb& pixel : image.pixels)
                values.emplace_back(static_cast<float>(pixel[static_cast<int>(channel)]));
            add(channel_name(name, channel), Imf::HALF, values.data());
        }
    }

    void add_exact(const std::string& name, const Image& image)
    {
        for (std::size_t channel = 0; channel < 3; ++channel) {
            auto& hi = words_.emplace_back();
            auto& lo = words_.emplace_back();
            for (const Rgb& pixel : image.pixels) {
                const Words words = split(pixel[static_cast<int>(channel)]);
                hi.push_back(words.hi);
                lo.push_back(words.lo);
            }
            add(channel_name(name, channel) + ".hi", Imf::UINT, hi.data());
            add(channel_name(name, channel) + ".lo", Imf::UINT, lo.data());
        }
    }

    std::string encode()
    {
        MemoryOutput stream;
        {
            Imf::OutputFile file(stream, header_);
            file.setFrameBuffer(buffer_);
            file.writePixels(height_);
        }
        return stream.take_bytes();
    }

private:
    template <class Value>
    void add(const std::string& name, Imf::PixelType type, const Value* values)
    {
        header_.channels().insert(name, Imf::Channel(type));
        buffer_.insert(name, Imf::Slice::Make(type, values, header_.dataWindow(), sizeof(Value),
                                              sizeof(Value) * static_cast<std::size_t>(width_)));
    }

    int width_, height_;
    Imf::Header header_;
    Imf::FrameBuffer buffer_;
    std::deque<std::vector<float>> floats_; // a deque's elements stay where they are
    std::deque<std::vector<half>> halves_;
    std::deque<std::vector<std::uint32_t>> words_;
};

void check_layer(const std::string& name, const Image& layer, const Image& mean)
{
    constexpr std::size_t longest = 200; // the format allows 255, of which a suffix takes some
    if (name.empty() || name == standard_error_layer || name.starts_with("state") ||
        name.find('\0') != std::string::npos || name.size() > longest)
        throw std::invalid_argument("a layer of an EXR file cannot be called '" + name + "'");
    if (layer.width != mean.width || layer.height != mean.height)
        throw std::invalid_argument("layer " + name + " differs in size from the picture");
}

/// All that is needed to go on from the film.
void add_state(Channels& channels, const Film& film, const StrategySums& strategies)
{
    for (std::size_t i = 0; i < film.blocks().size(); ++i) {
        channels.add_exact(state_name(i, "mean"), film.blocks()[i].mean);
        channels.add_exact(state_name(i, "squares"), film.blocks()[i].squares);
    }
    for (std::size_t i = 0; i < strategies.blocks().size(); ++i)
        for (const auto& [strategy, sum] : strategies.blocks()[i].sums)
            channels.add_exact(state_name(i, layer_name(strategy.first, strategy.second)), sum);
}

void add_metadata(const fs::path& path, Imf::Header& header, const Metadata& metadata)
{
    constexpr std::size_t longest = 200;
    for (const auto& [key, value] : metadata) {
        if (key.find('\0') != std::string::npos || key.size() > longest)
            throw ImageError(path, "a metadata key cannot be called '" + key + "'");
        header.insert(std::string(metadata_prefix) + key, Imf::StringAttribute(value));
    }
}

} // namespace

void write_exr(const fs::path& path, const Film& film, const Metadata& metadata, const Layers& layers,
               FilmState state, const Layers& half_layers, const StrategySums& strategies)
{
    const BatchMoments moments = film.moments();
    const Image& mean = moments.mean;
    check_size(path, mean);
    for (const auto& [name, layer] : layers) check_layer(name, layer, mean);
    for (const auto& [name, layer] : half_layers) {
        check_layer(name, layer, mean);
        if (layers.contains(name)) throw std::invalid_argument("two layers are called '" + name + "'");
    }
    if (strategies.range().size() > 0 && strategies.range() != film.range())
        throw std::invalid_argument("the strategies are not of the film's batches");
    std::string bytes;
    try {
        Channels channels(mean.width, mean.height);
        channels.add_layer("", mean);
        channels.add_layer(standard_error_layer, standard_error(moments, film.batches()));
        for (const auto& [name, layer] : layers) channels.add_layer(name, layer);
        for (const auto& [name, layer] : half_layers) channels.add_half_layer(name, layer);
        if (state == FilmState::keep) {
            add_state(channels, film, strategies);
            channels.header().insert(range_attribute, Imf::StringAttribute(describe(film.range())));
            channels.header().insert(checksum_attribute, Imf::StringAttribute(blank_checksum()));
        }
        channels.header().insert(batches_attribute,
                                 Imf::StringAttribute(std::to_string(film.batches())));
        add_metadata(path, channels.header(), metadata);
        bytes = channels.encode();
        if (state == FilmState::keep) add_checksum(bytes);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const ImageError&) {
        throw;
    } catch (const std::exception& error) { // Iex's, of many types
        throw ImageError(path, error.what());
    }
    write_atomically(path, bytes);
}

} // namespace images
