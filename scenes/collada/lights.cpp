#include "scenes/collada/lights.h"

#include "scenes/collada/numbers.h"

#include <glm/trigonometric.hpp>

#include <cmath>
#include <string>
#include <string_view>

namespace scenes::collada {
namespace {

const Vec3 origin(0.0);
const Vec3 forward(0.0, 0.0, -1.0);

Rgb color_of(const Element& kind)
{
    return emission_color(required_child(kind, "color"));
}

/// A parameter such as <falloff_angle>; `fallback` if it is absent.
double parameter(const Element& kind, const char* name, double fallback)
{
    const Element* element = optional_child(kind, name);
    return element ? number(*element) : fallback;
}

SpotLight read_spot(const Element& spot)
{
    check_children(spot, {"color", "constant_attenuation", "linear_attenuation", "quadratic_attenuation",
                          "falloff_angle", "falloff_exponent"});
    const double angle = parameter(spot, "falloff_angle", 180.0);
    const double exponent = parameter(spot, "falloff_exponent", 0.0);
    if (!(angle > 0 && angle <= 360)) fail(spot, "<falloff_angle>: not in (0, 360] degrees");
    if (!(exponent >= 0)) fail(spot, "<falloff_exponent>: negative");
    const double cos_cutoff = std::cos(glm::radians(angle) / 2);
    if (!(cos_cutoff < 1)) fail(spot, "<falloff_angle>: too narrow to be told from nothing");
    return {origin, forward, color_of(spot), cos_cutoff, exponent};
}

} // namespace

Light read_light(const Element& light)
{
    check_children(light, {"technique_common", "technique"}, Cmu462::understood);
    const Element* const cmu462 = cmu462_technique(light);
    const Element& technique = cmu462 ? *cmu462 : required_child(light, "technique_common");
    const Element* const kind = technique.FirstChildElement();
    if (kind == nullptr) fail(light, "no kind of light in it");
    if (const Element* second = kind->NextSiblingElement())
        fail(*second, "a second kind of light beside " + describe(*kind));

    const std::string_view name = kind->Name();
    if (name == "spot") return read_spot(*kind);
    if (name == "point") {
        check_children(*kind,
                       {"color", "constant_attenuation", "linear_attenuation", "quadratic_attenuation"});
        return PointLight{origin, color_of(*kind)};
    }
    const bool is_area = name == "area" && cmu462 != nullptr;
    if (!is_area && name != "directional" && name != "ambient")
        fail(light, "unknown kind " + in_brackets(*kind));
    check_children(*kind, {"color"});
    if (name == "directional") return DirectionalLight{forward, color_of(*kind)};
    if (name == "ambient") return AmbientLight{color_of(*kind)};
    return AreaLight{color_of(*kind)};
}

} // namespace scenes::collada
