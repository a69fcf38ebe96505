#pragma once

// Text in a picture.

#include "images/image.h"

#include <string>

namespace images {

/// Draws `text` (ASCII, one line) with its top left corner at pixel (x, y) in letters about 7 * `scale`
/// pixels high; what falls outside the image is cut off.
void draw_text(Image& image, int x, int y, const std::string& text, const Rgb& color, int scale = 1);

/// The width in pixels of the text of draw_text.
int text_width(const std::string& text, int scale = 1);

} // namespace images
