#include "scenes/collada/positions.h"

#include "scenes/collada/numbers.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace scenes::collada {
namespace {

/// The places of x, y and z among the values of a stride: those of the params with these names.
std::array<std::uint32_t, 3> coordinate_places(const Element& accessor)
{
    std::array<std::optional<std::uint32_t>, 3> places;
    std::uint32_t place = 0;
    for (const Element* param : children(accessor, "param")) {
        const char* name = param->Attribute("name");
        const std::size_t axis = name ? std::string_view("XYZ").find(name) : std::string_view::npos;
        if (axis < 3 && std::string_view(name).size() == 1) {
            if (places[axis]) fail(*param, "a second one of that name");
            if (!param->Attribute("type", "float") && !param->Attribute("type", "double"))
                fail(*param, "its type is neither float nor double");
            places[axis] = place;
        }
        ++place;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (!places[axis])
            fail(accessor,
                 "no <param name=\"" + std::string(1, "XYZ"[axis]) + "\">: not positions in space");
    return {*places[0], *places[1], *places[2]};
}

} // namespace

std::vector<Vec3> read_positions(const Document& document, const Element& source)
{
    check_children(source, {"float_array", "technique_common", "technique"});
    const Element& technique = required_child(source, "technique_common");
    check_children(technique, {"accessor"});
    const Element& accessor = required_child(technique, "accessor");
    check_children(accessor, {"param"});

    const Element& array = document.target(accessor, "source", "float_array");
    const std::vector<double> values = numbers(array);
    if (const std::uint32_t count = count_attribute(array, "count"); count != values.size())
        fail(array, "count is " + std::to_string(count) + ", but it holds " +
                        std::to_string(values.size()) + " numbers");

    const std::uint64_t count = count_attribute(accessor, "count");
    const std::uint64_t stride = count_attribute(accessor, "stride", 1);
    const std::uint64_t offset = count_attribute(accessor, "offset", 0);
    const std::array<std::uint32_t, 3> places = coordinate_places(accessor);
    const std::uint64_t last_place = std::max({places[0], places[1], places[2]});
    if (last_place >= stride)
        fail(accessor, "stride is " + std::to_string(stride) + ", less than its <param>s");
    // All factors are below 2^32, so no product wraps around.
    if (count > 0 && offset + (count - 1) * stride + last_place >= values.size())
        fail(accessor,
             "it reaches beyond the " + std::to_string(values.size()) + " numbers of its array");

    std::vector<Vec3> positions(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const std::uint64_t first = offset + i * stride;
        positions[i] = {values[first + places[0]], values[first + places[1]], values[first + places[2]]};
    }
    return positions;
}

} // namespace scenes::collada
