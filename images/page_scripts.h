#pragma once

// Scripts that several HTML pages have in common. A page must not need a network, so it contains them.

#include <string>

namespace images {

/// A script element that writes the errors of all later scripts into the element "script-errors". After
/// it D3, the library that draws the plots, with its licence before it. Last, a script element with
/// functions for the data of the page (`results`, from the element "data", which must stand before it),
/// numbers as text, and elements.
std::string page_scripts();

} // namespace images
