#pragma once

// Numbers in the text and the attributes of elements. Strict: the whole text must be numbers, none of
// them infinite or NaN, whatever the locale; every failure is a SceneError at the element.

#include "scenes/collada/document.h"
#include "scenes/scene.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace scenes::collada {

/// All numbers in the text of `element`, separated by white space.
std::vector<double> numbers(const Element& element);
/// The same, failing unless there are exactly `count`.
std::vector<double> numbers(const Element& element, std::size_t count);
/// The one number in the text of `element`.
double number(const Element& element);
/// Three numbers.
Vec3 vector(const Element& element);

/// All indices (0 to 2^32 - 1) in the text of `element`.
std::vector<std::uint32_t> indices(const Element& element);
/// An attribute that is an integer from 0 to 2^32 - 1. Without `fallback` it must be there.
std::uint32_t count_attribute(const Element& element, const char* name,
                              std::optional<std::uint32_t> fallback = std::nullopt);

enum class Alpha { none, ignored };
/// A colour of three numbers, none negative: radiance, intensity, irradiance. Where alpha is `ignored`,
/// there may be a fourth number.
Rgb emission_color(const Element& element, Alpha alpha = Alpha::none);
/// The same, and none greater than 1.
Rgb reflection_color(const Element& element, Alpha alpha = Alpha::none);

} // namespace scenes::collada
