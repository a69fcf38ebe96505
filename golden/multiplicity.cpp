#include "golden/multiplicity.h"

namespace golden {

Multiplicity::Multiplicity(const Functionals& functionals, Method method)
    : weights_(method == Method::ranks ? 3.0 : 2.0) // t tests do not use the bounded one
{
    for (const Region& region : functionals.regions()) members_[region.kind] += 1.0;
}

double Multiplicity::of(RegionKind kind) const
{
    const double families = static_cast<double>(members_.size()) * weights_;
    return static_cast<double>(channel_count) * families * members_.at(kind);
}

double Multiplicity::tests_of(RegionKind kind) const
{
    return static_cast<double>(channel_count) * weights_ * members_.at(kind);
}

std::vector<RegionKind> Multiplicity::kinds() const
{
    std::vector<RegionKind> kinds;
    for (const auto& [kind, members] : members_) kinds.push_back(kind);
    return kinds;
}

} // namespace golden
