#include "golden/finding.h"

namespace golden {

std::string describe(const Finding& finding)
{
    return std::string(channel_names[finding.channel]) + " of " + describe(finding.region) + " (" +
           describe(finding.weight) + ")";
}

} // namespace golden
