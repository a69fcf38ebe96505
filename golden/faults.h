#pragma once

// What is usually wrong with a picture from another renderer, and how to undo it.

#include "images/image.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace golden {

/// A mistake that can be undone without another render.
struct Fault {
    std::string is; // completes "Your picture is ...": "upside down"
    /// The picture as it was before the mistake; none if this picture cannot have it. The picture has
    /// the golden's size.
    std::function<std::optional<images::Image>(const images::Image& picture,
                                               const images::Image& golden)>
        undo;
};

/// The mistakes of place, of channels and of encoding, in the order in which they are tried: mirrored,
/// rotated, transposed; shifted by one pixel; channels exchanged; sRGB or a gamma of 2.2; clamped at 1.
std::vector<Fault> usual_faults();

/// A factor that mistakes really have: 1/2, 2, pi, 1/pi, 2 pi, 4 pi and their reciprocals, and the
/// number of samples per pixel. `name`: "1/pi".
struct KnownFactor {
    std::string name;
    double value;
};
std::vector<KnownFactor> known_factors(double samples);

} // namespace golden
