#pragma once

// Animations: they are not followed. What they would move stands as its own element says.

#include "scenes/collada/document.h"

#include <string>
#include <vector>

namespace scenes::collada {

/// Adds to `notices` one line for each element in use that a <channel> of a <library_animations> below
/// the root targets, naming the first such channel. An element is in use if Document::is_in_use says so:
/// to be called when the scene has been read. Animations of anything else change nothing and are not
/// looked at further, well-formed or not.
void notice_animations(const Document& document, std::vector<std::string>& notices);

} // namespace scenes::collada
