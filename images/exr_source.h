#pragma once

// Which channels of an EXR file are its picture.

#include <ImfChannelList.h>
#include <ImfHeader.h>

#include <filesystem>
#include <string>
#include <vector>

namespace images {

struct PictureSource {
    int part = 0;
    std::string layer; // of that part; empty: channels outside layers
    bool grey = false; // Y instead of R, G and B
};

/// R, G and B of the first part that has them outside layers; else of the only layer that has them;
/// else Y in the same order. If `layer` is not empty: those of the first layer of this name, or outside
/// layers of the part of this name. Parts with deep data are passed over. Throws ImageError, with the
/// names of layers or channels, if there is no such picture, or if it has subsampled chroma (Y, RY, BY).
PictureSource find_picture(const std::filesystem::path& path, const std::vector<Imf::Header>& headers,
                           const std::string& layer);

/// The names of the layers that have R, G and B, other than the standard error.
std::vector<std::string> colour_layers(const Imf::ChannelList& channels);

/// Whether there are R, G and B in this layer, or outside layers if its name is empty.
bool has_colours(const Imf::ChannelList& channels, const std::string& layer);

} // namespace images
