#include "check/renderers/certainty.h"

#include "golden/compare_options.h"
#include "golden/multiplicity.h"
#include "golden/statistics.h"

#include <algorithm>
#include <limits>

namespace check {

namespace {

/// With so many pictures, the comparison's own level is kept (docs/comparison.md, section 7).
constexpr std::size_t enough_for_welch = 64;

} // namespace

bool is_certain(const golden::Golden& golden, const golden::Comparison& comparison, std::size_t pictures)
{
    if (pictures >= enough_for_welch) return true;
    if (std::ranges::any_of(comparison.odd, [](const golden::OddPixels& odd) { return odd.wrong; }))
        return true; // no test of means
    const golden::Multiplicity multiplicity(golden.functionals, golden::Method::welch);
    const golden::MeanEstimate nothing{0.0, 0.0, std::numeric_limits<double>::infinity()};
    const auto fewer = static_cast<double>(std::min(pictures, golden.reference.size()));
    const double level = golden::CompareOptions().certainty_level;
    return std::ranges::any_of(comparison.findings, [&](const golden::Finding& finding) {
        const golden::MeanEstimate by_pictures{finding.test.z, 1.0, fewer - 1.0};
        const double p = golden::welch(by_pictures, nothing, 0.0).p;
        return finding.conclusive && golden::bonferroni(p, multiplicity.of(finding.region.kind)) < level;
    });
}

} // namespace check
