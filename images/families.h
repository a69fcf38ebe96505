#pragma once

// The names of the families of strategies, and which integrator has which.

#include "images/render_options.h"

#include <array>

namespace images {

/// A family and its name, which is that of scenes::Strategy.
struct NamedFamily {
    const char* name;
    bool Families::*family;
};

inline constexpr std::array named_families = {
    NamedFamily{"emission_hit", &Families::emission_hit},
    NamedFamily{"next_event", &Families::next_event}, NamedFamily{"light_image", &Families::light_image},
    NamedFamily{"inner_connection", &Families::inner_connection}};

/// The families that an integrator has.
constexpr Families families_of(Integrator integrator)
{
    const bool eye_walk = integrator != Integrator::light;
    const bool light_walk = integrator != Integrator::path;
    return {eye_walk, eye_walk, light_walk, eye_walk && light_walk};
}

/// Throws std::invalid_argument if `families` leaves out one that the integrator does not have, or
/// leaves nothing of it.
void expect_families(Integrator integrator, const Families& families);

} // namespace images
