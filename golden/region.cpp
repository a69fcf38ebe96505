#include "golden/region.h"

namespace golden {

std::string describe(const Region& region)
{
    switch (region.kind) {
    case RegionKind::whole:
        return "the whole picture";
    case RegionKind::coarse_tile:
    case RegionKind::fine_tile:
        return "tile x " + std::to_string(region.x0) + ".." + std::to_string(region.x1 - 1) + ", y " +
               std::to_string(region.y0) + ".." + std::to_string(region.y1 - 1);
    case RegionKind::luminance:
        return "luminance stratum " + std::to_string(region.index + 1) + " of 16";
    case RegionKind::noise:
        return "noise stratum " + std::to_string(region.index + 1) + " of 16";
    }
    return "";
}

std::string describe(Weight weight)
{
    switch (weight) {
    case Weight::matched:
        return "matched";
    case Weight::plain:
        return "plain";
    case Weight::bounded:
        return "bounded";
    }
    return "";
}

} // namespace golden
