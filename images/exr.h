#pragma once

// OpenEXR pictures: 32-bit floats by name. One file holds mean, standard error, layers, metadata, and
// the state from which the render can be continued.
//
//   R G B                            mean
//   se.R se.G se.B                   standard error of the mean
//   NAME.R NAME.G NAME.B             a further picture, "s2t3" for example; some in 16-bit halves
//   state.000.mean.R.hi (and .lo)    of each block of the film (film.h) the mean, the sum of squared
//                                    deviations ("state.000.squares...") and the sums of strategies
//                                    ("state.000.s2t3..."), each double as two 32-bit words: lossless,
//                                    as no float is
//   attribute plumbline.KEY          metadata, as a string
//   attribute plumblineBatches       the number of batches in the film
//   attribute plumblineBatchRange    beside a state: their numbers, "4..8" (8 is not among them)
//   attribute plumblineChecksum      beside a state: a hash of the file's bytes, with zeros in its place

#include "images/film.h"
#include "images/strategies.h"

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
/// the state, and to 16 bits in `half_layers`. `strategies`, of the film's batches, becomes a part of
/// the state. Throws ImageError, and std::invalid_argument for layers that break the rules above.
void write_exr(const std::filesystem::path& path, const Film& film, const Metadata& metadata,
               const Layers& layers = {}, FilmState state = FilmState::keep,
               const Layers& half_layers = {}, const StrategySums& strategies = StrategySums());

struct ExrPicture {
    Image mean;
    std::string layer; // that `mean` is; empty: channels outside layers
    std::optional<Image> standard_error;
    Layers layers; // complete R, G, B triples; other channels (depth, alpha, ...) are ignored
    Metadata metadata;
    std::optional<Film> film;               // the exact state
    std::optional<StrategySums> strategies; // a part of the state, if there are any
    bool has_state = false;                 // whether the file has one, be it of no use
    std::string no_state; // why there is no `film`: "holds no state to go on from", for example
};

/// Throws ImageError if the picture has a state that is of no use: damaged, or of an earlier version.
void expect_sound_state(const std::filesystem::path& path, const ExrPicture& picture);

/// Reads one of our files or another renderer's: channels of half, float or whole numbers in any order,
/// any compression, scan lines or tiles (of several levels the finest), one part or several.
///
/// The picture is R, G and B outside layers; else the only layer with R, G and B; else Y, as grey
/// (exr_source.h). `layer`, if it is not empty, is the layer to take instead, or the part of that name;
/// standard error and state, which belong to our R, G and B, are left out then. Primaries other than
/// Rec.709 are converted (exr_primaries.h). The picture has the size of the display window: black where
/// the data window does not reach, without what lies outside. Values may be NaN (see first_non_finite).
///
/// A state is left out if the checksum shows that the file was damaged or changed. Throws ImageError for
/// other files: no such picture, subsampled channels, deep data, an incomplete state, damage. No size
/// that a file states makes it allocate more than its length can account for (exr_header.h).
ExrPicture read_exr(const std::filesystem::path& path, const std::string& layer = "");

/// What a file of ours says of itself.
struct ExrSummary {
    int width = 0, height = 0;
    Metadata metadata;
    std::optional<BatchRange> range; // of the batches in its state
    std::string no_state;            // why there is no `range`
};

/// The same as read_exr, without the pictures: the bytes are read, but not unpacked. Throws ImageError.
ExrSummary read_exr_summary(const std::filesystem::path& path);

} // namespace images
