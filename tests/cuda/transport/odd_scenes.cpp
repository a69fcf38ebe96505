#include "tests/cuda/transport/odd_scenes.h"

#include <array>

namespace fast_transport_test {

OddScene odd_scene(std::uint32_t seed)
{
    switch (odd_kind(seed)) {
    case OddKind::white_under_sky:
        return odd_furnace(seed, true);
    case OddKind::white_among_lamps:
        return odd_furnace(seed, false);
    case OddKind::plane:
        return odd_plane(seed);
    case OddKind::room:
        break;
    }
    return odd_room(seed);
}

std::string name_of(OddKind kind)
{
    constexpr std::array names = {"WhiteUnderSky", "WhiteAmongLamps", "Plane", "Room"};
    return names[static_cast<std::size_t>(kind)];
}

} // namespace fast_transport_test
