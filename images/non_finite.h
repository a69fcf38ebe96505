#pragma once

#include "images/image.h"

#include <optional>
#include <string>

namespace images {

/// A message for a picture with NaN or infinite values: "pixel (7, 9) is NaN or infinite", or the number
/// of such pixels and the first of them; none if all are finite.
std::optional<std::string> say_non_finite(const Image& image);

} // namespace images
