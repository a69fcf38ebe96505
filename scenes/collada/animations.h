#pragma once

// Animations are not followed. An animated element keeps the values that stand in the element itself.

#include "scenes/collada/document.h"

#include <string>
#include <vector>

namespace scenes::collada {

/// Adds to `notices` one line for each element in use that is the target of a <channel> of a
/// <library_animations> below the root. The line names the first such channel. Document::is_in_use
/// defines the elements in use, so call this after the scene has been read. Animations of other elements
/// change nothing and are not read further, well-formed or not.
void notice_animations(const Document& document, std::vector<std::string>& notices);

} // namespace scenes::collada
