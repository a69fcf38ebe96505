#include "images/families.h"

#include <stdexcept>
#include <string>

namespace images {

void expect_families(Integrator integrator, const Families& families)
{
    const Families all = families_of(integrator);
    bool any = false;
    for (const auto& [name, family] : named_families) {
        if (!(families.*family) && !(all.*family))
            throw std::invalid_argument("the integrator has no " + std::string(name) + " to leave out");
        any = any || (families.*family && all.*family);
    }
    if (!any) throw std::invalid_argument("nothing of the integrator is left");
}

} // namespace images
