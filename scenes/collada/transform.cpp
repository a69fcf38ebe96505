#include "scenes/collada/transform.h"

#include "scenes/collada/numbers.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace scenes::collada {
namespace {

// Files carry about seven significant digits: a rotation read from one is orthogonal to about 1e-6.
constexpr double file_precision = 1e-5;
// If the triple product of unit axes is smaller than this, they lie in a plane to within rounding.
constexpr double flat = 1e-12;

Matrix read_matrix(const Element& element)
{
    const std::vector<double> rows = numbers(element, 16);
    if (rows[12] != 0 || rows[13] != 0 || rows[14] != 0 || rows[15] != 1)
        fail(element, "the last row is not 0 0 0 1: a perspective transform has no meaning here");
    return glm::transpose(glm::make_mat4(rows.data())); // COLLADA writes rows, glm keeps columns
}

Matrix read_rotation(const Element& element)
{
    const std::vector<double> v = numbers(element, 4);
    const Vec3 axis = unit(Vec3(v[0], v[1], v[2]));
    if (!is_finite(axis)) fail(element, "the axis has no direction");
    return glm::rotate(Matrix(1.0), glm::radians(v[3]), axis);
}

Matrix read_lookat(const Element& element)
{
    const std::vector<double> v = numbers(element, 9);
    const Vec3 eye(v[0], v[1], v[2]);
    const Vec3 backward = unit(eye - Vec3(v[3], v[4], v[5]));
    const Vec3 right = unit(glm::cross(unit(Vec3(v[6], v[7], v[8])), backward));
    if (!is_finite(right)) fail(element, "the view has no direction, or up points along it");
    return {glm::dvec4(right, 0), glm::dvec4(glm::cross(backward, right), 0), glm::dvec4(backward, 0),
            glm::dvec4(eye, 1)};
}

} // namespace

Matrix node_transform(const Element& node)
{
    Matrix product(1.0);
    for (const Element* e = node.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
        const std::string_view name = e->Name();
        if (name == "matrix") product *= read_matrix(*e);
        if (name == "translate") product *= glm::translate(Matrix(1.0), vector(*e));
        if (name == "rotate") product *= read_rotation(*e);
        if (name == "scale") product *= glm::scale(Matrix(1.0), vector(*e));
        if (name == "lookat") product *= read_lookat(*e);
        if (name == "skew") fail(*e, "not supported: write it as a <matrix>");
    }
    return product;
}

LinearPart::LinearPart(const Matrix& matrix)
{
    for (int i = 0; i < 3; ++i) {
        const Vec3 column(matrix[i]);
        axes[i] = unit(column);
        lengths[i] = glm::dot(axes[i], column);
    }
    const double triple = glm::dot(glm::cross(axes[0], axes[1]), axes[2]);
    singular = !(std::abs(triple) > flat); // also where an axis is NaN
    mirrored = triple < 0;
    const double skewness =
        std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                  std::abs(glm::dot(axes[2], axes[0]))});
    orthogonal = skewness <= file_precision;
    const auto [shortest, longest] = std::minmax({lengths.x, lengths.y, lengths.z});
    uniform = longest - shortest <= file_precision * longest;
}

Vec3 transform_point(const Matrix& matrix, const Vec3& point)
{
    return Vec3(matrix * glm::dvec4(point, 1.0));
}

Vec3 transform_direction(const Matrix& matrix, const Vec3& direction)
{
    return Vec3(matrix * glm::dvec4(direction, 0.0));
}

bool is_finite(const Vec3& vector)
{
    return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

Vec3 unit(const Vec3& vector)
{
    const double largest = std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)});
    const Vec3 scaled = vector / largest;
    return scaled / glm::length(scaled);
}

} // namespace scenes::collada
