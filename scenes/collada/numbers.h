#pragma once

// Numbers in the text and the attributes of elements. Strict: the whole text must consist of numbers
// that are neither infinite nor NaN, in any locale. Every failure is a SceneError at the element.

#include "scenes/collada/document.h"
#include "scenes/scene.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace scenes::collada {

/// All numbers in the text of `element`, separated by white space.
std::vector<double> numbers(const Element& element);
/// The same; fails unless there are exactly `count`.
std::vector<double> numbers(const Element& element, std::size_t count);
/// The number in the text of `element`; fails unless there is exactly one.
double number(const Element& element);
/// Three numbers.
Vec3 vector(const Element& element);

/// All indices (0 to 2^32 - 1) in the text of `element`.
std::vector<std::uint32_t> indices(const Element& element);
/// An attribute that is an integer from 0 to 2^32 - 1. Without `fallback` the attribute is required.
std::uint32_t count_attribute(const Element& element, const char* name,
                              std::optional<std::uint32_t> fallback = std::nullopt);

enum class Alpha { none, ignored };
/// A colour of three non-negative numbers: radiance, intensity, irradiance. If alpha is `ignored`, there
/// may be a fourth number.
Rgb emission_color(const Element& element, Alpha alpha = Alpha::none);
/// The same, with no number greater than 1.
Rgb reflection_color(const Element& element, Alpha alpha = Alpha::none);

} // namespace scenes::collada
