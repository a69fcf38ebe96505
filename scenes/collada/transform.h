#pragma once

// Node transforms: from the local frame of a node to that of its parent, and their properties.

#include "scenes/collada/document.h"
#include "scenes/scene.h"

#include <glm/mat4x4.hpp>

namespace scenes::collada {

using Matrix = glm::dmat4;

/// The product of the transformation elements of `node` in document order: <matrix>, <translate>,
/// <rotate> (degrees about an axis), <scale>, <lookat>. <skew> is refused.
Matrix node_transform(const Element& node);

/// The three columns of the linear part, and its properties.
struct LinearPart {
    explicit LinearPart(const Matrix& matrix);

    Vec3 lengths;    // of the columns: how the local axes are scaled
    Vec3 axes[3];    // the columns, normalised; meaningless if singular
    bool singular;   // the axes lie in a plane, to within rounding
    bool mirrored;   // the determinant is negative
    bool orthogonal; // the axes are perpendicular to within 1e-5
    bool uniform;    // the lengths agree to within a relative 1e-5
};

/// The image of a point and of a direction.
Vec3 transform_point(const Matrix& matrix, const Vec3& point);
Vec3 transform_direction(const Matrix& matrix, const Vec3& direction);

/// Whether all coordinates are finite.
bool is_finite(const Vec3& vector);

/// `vector` scaled to length one without overflow or underflow; NaN if it is zero.
Vec3 unit(const Vec3& vector);

} // namespace scenes::collada
