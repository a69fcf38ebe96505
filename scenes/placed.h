#pragma once

// Moves and scales a scene so that rounding does least harm: near the origin, about one unit large.

#include "scenes/scene.h"

namespace scenes {

/// `scene` scaled by a power of two so that the diagonal of its bounding box is in [1, 2), and moved so
/// that the box is less than 1024 diagonals away from the origin. Its picture is the same: radiance and
/// irradiance do not depend on scale, and intensities (W sr^-1) are scaled by the square of lengths.
///
/// Scaling rounds nothing. The scene moves by whole multiples of 1024 diagonals: a scene near the origin
/// keeps every bit, and coordinates far from it are multiples of a number so coarse that the difference
/// is exact. A scene without surfaces, or whose surfaces have no extent, is returned unchanged.
///
/// Throws SceneError if doubles cannot hold the scene: for a coordinate that is not finite; for an
/// extent that overflows; for coordinates so far from the origin that neighbouring doubles are more than
/// 1e-3 diagonals apart (from 1e-6 on there is a notice); and for light above 1e30 (W m^-2 sr^-1,
/// W m^-2, or, for an intensity, W sr^-1 at the new scale), which a picture of 32-bit floats cannot
/// hold, or where all light is below 1e-30.
Scene placed(Scene scene);

} // namespace scenes
