#include "golden/finding.h"

namespace golden {

std::string describe(const Finding& finding)
{
    return std::string(channel_names[finding.channel]) + " of " + describe(finding.region) + " (" +
           describe(finding.weight) + ")";
}

std::string describe_place(const Finding& finding)
{
    const std::string region = describe(finding.region);
    const std::string in = std::string(channel_names[finding.channel]) + " in ";
    switch (finding.region.kind) {
    case RegionKind::whole:
        return in + region;
    case RegionKind::luminance:
        return in + "the pixels of " + region + " (1: the darkest)";
    case RegionKind::noise:
        return in + "the pixels of " + region + " (1: the least noise)";
    default:
        return in + "the " + region;
    }
}

} // namespace golden
