#pragma once

#include "images/image.h"

#include <optional>
#include <string>

namespace images {

/// What is wrong with a picture that has NaN or infinite values: "pixel (7, 9) is NaN or infinite", or
/// how many pixels are and which is the first; none if all are finite.
std::optional<std::string> say_non_finite(const Image& image);

} // namespace images
