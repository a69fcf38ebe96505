#pragma once

// Scripts that several HTML pages have in common. A page must not need a network, so it contains them.

#include <string>

namespace images {

/// D3, the library that draws the plots, as a script element with its licence before it. After it, a
/// script element with functions for the data of the page (`results`, from the element "data", which
/// must stand before it), numbers as text, and elements.
std::string page_scripts();

} // namespace images
