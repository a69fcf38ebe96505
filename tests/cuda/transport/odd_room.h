#pragma once

// A room, its eye and its lamps, collected for odd_room.cpp.

#include "tests/cuda/transport/odd_scenes.h"
#include "tests/cuda/transport/odd_things.h"

#include <set>

namespace fast_transport_test {

/// The room is the cube from -1.5 to 1.5. Its cells, 1 wide, take one thing or lamp each.
class OddRoom {
public:
    OddRoom(OddBuilder& builder, OddScene& odd);

    void add_everything();
    [[nodiscard]] scenes::Scene part(bool second) const;

private:
    scenes::Vec3 any_cell();
    void add_walls();
    void add_eye();
    void add_lamp();
    void add_quad_lamp();
    void add_ceiling_lamp();
    void add_body_lamp();
    void add_small_light();
    void add_additions();
    std::uint32_t lamp_material(double area);
    void see_small_lamp(double width);

    OddBuilder& builder_;
    OddScene& odd_;
    bool specular_ = false, open_ = false;
    Matter matter_{};
    std::vector<scenes::Vec3> cells_;
    bool second_ = false;                          // the group of the lamp that is being added
    std::array<std::set<std::uint32_t>, 2> lamps_; // materials, by group
    std::vector<bool> points_, spots_, suns_;      // whether in the second group
    bool sky_in_second_ = false;
};

} // namespace fast_transport_test
