#include "images/atomic_file.h"
#include "images/exr.h"
#include "images/exr_format.h"
#include "images/image_error.h"
#include "images/picture_size.h"
#include "images/whole_number.h"

#include <Iex.h>
#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <ImfTestFile.h>

#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

namespace images {

namespace fs = std::filesystem;
using namespace exr_format;

namespace {

class MemoryInput : public Imf::IStream {
public:
    MemoryInput(const std::string& name, std::string_view bytes) : IStream(name.c_str()), bytes_(bytes)
    {}
    bool read(char data[], int size) override
    {
        const auto count = static_cast<std::size_t>(size);
        if (position_ > bytes_.size() || bytes_.size() - position_ < count)
            throw Iex::InputExc("unexpected end of file");
        std::memcpy(data, bytes_.data() + position_, count);
        position_ += count;
        return position_ < bytes_.size();
    }
    std::uint64_t tellg() override { return position_; }
    void seekg(std::uint64_t position) override { position_ = position; }

private:
    std::string_view bytes_;
    std::size_t position_ = 0;
};

/// The file's channels, with the errors that name it.
class Reader {
public:
    Reader(const fs::path& path, std::string_view bytes)
        : path_(path), stream_(flat_picture(path, bytes)), file_(stream_),
          window_(file_.header().dataWindow())
    {
        const long long width = static_cast<long long>(window_.max.x) - window_.min.x + 1;
        const long long height = static_cast<long long>(window_.max.y) - window_.min.y + 1;
        check_size(path, width, height);
        width_ = static_cast<int>(width);
        height_ = static_cast<int>(height);
        check_bytes(bytes.size());
    }

    [[nodiscard]] const Imf::Header& header() const { return file_.header(); }
    [[nodiscard]] const Imf::ChannelList& channels() const { return header().channels(); }
    [[nodiscard]] bool has(const std::string& channel) const { return channels().findChannel(channel); }
    /// An empty name is that of R, G and B.
    [[nodiscard]] bool has_layer(const std::string& layer) const
    {
        return has(channel_name(layer, 0)) && has(channel_name(layer, 1)) && has(channel_name(layer, 2));
    }

    Image layer(const std::string& name)
    {
        std::array<std::vector<float>, 3> planes;
        Imf::FrameBuffer buffer;
        for (std::size_t channel = 0; channel < 3; ++channel)
            add(buffer, channel_name(name, channel), Imf::FLOAT, planes[channel]);
        read(buffer);
        Image image(width_, height_);
        for (std::size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i] = Rgb(planes[0][i], planes[1][i], planes[2][i]);
        return image;
    }

    Image exact(const std::string& name)
    {
        Image image(width_, height_);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::vector<std::uint32_t> hi;
            std::vector<std::uint32_t> lo;
            Imf::FrameBuffer buffer;
            add(buffer, channel_name(name, channel) + ".hi", Imf::UINT, hi);
            add(buffer, channel_name(name, channel) + ".lo", Imf::UINT, lo);
            read(buffer);
            for (std::size_t i = 0; i < image.pixels.size(); ++i)
                image.pixels[i][static_cast<int>(channel)] = join({hi[i], lo[i]});
        }
        return image;
    }

private:
    /// The file as a stream, if it is a flat picture in one part.
    static MemoryInput flat_picture(const fs::path& path, std::string_view bytes)
    {
        MemoryInput stream(path.filename().string(), bytes);
        bool tiled = false;
        bool deep = false;
        bool parts = false;
        if (!Imf::isOpenExrFile(stream, tiled, deep, parts))
            throw ImageError(path, "not an OpenEXR file");
        if (deep) throw ImageError(path, "holds deep data; only flat pictures can be read");
        if (parts) throw ImageError(path, "holds several parts; only single-part files can be read");
        return {path.filename().string(), bytes};
    }

    /// Throws unless the file is long enough to hold its pixels. Called before memory is allocated.
    void check_bytes(std::size_t bytes) const
    {
        // Deflate compresses by at most 1032 to 1, the other methods by less; DWA applies two of them.
        constexpr double best_ratio = 1032.0;
        const Imf::Compression method = header().compression();
        if (method == Imf::DWAA_COMPRESSION || method == Imf::DWAB_COMPRESSION) return;
        double raw = 0.0;
        for (auto channel = channels().begin(); channel != channels().end(); ++channel)
            raw += (channel.channel().type == Imf::HALF ? 2.0 : 4.0) * width_ * height_ /
                   (static_cast<double>(channel.channel().xSampling) * channel.channel().ySampling);
        if (raw > best_ratio * static_cast<double>(bytes))
            throw ImageError(path_, "truncated or damaged: " + std::to_string(bytes) +
                                        " bytes cannot hold " + std::to_string(width_) + "x" +
                                        std::to_string(height_) + " pixels");
    }

