#include "images/page_scripts.h"

#include "images/page_parts.h" // made from the files in page/
#include "images/page_template.h"

#include <array>

namespace images {

std::string page_scripts()
{
    return fill(page_parts::html,
                std::array<Mark, 2>{{{"@D3@", page_parts::d3}, {"@PAGE_BASICS@", page_parts::basics}}});
}

} // namespace images
