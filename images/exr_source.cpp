#include "images/exr_source.h"

#include "images/exr_format.h"
#include "images/exr_header.h"
#include "images/image_error.h"

#include <algorithm>
#include <optional>
#include <string_view>

namespace images {

namespace fs = std::filesystem;
using namespace exr_format;

namespace {

bool has(const Imf::ChannelList& channels, const std::string& name)
{
    return channels.findChannel(name) != nullptr;
}

std::string in_layer(const std::string& layer, const char* channel)
{
    return layer.empty() ? channel : layer + "." + channel;
}

/// Whether there is luminance in this layer, or outside layers, and no chroma.
bool has_grey(const Imf::ChannelList& channels, const std::string& layer)
{
    return has(channels, in_layer(layer, "Y")) && !has(channels, in_layer(layer, "RY")) &&
           !has(channels, in_layer(layer, "BY"));
}

/// The layers with a channel of this name, in the order of the file.
std::vector<std::string> layers_with(const Imf::ChannelList& channels, std::string_view channel_name)
{
    std::vector<std::string> names;
    const std::string ending = "." + std::string(channel_name);
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        const std::string_view name = channel.name();
        if (name.ends_with(ending) && name.size() > ending.size())
            names.emplace_back(name.substr(0, name.size() - ending.size()));
    }
    return names;
}

/// "A, B, C"; of many the first ones and the last.
std::string list_of(const std::vector<std::string>& names)
{
    constexpr std::size_t most = 8;
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i >= most - 1 && i + 1 < names.size()) {
            if (i == most - 1) list += ", ...";
            continue;
        }
        list += (i == 0 ? "" : ", ") + names[i];
    }
    return list;
}

/// The flat parts of a file, with the search for pictures in them.
class Parts {
public:
    explicit Parts(const std::vector<Imf::Header>& headers)
    {
        for (std::size_t i = 0; i < headers.size(); ++i)
            if (is_flat(headers[i])) parts_.push_back({static_cast<int>(i), &headers[i]});
    }

    /// The first part that has this layer, in colour or, if `grey`, as luminance.
    [[nodiscard]] std::optional<PictureSource> find(const std::string& layer, bool grey) const
    {
        for (const Part& part : parts_)
            if (grey ? has_grey(channels(part), layer) : has_colours(channels(part), layer))
                return PictureSource{part.index, layer, grey};
        return std::nullopt;
    }
    [[nodiscard]] std::optional<PictureSource> find_part(const std::string& name) const
    {
        for (const Part& part : parts_)
            if (part.header->hasName() && part.header->name() == name)
                for (const bool grey : {false, true})
                    if (grey ? has_grey(channels(part), "") : has_colours(channels(part), ""))
                        return PictureSource{part.index, "", grey};
        return std::nullopt;
    }
    /// The names of all layers in colour or of luminance, each once.
    [[nodiscard]] std::vector<std::string> layers(bool grey) const
    {
        std::vector<std::string> names;
        for (const Part& part : parts_)
            for (const std::string& name :
                 grey ? layers_with(channels(part), "Y") : colour_layers(channels(part)))
                if (std::find(names.begin(), names.end(), name) == names.end() &&
                    (!grey || has_grey(channels(part), name)))
                    names.push_back(name);
        return names;
    }
    /// What can be asked for by name.
    [[nodiscard]] std::vector<std::string> choices() const
    {
        std::vector<std::string> names;
        for (const Part& part : parts_)
            if (part.header->hasName() && has_colours(channels(part), ""))
                names.push_back(part.header->name());
        for (const bool grey : {false, true})
            for (const std::string& name : layers(grey)) names.push_back(name);
        return names;
    }
    [[nodiscard]] bool has_chroma() const
    {
        return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
            return has(channels(part), "Y") && has(channels(part), "RY") && has(channels(part), "BY");
        });
    }
    /// "has the channels A, Z; wanted: R, G, B, or Y"
    [[nodiscard]] std::string no_picture(const std::string& layer) const
    {
        std::vector<std::string> names;
        for (const Part& part : parts_)
            for (auto channel = channels(part).begin(); channel != channels(part).end(); ++channel)
                names.emplace_back(channel.name());
        std::string wanted;
        for (const char* channel : {"R", "G", "B"}) wanted += in_layer(layer, channel) + ", ";
        return (names.size() == 1 ? "has the channel " : "has the channels ") + list_of(names) +
               "; wanted: " + wanted + "or " + in_layer(layer, "Y");
    }

private:
    struct Part {
        int index;
        const Imf::Header* header;
    };
    static const Imf::ChannelList& channels(const Part& part) { return part.header->channels(); }
    std::vector<Part> parts_;
};

} // namespace

bool has_colours(const Imf::ChannelList& channels, const std::string& layer)
{
    return has(channels, in_layer(layer, "R")) && has(channels, in_layer(layer, "G")) &&
           has(channels, in_layer(layer, "B"));
}

std::vector<std::string> colour_layers(const Imf::ChannelList& channels)
{
    std::vector<std::string> names = layers_with(channels, "R");
    std::erase_if(names, [&](const std::string& name) {
        return name == standard_error_layer || !has_colours(channels, name);
    });
    return names;
}

PictureSource find_picture(const fs::path& path, const std::vector<Imf::Header>& headers,
                           const std::string& layer)
{
    const Parts parts(headers);
    if (!layer.empty()) {
        if (const auto colours = parts.find(layer, false)) return *colours;
        if (const auto luminance = parts.find(layer, true)) return *luminance;
        if (const auto part = parts.find_part(layer)) return *part;
        const std::vector<std::string> names = parts.choices();
        throw ImageError(path, names.empty()
                                   ? parts.no_picture(layer)
                                   : "has no layer " + layer +
                                         " of R, G and B; choose one of its layers: " + list_of(names));
    }
    for (const bool grey : {false, true}) {
        if (const auto outside = parts.find("", grey)) return *outside;
        const std::vector<std::string> names = parts.layers(grey);
        if (names.size() == 1) return *parts.find(names.front(), grey);
        if (names.size() > 1)
            throw ImageError(path, std::string("has no ") + (grey ? "Y" : "R, G and B") +
                                       " outside layers; choose one of its layers: " + list_of(names));
    }
    if (parts.has_chroma())
        throw ImageError(
            path,
            "has luminance and chroma (Y, RY, BY), which hold colours coarsely; wanted: R, G, B, or Y");
    throw ImageError(path, parts.no_picture(""));
}

} // namespace images
