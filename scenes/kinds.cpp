#include "scenes/kinds.h"

namespace scenes {
namespace {

template <class Enumeration, std::size_t count>
std::string_view pick(const std::array<std::string_view, count>& names, Enumeration enumerator)
{
    static_assert(count == all_of<Enumeration>.size());
    return names.at(static_cast<std::size_t>(enumerator));
}

} // namespace

std::string_view name_of(Shape shape)
{
    return pick(std::array<std::string_view, 2>{"triangle", "sphere"}, shape);
}

std::string_view name_of(Bsdf bsdf)
{
    return pick(std::array<std::string_view, 3>{"lambertian", "mirror", "glass"}, bsdf);
}

std::string_view name_of(EmitterKind kind)
{
    return pick(
        std::array<std::string_view, 6>{"mesh", "sphere", "point", "directional", "spot", "environment"},
        kind);
}

std::string_view name_of(Strategy strategy)
{
    return pick(
        std::array<std::string_view, 4>{"emission_hit", "next_event", "light_image", "inner_connection"},
        strategy);
}

std::string_view name_of(FovAxis axis)
{
    return pick(std::array<std::string_view, 2>{"horizontal", "vertical"}, axis);
}

} // namespace scenes
