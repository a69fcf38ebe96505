#include "images/atomic_file.h"
#include "images/exr.h"
#include "images/exr_checksum.h"
#include "images/exr_format.h"
#include "images/exr_header.h"
#include "images/exr_primaries.h"
#include "images/exr_source.h"
#include "images/exr_stream.h"
#include "images/image_error.h"

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

/// The strategies of which block number `block` holds sums, in ascending order.
std::vector<std::pair<int, int>> strategies_of(const Imf::ChannelList& channels, std::size_t block)
{
    const std::string begin = state_name(block, "");
    const std::string_view end = ".R.hi";
    std::vector<std::pair<int, int>> found;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        std::string_view name = channel.name();
        if (!name.starts_with(begin) || !name.ends_with(end)) continue;
        name.remove_prefix(begin.size());
        name.remove_suffix(end.size());
        if (const auto strategy = parse_layer_name(name)) found.push_back(*strategy);
    }
    return found;
}

constexpr const char* without_state = "holds no state to go on from";

/// The range of the batches in the state, or why there is none.
struct StateRange {
    std::optional<BatchRange> range;
    bool has_state = false;
    std::string no_state;
};

StateRange range_of_state(const fs::path& path, std::string_view bytes, const Imf::Header& header)
{
    const auto* const text = string_attribute(header, range_attribute);
    if (text == nullptr && header.channels().findChannel("state.mean.R.hi") != nullptr)
        return {{}, true, "holds the state of an earlier version of this program, which is of no use"};
    if (text == nullptr) return {{}, false, without_state};
    if (!has_right_checksum(bytes))
        return {{}, true, "is damaged, cut short or changed: its checksum is not that of its bytes"};
    const auto range = parse_range(text->value());
    if (!range) throw ImageError(path, "'" + text->value() + "' is no range of batches");
    return {range, true, ""};
}

/// Sets film and strategies, or no_state.
void read_state(const fs::path& path, std::string_view bytes, Reader& reader, ExrPicture& picture)
{
    const StateRange state = range_of_state(path, bytes, reader.header());
    picture.has_state = state.has_state;
    picture.no_state = state.no_state;
    const std::optional<BatchRange>& range = state.range;
    if (!range) return;
    std::vector<BatchMoments> blocks;
    std::vector<StrategyBlock> sums;
    const std::size_t count = largest_blocks(*range).size();
    for (std::size_t i = 0; i < count; ++i) {
        blocks.push_back({reader.exact(state_name(i, "mean")), reader.exact(state_name(i, "squares"))});
        StrategyBlock& block = sums.emplace_back();
        for (const auto& strategy : strategies_of(reader.channels(), i))
            block.sums.emplace(strategy,
                               reader.exact(state_name(i, layer_name(strategy.first, strategy.second))));
    }
    picture.film.emplace(picture.mean.width, picture.mean.height, *range, std::move(blocks));
    if (std::ranges::any_of(sums, [](const StrategyBlock& block) { return !block.sums.empty(); }))
        picture.strategies.emplace(*range, std::move(sums));
}

/// What read() returns. Its exceptions become ImageErrors.
template <class Read>
auto with_name_in_errors(const fs::path& path, const Read& read)
{
    try {
        return read();
    } catch (const std::bad_alloc&) {
        throw ImageError(path, "asks for more memory than there is");
    } catch (const ImageError&) {
        throw;
    } catch (const std::exception& error) { // Iex's, of many types
        throw ImageError(path, error.what());
    }
}

} // namespace

void expect_sound_state(const fs::path& path, const ExrPicture& picture)
{
    if (picture.has_state && !picture.film) throw ImageError(path, picture.no_state);
}

ExrPicture read_exr(const fs::path& path, const std::string& layer)
{
    const std::string bytes = read_file(path);
    return with_name_in_errors(path, [&] {
        const PictureSource source = find_picture(path, read_headers(path, bytes), layer);
        Reader reader(path, bytes, source.part);
        ExrPicture picture;
        picture.no_state = without_state;
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
        read_state(path, bytes, reader, picture);
        return picture;
    });
}

ExrSummary read_exr_summary(const fs::path& path)
{
    const std::string bytes = read_file(path);
    return with_name_in_errors(path, [&] {
        const Imf::Header header = read_headers(path, bytes).front();
        const Imath::Box2i& window = header.displayWindow();
        StateRange state = range_of_state(path, bytes, header);
        return ExrSummary{window.max.x - window.min.x + 1, window.max.y - window.min.y + 1,
                          read_metadata(header), state.range, std::move(state.no_state)};
    });
}

} // namespace images