    template <class Value>
    void add(Imf::FrameBuffer& buffer, const std::string& name, Imf::PixelType type,
             std::vector<Value>& values)
    {
        const Imf::Channel* const channel = channels().findChannel(name);
        if (channel == nullptr) throw ImageError(path_, "has no channel " + name + list_of_channels());
        if (channel->xSampling != 1 || channel->ySampling != 1)
            throw ImageError(path_, "channel " + name + " is subsampled");
        if (type == Imf::UINT && channel->type != Imf::UINT)
            throw ImageError(path_, "channel " + name + " is not of type UINT");
        values.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
        buffer.insert(name, Imf::Slice::Make(type, values.data(), window_, sizeof(Value),
                                             sizeof(Value) * static_cast<std::size_t>(width_)));
    }

    [[nodiscard]] std::string list_of_channels() const
    {
        std::string list;
        for (auto channel = channels().begin(); channel != channels().end() && list.size() < 100;
             ++channel)
            list += (list.empty() ? "; it has " : ", ") + std::string(channel.name());
        return list;
    }

    void read(const Imf::FrameBuffer& buffer)
    {
        file_.setFrameBuffer(buffer);
        file_.readPixels(window_.min.y, window_.max.y);
    }

    const fs::path& path_;
    MemoryInput stream_;
    Imf::InputFile file_;
    Imath::Box2i window_;
    int width_ = 0, height_ = 0;
};

const Imf::StringAttribute* string_attribute(const Imf::Header& header, const char* name)
{
    return header.findTypedAttribute<Imf::StringAttribute>(name);
}

Metadata read_metadata(const Imf::Header& header)
{
    Metadata metadata;
    for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
        const std::string_view name = attribute.name();
        const auto* const text = string_attribute(header, attribute.name());
        if (name.starts_with(metadata_prefix) && text != nullptr)
            metadata[std::string(name.substr(metadata_prefix.size()))] = text->value();
    }
    return metadata;
}

/// The names of the complete layers other than the picture, its standard error and its state.
std::vector<std::string> layer_names(const Reader& reader)
{
    std::vector<std::string> names;
    for (auto channel = reader.channels().begin(); channel != reader.channels().end(); ++channel) {
        const std::string_view name = channel.name();
        if (!name.ends_with(".R")) continue;
        const std::string layer(name.substr(0, name.size() - 2));
        if (layer != standard_error_layer && reader.has_layer(layer)) names.push_back(layer);
    }
    return names;
}

/// Throws, with the names of the layers, if the file has not the one of that name. For a file without
/// layers the message names its channels.
void expect_picture(const fs::path& path, const Reader& reader, const std::string& layer,
                    const std::vector<std::string>& names)
{
    if (reader.has_layer(layer) || (layer.empty() && names.empty())) return;
    std::string list;
    constexpr std::size_t most = 8;
    for (std::size_t i = 0; i < std::min(most, names.size()); ++i)
        list += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > most) list += ", ...";
    throw ImageError(path, (layer.empty() ? "has no R, G and B outside layers"
                                          : "has no layer " + layer + " of R, G and B") +
                               (names.empty() ? "" : "; choose one of its layers: " + list));
}

std::optional<Film> read_state(const fs::path& path, Reader& reader)
{
    if (reader.channels().findChannel(channel_name(mean_state, 0) + ".hi") == nullptr)
        return std::nullopt;
    const auto* const text = string_attribute(reader.header(), batches_attribute);
    if (text == nullptr) throw ImageError(path, "has a film state but no number of batches");
    const auto batches = whole_number(text->value());
    if (!batches) throw ImageError(path, "'" + text->value() + "' is no number of batches");
    Image mean = reader.exact(mean_state);
    return Film(std::move(mean), reader.exact(squares_state), *batches);
}

} // namespace

ExrPicture read_exr(const fs::path& path, const std::string& layer)
{
    const std::string bytes = read_file(path);
    try {
        Reader reader(path, bytes);
        ExrPicture picture;
        const std::vector<std::string> names = layer_names(reader);
        expect_picture(path, reader, layer, names);
        picture.mean = reader.layer(layer);
        picture.metadata = read_metadata(reader.header());
        for (const std::string& name : names) picture.layers[name] = reader.layer(name);
        if (!layer.empty()) return picture;
        if (reader.has_layer(standard_error_layer))
            picture.standard_error = reader.layer(standard_error_layer);
        picture.film = read_state(path, reader);
        return picture;
    } catch (const std::bad_alloc&) {
        throw ImageError(path, "asks for more memory than there is");
    } catch (const ImageError&) {
        throw;
    } catch (const std::exception& error) { // Iex's, of many types
        throw ImageError(path, error.what());
    }
}

} // namespace images
