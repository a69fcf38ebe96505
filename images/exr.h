#pragma once

// OpenEXR pictures: 32-bit floats by name. One file holds mean, standard error, layers, metadata, and
// the state from which the render can be continued.
//
//   R G B                            mean
//   se.R se.G se.B                   standard error of the mean
//   NAME.R NAME.G NAME.B             a further picture, "s2t3" for example; some in 16-bit halves
//   state.mean.R.hi state.mean.R.lo  the film's mean and sum of squared deviations ("state.squares..."),
//                                    each double as two 32-bit words: lossless, as no float is
//   attribute plumbline.KEY          metadata, as a string
//   attribute plumblineBatches       batches in the film, as a string

#include "images/film.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace images {

/// Pictures of the same size by name. A name is not empty, is neither "se" nor begins with "state", and
/// has neither zero bytes nor more than 200 bytes.
using Layers = std::map<std::string, Image>;

/// Whether a file holds the state from which the render can be continued. Finished goldens do not.
enum class FilmState { keep, omit };

/// Writes the film as ZIP-compressed EXR (see the head of this file), values rounded to float but for
/// the state, and to 16 bits in `half_layers`. Throws ImageError, and std::invalid_argument for layers
/// that break the rules above.
void write_exr(const std::filesystem::path& path, const Film& film, const Metadata& metadata,
               const Layers& layers = {}, FilmState state = FilmState::keep,
               const Layers& half_layers = {});

struct ExrPicture {
    Image mean;
    std::string layer; // that `mean` is; empty: channels outside layers
    std::optional<Image> standard_error;
    Layers layers; // complete R, G, B triples; other channels (depth, alpha, ...) are ignored
    Metadata metadata;
    std::optional<Film> film; // the exact state
};

/// Reads one of our files or another renderer's: channels of half, float or whole numbers in any order,
/// any compression, scan lines or tiles (of several levels the finest), one part or several.
///
/// The picture is R, G and B outside layers; else the only layer with R, G and B; else Y, as grey
/// (exr_source.h). `layer`, if it is not empty, is the layer to take instead, or the part of that name;
/// standard error and state, which belong to our R, G and B, are left out then. Primaries other than
/// Rec.709 are converted (exr_primaries.h). The picture has the size of the display window: black where
/// the data window does not reach, without what lies outside. Values may be NaN (see first_non_finite).
///
/// Throws ImageError for other files: no such picture, subsampled channels, deep data, an incomplete
/// state, damage. No size that a file states makes it allocate more than its length can account for
/// (exr_header.h).
ExrPicture read_exr(const std::filesystem::path& path, const std::string& layer = "");

} // namespace images
