#pragma once

// The number of tests that share the chance of a false alarm.

#include "golden/functionals.h"
#include "golden/method.h"

#include <map>
#include <vector>

namespace golden {

/// The factors by which p-values are multiplied [Bonferroni]: the level is divided equally among
/// channels, then among families (kind of region and weight), then among the members of a family.
class Multiplicity {
public:
    Multiplicity(const Functionals& functionals, Method method);
    /// The factor for a functional of this kind of region.
    [[nodiscard]] double of(RegionKind kind) const;
    /// The number of tests of this kind of region, of all weights and channels together.
    [[nodiscard]] double tests_of(RegionKind kind) const;
    [[nodiscard]] std::vector<RegionKind> kinds() const;

private:
    std::map<RegionKind, double> members_;
    double weights_ = 0.0;
};

} // namespace golden
