#include "golden/comparison.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace golden {

std::string describe(Verdict verdict)
{
    switch (verdict) {
    case Verdict::pass:
        return "PASS";
    case Verdict::fail:
        return "FAIL";
    case Verdict::inconclusive:
        return "INCONCLUSIVE";
    }
    return "";
}

const Finding& whole_picture(const Comparison& comparison, std::size_t channel)
{
    const auto found =
        std::find_if(comparison.findings.begin(), comparison.findings.end(), [&](const Finding& f) {
            return f.channel == channel && f.region.kind == RegionKind::whole &&
                   f.weight == Weight::plain;
        });
    if (found == comparison.findings.end()) throw std::invalid_argument("no such channel");
    return *found;
}

TileMap tile_map(const Comparison& comparison, std::size_t channel)
{
    TileMap map;
    for (const Finding& f : comparison.findings) {
        if (f.channel != channel || f.region.kind != RegionKind::fine_tile ||
            f.weight != Weight::matched)
            continue;
        if (f.region.y0 == 0) ++map.columns;
        map.z.push_back(f.conclusive ? f.test.z : std::numeric_limits<double>::quiet_NaN());
    }
    if (map.columns > 0) map.rows = static_cast<int>(map.z.size()) / map.columns;
    return map;
}

} // namespace golden
