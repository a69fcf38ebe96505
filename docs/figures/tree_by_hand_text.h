#pragma once

// The numbers of docs/tree-by-hand.md, as Markdown.

#include "docs/figures/eight_keys.h"

#include <map>
#include <string>

namespace figures {

/// The parts of the page (page_parts.h) by name.
std::map<std::string, std::string> tree_by_hand_parts(const EightKeys& keys,
                                                      const EightKeys& duplicates);

} // namespace figures
