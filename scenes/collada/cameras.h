#pragma once

// Cameras: the field of view of a <camera>, and the axes that its node gives to it.

#include "scenes/collada/document.h"
#include "scenes/collada/transform.h"
#include "scenes/scene.h"

#include <string>
#include <vector>

namespace scenes::collada {

/// The camera of an <instance_camera> whose <camera> is given, in a node with the transform `to_world`.
/// It looks along local -z with local +y up. The lengths of the axes do not matter, but the axes must be
/// perpendicular; a mirrored node mirrors the picture. <xfov> is the horizontal and <yfov> the vertical
/// field of view, both full angles in degrees in (0, 180). If both are given, <xfov> is used, with a
/// notice, because pixels are square. <aspect_ratio>, <znear> and <zfar> are ignored: the picture's size
/// decides the aspect ratio, and rays need no clipping.
Camera read_camera(const Element& camera, const Element& instance, const Matrix& to_world,
                   std::vector<std::string>& notices);

} // namespace scenes::collada
