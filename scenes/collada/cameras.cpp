#include "scenes/collada/cameras.h"

#include "scenes/collada/numbers.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace scenes::collada {
namespace {

double read_angle(const Element& element)
{
    const double degrees = number(element);
    if (!(degrees > 0 && degrees < 180)) fail(element, "not between 0 and 180 degrees");
    return glm::radians(degrees);
}

} // namespace

Camera read_camera(const Element& camera, const Element& instance, const Matrix& to_world,
                   std::vector<std::string>& notices)
{
    check_children(camera, {"optics", "imager"});
    const Element& optics = required_child(camera, "optics");
    check_children(optics, {"technique_common", "technique"});
    const Element& technique = required_child(optics, "technique_common");
    check_children(technique, {"perspective"}); // <orthographic> is refused here
    const Element& perspective = required_child(technique, "perspective");
    check_children(perspective, {"xfov", "yfov", "aspect_ratio", "znear", "zfar"});

    const Element* const xfov = optional_child(perspective, "xfov");
    const Element* const yfov = optional_child(perspective, "yfov");
    if (xfov == nullptr && yfov == nullptr) fail(perspective, "neither <xfov> nor <yfov> in it");
    if (xfov != nullptr && yfov != nullptr)
        notices.push_back(place(*yfov) + "ignored: <xfov> is given as well, and pixels are square");

    const LinearPart linear(to_world);
    const Vec3 eye(to_world[3]);
    if (linear.singular || !is_finite(eye)) fail(instance, "the transform of its node has no inverse");
    if (!linear.orthogonal) fail(instance, "the transform of its node shears the camera");
    // The axes are perpendicular to the precision of the file; this makes them so to that of a double.
    const Vec3 backward = linear.axes[2];
    const Vec3 up = unit(linear.axes[1] - glm::dot(linear.axes[1], backward) * backward);
    const Vec3 right = linear.mirrored ? glm::cross(backward, up) : glm::cross(up, backward);
    return {eye,
            right,
            up,
            backward,
            xfov ? FovAxis::horizontal : FovAxis::vertical,
            read_angle(xfov ? *xfov : *yfov)};
}

} // namespace scenes::collada
