#pragma once

// Continues an earlier render.

#include "cli/render_command.h"
#include "images/dropped.h"
#include "images/film.h"

namespace cli {

/// The film to start from: that of the file to resume, or an empty one. Throws std::invalid_argument or
/// images::ImageError if the file holds another picture. `dropped` is set to the number of contributions
/// that were left out of the film.
images::Film starting_film(const RenderCommand& options, const images::Metadata& description,
                           images::Dropped& dropped);

} // namespace cli
