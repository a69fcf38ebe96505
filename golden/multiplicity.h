#pragma once

// How many tests share the chance of a false alarm.

#include "golden/functionals.h"
#include "golden/method.h"

#include <map>
#include <vector>

namespace golden {

/// How many tests share the chance of a false alarm, seen from one of them: each channel, each family
/// (kind of region and weight) and each member of a family gets an equal share of what is above it.
class Multiplicity {
public:
    Multiplicity(const Functionals& functionals, Method method);
    [[nodiscard]] double of(RegionKind kind) const;
    /// The members of a kind's families, of all weights and channels together.
    [[nodiscard]] double tests_of(RegionKind kind) const;
    [[nodiscard]] std::vector<RegionKind> kinds() const;

private:
    std::map<RegionKind, double> members_;
    double weights_ = 0.0;
};

} // namespace golden
