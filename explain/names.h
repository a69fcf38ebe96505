#pragma once

// Words for what a sample consists of, the same in text, JSON and pages.

#include "explain/sample.h"

#include <string>
#include <string_view>

namespace explain {

std::string_view name_of(ref::Event event);
std::string_view name_of(WalkEnd end);
std::string_view name_of(Obstacle obstacle);
std::string_view name_of(images::Integrator integrator);
std::string_view name_of(images::Heuristic heuristic);

/// "emission_hit", "next_event", "light_image" or "inner_connection".
std::string_view family_of(const Strategy& strategy);

/// Why the walk has no further vertex, to be read after "the walk ends: ".
std::string_view sentence(WalkEnd end);

/// Why the strategy contributes nothing, in a few words; empty if it contributes.
std::string sentence(const Strategy& strategy, const scenes::Scene& scene);

/// "triangle 3" or "sphere 0" (numbered by themselves), and the material: "triangle 3, lambertian red".
std::string describe_primitive(const scenes::Scene& scene, std::uint32_t primitive);

/// What the vertex is on: the eye, a primitive, or a light.
std::string describe(const scenes::Scene& scene, const ref::Vertex& vertex);

/// "x,y" of a pixel number.
std::string pixel_name(std::uint32_t pixel, int width);

/// Six digits.
std::string number(double x);

/// Three numbers with a space between.
std::string numbers(const Vec3& v);

} // namespace explain
