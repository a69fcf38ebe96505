#include "images/atomic_file.h"
#include "images/exr.h"
#include "images/exr_format.h"
#include "images/exr_header.h"
#include "images/exr_primaries.h"
#include "images/exr_source.h"
#include "images/exr_stream.h"
#include "images/image_error.h"
#include "images/whole_number.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace images {

namespace fs = std::filesystem;
using namespace exr_format;

namespace {

/// The channels of one part, with the errors that name the file.
class Reader {
public:
    Reader(const fs::path& path, std::string_view bytes, int part)
        : path_(path), stream_(path.filename().string(), bytes), file_(stream_), part_(file_, part),
          window_(part_.header().dataWindow()), display_(part_.header().displayWindow()),
          to_rec709_(to_rec709(path, part_.header()))
    {
        if (!window_.intersects(display_))
            throw ImageError(path, "has no pixel in its display window: its data window is " +
                                       text_of(window_) + ", its display window " + text_of(display_));
    }

    [[nodiscard]] const Imf::Header& header() const { return part_.header(); }
    [[nodiscard]] const Imf::ChannelList& channels() const { return header().channels(); }
    [[nodiscard]] bool has_other_primaries() const { return to_rec709_.has_value(); }

    /// R, G and B in this layer, or outside layers if its name is empty.
    Image colours(const std::string& layer)
    {
        std::array<std::vector<float>, 3> planes;
        Imf::FrameBuffer buffer;
        for (std::size_t channel = 0; channel < 3; ++channel)
            add(buffer, channel_name(layer, channel), Imf::FLOAT, planes[channel]);
        read(buffer);
        Image image =
            displayed([&](std::size_t i) { return Rgb(planes[0][i], planes[1][i], planes[2][i]); });
        if (to_rec709_)
            for (Rgb& pixel : image.pixels) pixel = *to_rec709_ * pixel;
        return image;
    }

    /// Y for all three. It has no primaries.
    Image grey(const std::string& layer)
    {
        std::vector<float> plane;
        Imf::FrameBuffer buffer;
        add(buffer, layer.empty() ? "Y" : layer + ".Y", Imf::FLOAT, plane);
        read(buffer);
        return displayed([&](std::size_t i) { return Rgb(static_cast<double>(plane[i])); });
    }

    Image exact(const std::string& name)
    {
        std::array<std::vector<double>, 3> planes;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            std::vector<std::uint32_t> hi;
            std::vector<std::uint32_t> lo;
            Imf::FrameBuffer buffer;
            add(buffer, channel_name(name, channel) + ".hi", Imf::UINT, hi);
            add(buffer, channel_name(name, channel) + ".lo", Imf::UINT, lo);
            read(buffer);
            for (std::size_t i = 0; i < hi.size(); ++i) planes[channel].push_back(join({hi[i], lo[i]}));
        }
        return displayed([&](std::size_t i) { return Rgb(planes[0][i], planes[1][i], planes[2][i]); });
    }

private:
    /// "(0, 0) to (63, 63)"
    static std::string text_of(const Imath::Box2i& box)
    {
        return "(" + std::to_string(box.min.x) + ", " + std::to_string(box.min.y) + ") to (" +
               std::to_string(box.max.x) + ", " + std::to_string(box.max.y) + ")";
    }

    [[nodiscard]] std::size_t columns() const
    {
        return static_cast<std::size_t>(window_.max.x - window_.min.x + 1);
    }

    /// The display window, black where there are no data. value(i): the i-th pixel of the data window.
    template <class Value>
    [[nodiscard]] Image displayed(const Value& value) const
    {
        Image image(display_.max.x - display_.min.x + 1, display_.max.y - display_.min.y + 1);
        const Imath::V2i first(std::max(window_.min.x, display_.min.x),
                               std::max(window_.min.y, display_.min.y));
        const Imath::V2i last(std::min(window_.max.x, display_.max.x),
                              std::min(window_.max.y, display_.max.y));
        for (int y = first.y; y <= last.y; ++y) {
            const std::size_t row = static_cast<std::size_t>(y - window_.min.y) * columns();
            for (int x = first.x; x <= last.x; ++x)
                image.at(x - display_.min.x, y - display_.min.y) =
                    value(row + static_cast<std::size_t>(x - window_.min.x));
        }
        return image;
    }

    template <class Value>
    void add(Imf::FrameBuffer& buffer, const std::string& name, Imf::PixelType type,
             std::vector<Value>& values)
    {
        const Imf::Channel* const channel = channels().findChannel(name);
        if (channel == nullptr) throw ImageError(path_, "has no channel " + name);
        if (channel->xSampling != 1 || channel->ySampling != 1)
            throw ImageError(path_, "channel " + name + " is subsampled");
        if (type == Imf::UINT && channel->type != Imf::UINT)
            throw ImageError(path_, "channel " + name + " is not of type UINT");
        values.resize(columns() * static_cast<std::size_t>(window_.max.y - window_.min.y + 1));
        buffer.insert(name, Imf::Slice::Make(type, values.data(), window_, sizeof(Value),
                                             sizeof(Value) * columns()));
    }

    void read(const Imf::FrameBuffer& buffer)
    {
        part_.setFrameBuffer(buffer);
        part_.readPixels(window_.min.y, window_.max.y);
    }

    const fs::path& path_;
    MemoryInput stream_;
    Imf::MultiPartInputFile file_;
    Imf::InputPart part_;
    Imath::Box2i window_, display_;
    std::optional<glm::dmat3> to_rec709_;
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
        const PictureSource source = find_picture(path, read_headers(path, bytes), layer);
        Reader reader(path, bytes, source.part);
        ExrPicture picture;
        picture.layer = source.layer;
        picture.mean = source.grey ? reader.grey(source.layer) : reader.colours(source.layer);
        picture.metadata = read_metadata(reader.header());
        for (const std::string& name : colour_layers(reader.channels()))
            picture.layers[name] = reader.colours(name);
        // Both belong to our own R, G and B, which are those of Rec.709.
        if (!layer.empty() || !source.layer.empty() || source.grey || reader.has_other_primaries())
            return picture;
        if (has_colours(reader.channels(), standard_error_layer))
            picture.standard_error = reader.colours(standard_error_layer);
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
